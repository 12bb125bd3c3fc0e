#include "bench_output.h"

#include "base/json_output.h"

namespace nusselt::app {

void add_repetitions_option(CLI::App& command, int& repetitions) {
    command.add_option("--repetitions", repetitions, "Interleaved repetitions, of which the median counts")
        ->check(CLI::Range(1, 10001))
        ->capture_default_str();
}

void add_json_option(CLI::App& command, std::optional<std::string>& json) {
    command.add_option("--json", json, "Write the table as JSON to this file; - for the standard output");
}

void write_results(const std::optional<std::string>& file, const std::string& json,
                   const std::function<void()>& print_table) {
    if (file != "-") print_table();
    if (file) base::write_json(*file, json);
}

} // namespace nusselt::app
