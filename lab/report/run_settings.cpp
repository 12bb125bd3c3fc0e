#include "lab/report/run_settings.h"

#include "render_cpu/renderer.h"

#include <cstdlib>

namespace nusselt::lab {

int thread_count(const RunSettings& settings) {
    return settings.threads > 0 ? settings.threads : render_cpu::default_thread_count();
}

std::optional<std::filesystem::path> published_scenes() {
    const char* const folder = std::getenv("NUSSELT_SCENES");
    if (folder == nullptr || *folder == '\0') return std::nullopt;
    return folder;
}

} // namespace nusselt::lab
