#include "python/bindings/render_backend.h"

#include <stdexcept>

namespace nusselt::python {

bool is_for_gpu(const BackendChoice&, const render::RenderSettings&) { return false; }

std::unique_ptr<render::Backend> make_gpu_backend(const BackendChoice&) {
    throw std::runtime_error("this module was built without GPU support; install libvulkan-dev and "
                             "glslang-tools, then build again");
}

} // namespace nusselt::python
