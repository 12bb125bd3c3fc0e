#include "path_list.h"

#include <fstream>
#include <stdexcept>

namespace nusselt::app {

void add_list_option(CLI::App& command, std::optional<std::filesystem::path>& list, const std::string& what) {
    command
        .add_option("--list", list,
                    "File with the paths of more " + what +
                        ", one per line: there may be more of them than a command line can have")
        ->type_name("FILE")
        ->default_str("none");
}

std::vector<std::filesystem::path> with_listed(std::vector<std::filesystem::path> paths,
                                               const std::optional<std::filesystem::path>& list) {
    if (!list) return paths;
    std::ifstream stream(*list);
    if (!stream)
        throw std::runtime_error("cannot read the list '" + list->string() +
                                 "'; check the path and its permissions");
    for (std::string line; std::getline(stream, line);)
        if (!line.empty()) paths.emplace_back(line);
    if (paths.empty()) throw std::runtime_error("the list '" + list->string() + "' is empty; name a file");
    return paths;
}

} // namespace nusselt::app
