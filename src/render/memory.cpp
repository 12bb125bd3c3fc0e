#include "render/memory.h"

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace nusselt::render {

namespace {

constexpr double kGigabyte = 1e9;
constexpr double kMegabyte = 1e6;

double machine_memory() {
    return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
}

/// The limit on the memory of a container, if it has one.
double allowed_memory() {
    double memory = machine_memory();
    std::ifstream limit_file("/sys/fs/cgroup/memory.max");
    double limit = 0;
    if (limit_file >> limit && limit < memory) memory = limit;
    return memory;
}

} // namespace

std::string memory_text(double bytes) {
    if (bytes < kGigabyte)
        return std::to_string(static_cast<std::uint64_t>(std::ceil(bytes / kMegabyte))) + " MB";
    const auto tenths = static_cast<std::uint64_t>(bytes / kGigabyte * 10 + 0.5);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " GB";
}

void check_memory(std::size_t bytes, const std::string& what, const std::string& remedy) {
    const double available = allowed_memory();
    if (static_cast<double>(bytes) <= available) return;
    throw std::runtime_error(what + " needs " + memory_text(static_cast<double>(bytes)) +
                             " of memory, more than the " + memory_text(available) + " of this machine; " +
                             remedy);
}

} // namespace nusselt::render
