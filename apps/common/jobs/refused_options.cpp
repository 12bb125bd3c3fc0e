#include "refused_options.h"

#include <CLI/CLI.hpp>

namespace nusselt::app {

namespace {

const std::vector<RefusedOption> kRefused = {{"--output", "use the option -o of submit"},
                                             {"--part", "submit divides the work itself"},
                                             {"--checkpoint", "each task has one"},
                                             {"--threads", "use the option --threads of submit"},
                                             {"--json", "each task would write the same file"},
                                             {"--display-server", "tasks run on other machines"},
                                             {"--backend", "tasks run on the CPU"}};

bool means(const std::string& word, const std::string& option) {
    if (word == option || word.starts_with(option + "=")) return true;
    // Letters may be joined, such as -qo FILE.
    return option == "--output" && word.size() > 1 && word[0] == '-' && word[1] != '-' &&
           word.find('o') != std::string::npos;
}

} // namespace

void refuse_options(const Words& words, const std::vector<RefusedOption>& more) {
    std::vector<RefusedOption> all = more;
    all.insert(all.end(), kRefused.begin(), kRefused.end());
    for (const std::string& word : words)
        for (const RefusedOption& option : all)
            if (means(word, option.name))
                throw CLI::ValidationError(option.name, "not supported behind --: " + option.instead);
}

} // namespace nusselt::app
