#include "engine.h"

#include <algorithm>
#include <stdexcept>

namespace nusselt::app {

// Each in a file of its own.
extern const Engine kSlurm;
extern const Engine kParallel;
extern const Engine kOpenJobDescription;

const std::vector<const Engine*>& engines() {
    static const std::vector<const Engine*> all = {&kSlurm, &kParallel, &kOpenJobDescription};
    return all;
}

const Engine& engine_of(std::string_view name) {
    const auto found = std::find_if(engines().begin(), engines().end(),
                                    [&](const Engine* engine) { return engine->name == name; });
    if (found == engines().end()) throw std::logic_error("unknown engine");
    return **found;
}

std::vector<std::string> engine_names() {
    std::vector<std::string> names;
    for (const Engine* engine : engines()) names.emplace_back(engine->name);
    return names;
}

std::string engine_descriptions() {
    std::string text;
    for (const Engine* engine : engines())
        text +=
            (text.empty() ? "" : "; ") + std::string(engine->name) + ", " + std::string(engine->description);
    return text;
}

} // namespace nusselt::app
