#include "base/distinct_files.h"

#include <stdexcept>

namespace nusselt::base {

void check_distinct(const std::vector<std::filesystem::path>& outputs,
                    const std::vector<std::filesystem::path>& inputs) {
    std::vector<std::filesystem::path> files = outputs;
    files.insert(files.end(), inputs.begin(), inputs.end());
    std::vector<std::filesystem::path> places;
    for (const std::filesystem::path& file : files)
        places.push_back(std::filesystem::weakly_canonical(absolute(file)));
    for (std::size_t i = 0; i < outputs.size(); ++i)
        for (std::size_t j = i + 1; j < files.size(); ++j)
            if (places[i] == places[j])
                throw std::runtime_error("'" + files[i].string() + "' is an output and also " +
                                         (j < outputs.size() ? "another output" : "an input") +
                                         "; change one of the names");
}

} // namespace nusselt::base
