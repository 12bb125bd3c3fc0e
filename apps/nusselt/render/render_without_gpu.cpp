#include "render_backend.h"

#include <stdexcept>

namespace nusselt::app {

bool renders_on_gpu(const RenderOptions& options, const render::RenderSettings&) {
    if (options.backend != "vulkan") return false;
    throw std::runtime_error("this program was built without its GPU side: install libvulkan-dev and "
                             "glslang-tools, then configure "
                             "and build again");
}

int render_on_gpu(const RenderOptions&, const render::RenderSettings&, const scene::Scene&, Times,
                  std::chrono::steady_clock::time_point) {
    throw std::logic_error("there is no GPU side");
}

} // namespace nusselt::app
