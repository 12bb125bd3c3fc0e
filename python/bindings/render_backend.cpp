#include "python/bindings/render_backend.h"

#include "render_cpu/backend.h"
#include "render_cpu/renderer.h"

#include <stdexcept>
#include <tuple>

namespace nusselt::python {

std::unique_ptr<render::Backend> make_backend(const BackendChoice& choice) {
    const bool is_gpu = choice.name == "vulkan";
    if (!is_gpu && choice.name != "cpu")
        throw std::invalid_argument("backend: unknown renderer '" + choice.name + "'; use cpu or vulkan");
    for (const auto& [name, is_given, fits] :
         {std::tuple("isa", choice.isa.has_value(), !is_gpu),
          std::tuple("device", choice.device.has_value(), is_gpu),
          std::tuple("shadow_rays", choice.shadow_rays.has_value(), is_gpu)})
        if (is_given && !fits)
            throw std::invalid_argument(std::string(name) + " is not supported with backend=\"" +
                                        choice.name + '"');
    if (is_gpu) return make_gpu_backend(choice);
    return std::make_unique<render_cpu::CpuBackend>(base::choose_isa(choice.isa),
                                                    render_cpu::checked_thread_count(choice.threads));
}

} // namespace nusselt::python
