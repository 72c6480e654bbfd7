// SPDX-License-Identifier: GPL-3.0-or-later
#include "boxes.hpp"
#include "domains.hpp"
#include "environment.hpp"
#include "meshes.hpp"
#include "options.hpp"
#include "report.hpp"
#include "resources.hpp"
#include "runner.hpp"
#include "self_test.hpp"
#include "structured.hpp"
#include "targets.hpp"
#include "weights.hpp"

#include <fmt/format.h>

#include <exception>
#include <string>

namespace {

std::string joined(int n_arguments, char **arguments) {
    std::string text = "cpp-bench/run";
    for (int i = 1; i < n_arguments; ++i) text += std::string(" ") + arguments[i];
    return text;
}

int perform(const bench::Options &options, const std::string &command) {
    std::string environment = "environment";
    const std::string structured = "_" + bench::structured_name(options.preset);
    switch (options.task) {
        case bench::Task::help: fmt::print("{}", options.help); return 0;
        case bench::Task::self_test: return bench::run_self_test() ? 0 : 1;
        case bench::Task::report: bench::run_report(options); environment += "_report"; break;
        case bench::Task::memory: bench::run_memory(options); environment += "_memory"; break;
        case bench::Task::large: bench::run_large(options); environment += "_large"; break;
        case bench::Task::structured: bench::run_structured(options); environment += structured; break;
        case bench::Task::domains: bench::run_domains(options); environment += "_domains"; break;
        case bench::Task::meshes: bench::run_meshes(options); environment += "_meshes"; break;
        case bench::Task::boxes: bench::run_boxes(options); environment += "_boxes"; break;
        case bench::Task::weights: bench::run_weights(options); environment += "_weights"; break;
        case bench::Task::targets: bench::run_targets(options); environment += "_targets"; break;
        case bench::Task::run:
            bench::run_scenarios(options);
            if (options.with_structured) {
                bench::run_domains(options);
                bench::run_meshes(options);
                bench::run_boxes(options);
                bench::run_weights(options);
            }
            break;
    }
    bench::write_environment(options.results + "/" + environment + ".txt", command);
    if (options.with_structured)
        for (const std::string &part : {structured, std::string("_domains"), std::string("_meshes"), std::string("_boxes")})
            bench::write_environment(options.results + "/environment" + part + ".txt", command);
    return 0;
}

}  // namespace

int main(int n_arguments, char **arguments) {
    try {
        return perform(bench::parse_options(n_arguments, arguments), joined(n_arguments, arguments));
    } catch (const std::exception &error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 1;
    }
}
