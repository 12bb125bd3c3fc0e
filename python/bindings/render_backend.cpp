#include "python/bindings/render_backend.h"

#include "render_cpu/backend.h"
#include "render_cpu/renderer.h"

#include <stdexcept>
#include <tuple>

namespace nusselt::python {

namespace {

void check(const BackendChoice& choice) {
    const bool is_auto = choice.name == "auto";
    const bool is_gpu = choice.name == "vulkan";
    if (!is_auto && !is_gpu && choice.name != "cpu")
        throw std::invalid_argument("backend: unknown renderer '" + choice.name +
                                    "'; use cpu, vulkan or auto");
    for (const auto& [name, is_given, fits] :
         {std::tuple("isa", choice.isa.has_value(), !is_gpu),
          std::tuple("device", choice.device.has_value(), is_gpu || is_auto),
          std::tuple("shadow_rays", choice.shadow_rays.has_value(), is_gpu || is_auto)})
        if (is_given && !fits)
            throw std::invalid_argument(std::string(name) + " is not supported with backend=\"" +
                                        choice.name + '"');
}

std::unique_ptr<render::Backend> make_cpu_backend(const BackendChoice& choice) {
    const int threads = render_cpu::checked_thread_count(choice.threads);
    try {
        return std::make_unique<render_cpu::CpuBackend>(base::choose_isa(choice.isa), threads);
    } catch (const std::runtime_error& error) {
        if (!choice.isa) throw; // of the environment
        throw std::invalid_argument(std::string("isa: ") + error.what());
    }
}

} // namespace

std::unique_ptr<render::Backend> make_backend(const BackendChoice& choice, const scene::Scene& scene,
                                              const render::RenderSettings& settings) {
    check(choice);
    if (choice.name == "vulkan") return make_gpu_backend(choice);
    if (choice.name == "auto" && !choice.isa && is_for_gpu(choice, settings)) {
        std::unique_ptr<render::Backend> gpu = make_gpu_backend(choice);
        if (!gpu->why_unsupported(scene, settings)) return gpu;
    }
    return make_cpu_backend(choice);
}

} // namespace nusselt::python
