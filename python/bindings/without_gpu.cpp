#include "python/bindings/render_backend.h"

#include <stdexcept>

namespace nusselt::python {

std::unique_ptr<render::Backend> make_gpu_backend(const BackendChoice&) {
    throw std::runtime_error("this module was built without GPU support; install libvulkan-dev and "
                             "glslang-tools, then build again");
}

} // namespace nusselt::python
