#include "lab/report/run_settings.h"

#include "render_cpu/renderer.h"

namespace nusselt::lab {

int thread_count(const RunSettings& settings) {
    return settings.threads > 0 ? settings.threads : render_cpu::default_thread_count();
}

} // namespace nusselt::lab
