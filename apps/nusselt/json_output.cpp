#include "json_output.h"

#include "image/atomic_file.h"

#include <fmt/core.h>

#include <fstream>

namespace nusselt::app {

void write_json(const std::string& target, const std::string& json) {
    if (target == "-")
        fmt::print("{}", json);
    else
        image::write_atomically(target, [&](std::ofstream& stream) { stream << json; });
}

} // namespace nusselt::app
