#include "render/memory.h"

#include "base/memory_text.h"

#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace nusselt::render {

namespace {

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

void check_memory(std::size_t bytes, const std::string& what, const std::string& remedy) {
    const double available = allowed_memory();
    if (static_cast<double>(bytes) <= available) return;
    throw std::runtime_error(what + " needs " + base::memory_text(static_cast<double>(bytes)) +
                             " of memory, more than the " + base::memory_text(available) +
                             " of this machine; " + remedy);
}

} // namespace nusselt::render
