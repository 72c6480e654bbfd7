// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.hpp"

#include "domains.hpp"
#include "engine.hpp"
#include "structured.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace bench {
namespace {

const std::map<std::string, Preset> presets = {
    {"quick",
     {"quick", 1000, 50, 5, 10, 3, {1'000, 10'000, 100'000, 1'000'000}, {1'000, 10'000, 100'000}, {10'000},
      {10'000, 100'000}, false}},
    {"full",
     {"full", 1000, 1000, 20, 20, 3, {1'000, 10'000, 100'000, 1'000'000}, {1'000, 10'000, 100'000},
      {5'000, 40'000, 200'000}, {10'000, 100'000}, true}},
    {"smoke", {"smoke", 20, 5, 2, 2, 1, {1'000}, {1'000}, {500}, {1'000}, true}},
};

const std::vector<std::string> scenario_names = {"lloyd_2d_uniform", "walk_3d", "static_2d", "static_3d",
                                                 "step_2d",          "step_3d", "lists_2d",  "lists_3d"};

std::vector<std::string> all_scenario_names() {
    std::vector<std::string> names = scenario_names;
    names.insert(names.end(), report_scenario_names().begin(), report_scenario_names().end());
    return names;
}

std::vector<std::string> engine_names() {
    std::vector<std::string> names;
    for (const EngineKind &kind : engine_kinds()) {
        if (std::find(names.begin(), names.end(), kind.engine) == names.end()) names.push_back(kind.engine);
        names.push_back(kind.name());
    }
    return names;
}

class CommandLine {
public:
    explicit CommandLine(Options &options) : options_(options) {
        app_.get_formatter()->column_width(27);
        app_.option_defaults()->take_last();
        add_inputs();
        add_efforts();
        add_outputs();
        add_tasks();
    }

    void parse(int n_arguments, char **arguments) {
        try {
            app_.parse(n_arguments, arguments);
            finish();
        } catch (const CLI::CallForHelp &) {
            options_.task = Task::help;
            options_.help = app_.help();
        }
    }

private:
    template <typename Value>
    CLI::Option *add(const char *name, const char *placeholder, Value &value, const std::string &description) {
        return app_.add_option(name, value, description)->option_text(placeholder)->allow_extra_args(false);
    }

    /// The upper bound is there because CLI11 reads negative numbers, and too large ones, as the largest.
    template <typename Value>
    CLI::Option *add_number(const char *name, Value &value, std::int64_t least, const char *description) {
        const std::int64_t greatest = 1'000'000'000'000'000'000;
        return add(name, "N", value, description)->check(CLI::Range(least, greatest));
    }

    /// Whenever such an option is met, `take` is called, so that it can know what came before.
    template <typename Value, typename Take>
    void add_in_order(const char *name, const char *placeholder, Take take, const char *description) {
        app_.add_option_function<Value>(name, take, description)->option_text(placeholder)->trigger_on_parse();
    }

    void add_inputs() {
        add("--scenario", "NAME", options_.scenarios,
            fmt::format("only this one; may be repeated\n{}", fmt::join(scenario_names, ", ")))
            ->take_all()
            ->check(CLI::IsMember(all_scenario_names()));
        add_in_order<std::string>(
            "--series", "FILE.npy", [this](const std::string &path) { options_.series.push_back({path, {}, 0}); },
            "replay recorded positions, frames x points x dimension, f64 or f32; may be repeated.\n"
            "An array of points x dimension is a point set, built once.\n"
            "Without --scenario, only the series are run");
        add_in_order<std::string>(
            "--displacement", "FILE.npy",
            [this](const std::string &path) { last_series("--displacement").displacement_path = path; },
            "displaces the points of the --series before it ...");
        add_in_order<unsigned>(
            "--steps", "N", [this](unsigned n) { last_series("--steps").n_steps = n; },
            "... in so many equal steps");
        add("--snap", "MAGNITUDE", options_.snap,
            "coordinates of series files that are smaller than this become 0, for every engine")
            ->check(CLI::Range(0.0, 1.0));
        add("--engine", "NAME", options_.engines,
            "only this one (cgal, deldrift, or as in deldrift/auto); may be repeated.\n"
            "CGAL's rebuilding, the baseline, always runs. deldrift/watching and deldrift/slack run\n"
            "where named in full only")
            ->take_all()
            ->check(CLI::IsMember(engine_names()));
        add("--target", "NAME", options_.targets,
            "with --targets: only this one, named as in the column target; may be repeated")
            ->take_all()
            ->check(CLI::IsMember(target_names()));
        add("--point-set", "NAME", options_.point_sets,
            "with --structured: only this one, named as in the column points of structured.csv; may be\n"
            "repeated")
            ->take_all()
            ->check(CLI::IsMember(point_set_names()));
        add("--domain", "NAME", options_.domains, "with --domains: only this one; may be repeated")
            ->take_all()
            ->check(CLI::IsMember(domain_names()));
        add_number("--threads", options_.threads, 1, "number of threads deldrift may use, default 1; may be repeated")
            ->take_all();
        add_number("--seed", options_.seed, 0, "of the generated positions, default 1");
    }

    void add_efforts() {
        add("--preset", "NAME", preset_,
            "how much to do. quick: within ten minutes, with --report too; full: 1,000 timestamps,\n"
            "with --report within half an hour; smoke: just enough to see that everything runs")
            ->check(CLI::IsMember(presets));
        add_number("--repeat", n_repeats_, 1, "time everything so many times and take medians");
        add_number("--timestamps", n_timestamps_, 1, "of the generated series, instead of the preset's");
        add_number("--checks", n_checks_, 1,
                   "compare cells at so many timestamps, instead of the preset's; series files: all");
        add_number("--slow-timestamps", n_slow_timestamps_, 1,
                   "time engines that relocate one vertex after another at so many timestamps in 3D,\n"
                   "instead of the preset's; series files: all");
        add_number("--point-set-size", point_set_sizes_, 100, "other sizes for --structured; may be repeated")
            ->take_all();
        add_number("--large-points-2d", options_.large_points_2d, 0,
                   "other sizes for --large; 0 leaves the dimension out");
        add_number("--large-points-3d", options_.large_points_3d, 0, "the same in 3D");
    }

    void add_outputs() {
        add("--keep-failures", "DIR", options_.keep_failures,
            "write the positions at which a check fails there, as a series to replay");
        results_ = add("--results", "DIR", options_.results,
                       "where CSV files go. Without it, a run of a part (any option but --preset full or quick) writes\n"
                       "to the folder partial in results, and leaves the records of whole runs as they are");
    }

    void add_tasks() {
        CLI::App *tasks = app_.add_option_group("Something else instead")->require_option(0, 1);
        const auto add_task = [&](const char *name, Task task, const char *description) {
            tasks->add_flag_callback(name, [this, task] { options_.task = task; }, description);
        };
        add_task("--report", Task::report,
                 "the inputs of the report RR-6750 with all engines, to report.csv and the files\n"
                 "beside it (make report makes a page of them). What is there for the same commit,\n"
                 "preset and seed is kept, so that a run can be continued. Scenarios:\n"
                 "lloyd_2d_uniform, lloyd_2d_r2, lloyd_2d_x2, lloyd_2d_sin2, slloyd, snodt, man,\n"
                 "share_2d, share_3d, walk_2d, walk_3d");
        add_task("--memory", Task::memory, "bytes per vertex at a million points, to memory.csv");
        add_task("--large", Task::large,
                 "build, validate and commit 50 million points in 2D and 20 million in 3D, to large.csv");
        add_task("--structured", Task::structured,
                 "point sets such as solvers have: lattices, layers, surfaces, graded and clustered clouds,\n"
                 "built and moved, to structured.csv; the last part of a run without --scenario or --series.\n"
                 "With --preset full all sets at three sizes, to structured_full.csv");
        add_task("--domains", Task::domains,
                 "domains whose boundaries are segments, and move, beside CGAL's constrained triangulations,\n"
                 "to domains.csv; a part of a run without --scenario or --series, too");
        add_task("--meshes", Task::meshes,
                 "meshes of domains of the same quality by CGAL's mesher and by deldrift's refinement, from nothing\n"
                 "and of a domain that moves, to meshes.csv; a part of a run without --scenario or --series, too");
        add_task("--boxes", Task::boxes,
                 "boxes that repeat, beside CGAL's periodic triangulations and voro++'s volumes, to boxes.csv; a part of a\n"
                 "run without --scenario or --series, too");
        add_task("--weights", Task::weights,
                 "points with weights, which move, beside CGAL's regular triangulations, rebuilt, to weights.csv;\n"
                 "the smaller sets, as a table alone, are a part of a run without --scenario or --series, too");
        add_task("--targets", Task::targets,
                 "special cases beside the speed-up wanted, to targets.csv: within nine minutes");
        add_task("--self-test", Task::self_test, "test the benchmark's own checks");
    }

    SeriesFile &last_series(const std::string &name) {
        if (options_.series.empty()) throw std::runtime_error(name + " wants a --series before it");
        return options_.series.back();
    }

    void finish() {
        for (const SeriesFile &file : options_.series)
            if (file.displacement_path.empty() != (file.n_steps == 0))
                throw std::runtime_error("--displacement and --steps go together");
        options_.preset = presets.at(preset_);
        if (n_repeats_ > 0) options_.preset.n_repeats = n_repeats_;
        if (n_checks_ > 0) options_.preset.n_checks = options_.n_series_checks = n_checks_;
        if (n_slow_timestamps_ > 0)
            options_.preset.n_slow_timestamps = options_.n_series_slow_timestamps = n_slow_timestamps_;
        options_.report_timestamps = n_timestamps_;
        if (n_timestamps_ > 0) options_.preset.lloyd_timestamps = options_.preset.walk_timestamps = n_timestamps_;
        const std::vector<std::string> &known =
            options_.task == Task::report ? report_scenario_names() : scenario_names;
        for (const std::string &scenario : options_.scenarios)
            if (std::find(known.begin(), known.end(), scenario) == known.end())
                throw std::runtime_error(fmt::format("the scenario {} is for runs {} --report", scenario,
                                                     options_.task == Task::report ? "without" : "with"));
        if (!options_.targets.empty() && options_.task != Task::targets)
            throw std::runtime_error("--target is for runs with --targets");
        if (!options_.domains.empty() && options_.task != Task::domains)
            throw std::runtime_error("--domain is for runs with --domains");
        if (!(options_.point_sets.empty() && point_set_sizes_.empty()) && options_.task != Task::structured)
            throw std::runtime_error("--point-set and --point-set-size are for runs with --structured");
        if (!point_set_sizes_.empty()) options_.preset.structured_sizes = point_set_sizes_;
        if (is_part() && results_->empty()) options_.results += "/partial";
        options_.with_structured =
            options_.task == Task::run && options_.scenarios.empty() && options_.series.empty();
        if (options_.scenarios.empty() && options_.series.empty()) options_.scenarios = known;
    }

    /// Whether this does less than a record has, or something else. The report is continued by its parts.
    bool is_part() const {
        if (options_.task == Task::report) return false;
        const bool is_chosen = !(options_.scenarios.empty() && options_.engines.empty() && options_.targets.empty() &&
                                 options_.point_sets.empty() && options_.domains.empty() &&
                                 options_.series.empty() && point_set_sizes_.empty());
        const bool is_shortened = preset_ == "smoke" || n_repeats_ > 0 || n_timestamps_ > 0 || n_checks_ > 0 ||
                                  n_slow_timestamps_ > 0;
        const Options whole{};
        return is_chosen || is_shortened || options_.threads != whole.threads || options_.seed != whole.seed ||
               options_.snap != whole.snap || options_.large_points_2d != whole.large_points_2d ||
               options_.large_points_3d != whole.large_points_3d;
    }

    Options &options_;
    CLI::Option *results_ = nullptr;
    CLI::App app_{"deldrift beside CGAL on identical positions.", "cpp-bench/run"};
    std::string preset_ = "quick";
    unsigned n_repeats_ = 0;
    std::size_t n_timestamps_ = 0;
    std::size_t n_checks_ = 0;
    std::size_t n_slow_timestamps_ = 0;
    std::vector<std::size_t> point_set_sizes_;
};

}  // namespace

const std::vector<std::string> &report_scenario_names() {
    static const std::vector<std::string> names = {"lloyd_2d_uniform", "lloyd_2d_r2", "lloyd_2d_x2", "lloyd_2d_sin2",
                                                   "slloyd",           "snodt",       "man",         "share_2d",
                                                   "share_3d",         "walk_2d",     "walk_3d"};
    return names;
}

const std::vector<std::string> &target_names() {
    static const std::vector<std::string> names = {
        "tolerance_test", "half_within", "immediate_still", "converged",     "swept",
        "threads_swept",  "leap_1",      "leap_10",         "threads_build", "step_0",
        "step_1e-5",      "step_1e-4",   "step_1e-3",       "step_1e-2",     "loop",
        "grown_cells",    "grown_star",  "grown_relocate_vertex", "grown_commit_one",
        "lists",          "lists_lattice", "lists_cluster",
        "locate_path",    "locate",      "insert",          "drift_0.03",    "drift_0.1",
        "drift_0.3",      "staged_1",    "staged_10",       "staged_100",    "staged_1000",
        "staged_5%",      "staged_20%",  "tenth_grid",      "tenth_face_centred", "tenth_layers",
        "published_few",  "published_all", "withdrawn_few", "withdrawn_all",
        "tenth_sphere",   "tenth_circle", "shear_grid",     "shear_face_centred", "shear_layers",
        "shear_sphere",   "shear_circle",   "leaping_0.001",  "leaping_0.001_creeping",
        "leaping_0.001_moving", "leaping_0.01", "leaping_0.01_creeping", "leaping_0.01_moving", "leaping_0.1",
        "leaping_0.1_creeping", "leaping_0.1_moving"};
    return names;
}

Options parse_options(int n_arguments, char **arguments) {
    Options options;
    if (const char *folder = std::getenv("DELDRIFT_BENCH_DATA")) options.data = folder;
    if (const char *folder = std::getenv("DELDRIFT_BENCH_RESULTS")) options.results = folder;
    CommandLine(options).parse(n_arguments, arguments);
    return options;
}

}  // namespace bench
