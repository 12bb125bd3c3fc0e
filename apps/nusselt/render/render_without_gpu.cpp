#include "render_backend.h"

#include <stdexcept>

namespace nusselt::app {

namespace {

constexpr const char* kReason = "this program was built without GPU support; install libvulkan-dev and "
                                "glslang-tools, then configure and build again";

} // namespace

std::optional<std::string> why_not_on_gpu(const RenderOptions&, const render::RenderSettings&) {
    return kReason;
}

std::unique_ptr<render::Backend> make_gpu_backend(const RenderOptions&) { throw std::runtime_error(kReason); }

} // namespace nusselt::app
