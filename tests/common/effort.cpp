#include "common/effort.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace nusselt_test {

Effort effort() {
    const char* value = std::getenv("NUSSELT_TEST_EFFORT");
    const std::string name = value == nullptr ? "" : value;
    if (name.empty() || name == "quick") return Effort::quick;
    if (name == "full") return Effort::full;
    throw std::runtime_error("NUSSELT_TEST_EFFORT is \"" + name + "\"; choose quick or full");
}

} // namespace nusselt_test
