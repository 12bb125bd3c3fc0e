#include "base/json_output.h"

#include "base/atomic_file.h"

#include <fmt/core.h>

#include <fstream>

namespace nusselt::base {

void write_json(const std::string& target, const std::string& json) {
    if (target == "-")
        fmt::print("{}", json);
    else
        write_atomically(target, [&](std::ofstream& stream) { stream << json; });
}

} // namespace nusselt::base
