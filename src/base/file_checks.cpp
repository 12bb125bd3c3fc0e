#include "base/file_checks.h"

#include "base/words.h"

#include <stdexcept>
#include <string>
#include <system_error>

namespace nusselt::base {

void check_exist(const std::vector<std::filesystem::path>& files) {
    std::vector<std::string> missing;
    for (const std::filesystem::path& file : files) {
        std::error_code error; // such as missing permissions, of which readers tell
        if (std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found)
            missing.push_back("'" + file.string() + "'");
    }
    if (!missing.empty())
        throw std::runtime_error((missing.size() == 1 ? "no such file: " : "no such files: ") +
                                 listing(missing, "and"));
}

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
