// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.hpp"

#include "engine.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>

namespace bench {

const char *const usage =
    R"(cpp-bench/run: deldrift beside CGAL on identical positions.

  --preset NAME            how much to do. quick: within three minutes, with --report ten; full: 1,000 timestamps,
                           with --report within two hours; smoke: just enough to see that everything runs
  --scenario NAME          only this one; may be repeated
                           lloyd_2d_uniform, walk_3d, static_2d, static_3d, step_2d, step_3d
  --series FILE.npy        replay recorded positions, frames x points x dimension, f64 or f32; may be repeated.
                           An array of points x dimension is a point set, built once.
                           Without --scenario, only the series are run
  --displacement FILE.npy  displaces the points of the --series before it ...
  --steps N                ... in so many equal steps
  --snap MAGNITUDE         coordinates of series files that are smaller than this become 0, for every engine
  --engine NAME            only this one (cgal, deldrift, or as in deldrift/auto); may be repeated.
                           CGAL's rebuilding, the baseline, always runs. deldrift/watching and deldrift/slack run
                           where named in full only
  --threads N              number of threads deldrift may use, default 1; may be repeated
  --seed N                 of the generated positions, default 1
  --repeat N               time everything so many times and take medians
  --timestamps N           of the generated series, instead of the preset's
  --checks N               compare cells at so many timestamps, instead of the preset's; series files: all
  --slow-timestamps N      time engines that relocate one vertex after another at so many timestamps in 3D,
                           instead of the preset's; series files: all
  --keep-failures DIR      write the positions at which a check fails there, as a series to replay
  --results DIR            where CSV files go
  --report                 the inputs of the report RR-6750 with all engines instead, to report.csv and the files
                           beside it (make report makes a page of them). What is there for the same commit,
                           preset and seed is kept, so that a run can be continued. Scenarios:
                           lloyd_2d_uniform, lloyd_2d_r2, lloyd_2d_x2, lloyd_2d_sin2, slloyd, snodt, man,
                           share_2d, share_3d, walk_2d, walk_3d
  --memory                 bytes per vertex at a million points instead, to memory.csv
  --large                  build, validate and commit 50 million points in 2D and 20 million in 3D instead,
                           to large.csv
  --large-points-2d N      other sizes for --large; 0 leaves the dimension out
  --large-points-3d N
  --targets                special cases beside the speed-up wanted, instead, to
                           targets.csv: within eight minutes
  --self-test              test the benchmark's own checks instead
)";

namespace {

const Preset quick = {"quick", 1000, 50, 5, 10, 3, {1'000, 10'000, 100'000, 1'000'000},
                      {1'000, 10'000, 100'000}};
const Preset smoke = {"smoke", 20, 5, 2, 2, 1, {1'000}, {1'000}};
const Preset full = {"full", 1000, 1000, 20, 20, 3, {1'000, 10'000, 100'000, 1'000'000}, {1'000, 10'000, 100'000}};

const std::vector<std::string> scenario_names = {"lloyd_2d_uniform", "walk_3d", "static_2d",
                                                 "static_3d",        "step_2d", "step_3d"};

std::vector<std::string> all_scenario_names() {
    std::vector<std::string> names = scenario_names;
    names.insert(names.end(), report_scenario_names().begin(), report_scenario_names().end());
    return names;
}

class Parser {
public:
    Parser(int n_arguments, char **arguments) : words_(arguments + 1, arguments + n_arguments) {}

    Options parse() {
        options_.preset = quick;
        if (const char *folder = std::getenv("DELDRIFT_BENCH_RESULTS")) options_.results = folder;
        if (const char *folder = std::getenv("DELDRIFT_BENCH_DATA")) options_.data = folder;
        for (at_ = 0; at_ < words_.size(); ++at_) take(words_[at_]);
        finish();
        return options_;
    }

private:
    void take(const std::string &word) {
        if (word == "--preset") take_preset();
        else if (word == "--scenario") options_.scenarios.push_back(one_of(all_scenario_names(), value()));
        else if (word == "--series") options_.series.push_back({value(), {}, 0});
        else if (word == "--displacement") last_series().displacement_path = value();
        else if (word == "--steps") last_series().n_steps = number(1);
        else if (word == "--snap") options_.snap = magnitude();
        else if (word == "--engine") options_.engines.push_back(engine(value()));
        else if (word == "--threads") threads_.push_back(static_cast<unsigned>(number(1)));
        else if (word == "--seed") options_.seed = number(0);
        else if (word == "--repeat") n_repeats_ = number(1);
        else if (word == "--timestamps") n_timestamps_ = number(1);
        else if (word == "--checks") n_checks_ = number(1);
        else if (word == "--slow-timestamps") n_slow_timestamps_ = number(1);
        else if (word == "--keep-failures") options_.keep_failures = value();
        else if (word == "--results") options_.results = value();
        else if (word == "--report") options_.task = Task::report;
        else if (word == "--memory") options_.task = Task::memory;
        else if (word == "--large") options_.task = Task::large;
        else if (word == "--targets") options_.task = Task::targets;
        else if (word == "--large-points-2d") options_.large_points_2d = number(0);
        else if (word == "--large-points-3d") options_.large_points_3d = number(0);
        else if (word == "--self-test") options_.task = Task::self_test;
        else if (word == "--help" || word == "-h") options_.task = Task::help;
        else throw std::runtime_error("unknown argument " + word + " (--help lists them)");
    }

    const std::string &value() {
        if (at_ + 1 >= words_.size()) throw std::runtime_error(words_[at_] + " wants a value");
        return words_[++at_];
    }

    std::size_t number(std::size_t least) {
        const std::string name = words_[at_];
        const std::string &text = value();
        char *end = nullptr;
        errno = 0;
        const unsigned long long parsed = std::strtoull(text.c_str(), &end, 10);
        const bool is_number = !text.empty() && text[0] >= '0' && text[0] <= '9' && *end == '\0' && errno == 0;
        if (!is_number || parsed < least)
            throw std::runtime_error(name + " wants a number of at least " + std::to_string(least) + ", not " + text);
        return parsed;
    }

    double magnitude() {
        const std::string &text = value();
        char *end = nullptr;
        const double parsed = std::strtod(text.c_str(), &end);
        if (text.empty() || *end != '\0' || !(parsed > 0) || !(parsed < 1))
            throw std::runtime_error("--snap wants a number between 0 and 1, not " + text);
        return parsed;
    }

    void take_preset() {
        const std::string name = one_of({"quick", "full", "smoke"}, value());
        options_.preset = name == "full" ? full : name == "smoke" ? smoke : quick;
    }

    static std::string one_of(const std::vector<std::string> &known, const std::string &name) {
        if (std::find(known.begin(), known.end(), name) != known.end()) return name;
        std::string message = "unknown name " + name + "; known are";
        for (const std::string &other : known) message += " " + other;
        throw std::runtime_error(message);
    }

    static std::string engine(const std::string &name) {
        std::vector<std::string> known;
        for (const EngineKind &kind : engine_kinds()) {
            if (std::find(known.begin(), known.end(), kind.engine) == known.end()) known.push_back(kind.engine);
            known.push_back(kind.name());
        }
        return one_of(known, name);
    }

    SeriesFile &last_series() {
        if (options_.series.empty()) throw std::runtime_error(words_[at_] + " wants a --series before it");
        return options_.series.back();
    }

    void finish() {
        for (const SeriesFile &file : options_.series)
            if (file.displacement_path.empty() != (file.n_steps == 0))
                throw std::runtime_error("--displacement and --steps go together");
        if (!threads_.empty()) options_.threads = threads_;
        if (n_repeats_ > 0) options_.preset.n_repeats = static_cast<unsigned>(n_repeats_);
        if (n_checks_ > 0) options_.preset.n_checks = options_.n_series_checks = n_checks_;
        if (n_slow_timestamps_ > 0)
            options_.preset.n_slow_timestamps = options_.n_series_slow_timestamps = n_slow_timestamps_;
        options_.report_timestamps = n_timestamps_;
        if (n_timestamps_ > 0) options_.preset.lloyd_timestamps = options_.preset.walk_timestamps = n_timestamps_;
        const std::vector<std::string> &known =
            options_.task == Task::report ? report_scenario_names() : scenario_names;
        for (const std::string &scenario : options_.scenarios)
            if (std::find(known.begin(), known.end(), scenario) == known.end())
                throw std::runtime_error("the scenario " + scenario + " is for runs " +
                                         (options_.task == Task::report ? "without" : "with") + " --report");
        if (options_.scenarios.empty() && options_.series.empty()) options_.scenarios = known;
    }

    std::vector<std::string> words_;
    std::size_t at_ = 0;
    std::size_t n_repeats_ = 0;
    std::size_t n_timestamps_ = 0;
    std::size_t n_checks_ = 0;
    std::size_t n_slow_timestamps_ = 0;
    std::vector<unsigned> threads_;
    Options options_;
};

}  // namespace

const std::vector<std::string> &report_scenario_names() {
    static const std::vector<std::string> names = {"lloyd_2d_uniform", "lloyd_2d_r2", "lloyd_2d_x2", "lloyd_2d_sin2",
                                                   "slloyd",           "snodt",       "man",         "share_2d",
                                                   "share_3d",         "walk_2d",     "walk_3d"};
    return names;
}

Options parse_options(int n_arguments, char **arguments) { return Parser(n_arguments, arguments).parse(); }

}  // namespace bench
