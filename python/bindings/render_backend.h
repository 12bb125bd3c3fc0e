#pragma once
/// The choice of the renderer.

#include "render/backend.h"

#include <memory>
#include <optional>
#include <string>

namespace nusselt::python {

/// What chooses a renderer. Settings of the other one must not be given.
struct BackendChoice {
    std::string name = "cpu"; ///< "cpu", "vulkan" or "auto"
    std::optional<int> threads;
    std::optional<std::string> isa;
    std::optional<std::string> device; ///< of the GPU: index, or part of a name
    std::optional<std::string> shadow_rays;
};

/// "auto" chooses a GPU if there is one (software devices do not count) that supports the scene with these settings, and
/// the processor otherwise.
/// \throws std::invalid_argument if the choice contradicts itself
/// \throws std::runtime_error if the renderer is not there
std::unique_ptr<render::Backend> make_backend(const BackendChoice& choice, const scene::Scene& scene,
                                              const render::RenderSettings& settings);

// Defined in gpu_backend.cpp, or in without_gpu.cpp if the module is built without GPU support.

/// Whether "auto" should try a GPU for such settings.
bool is_for_gpu(const BackendChoice& choice, const render::RenderSettings& settings);

/// \throws std::runtime_error if there is no such device
std::unique_ptr<render::Backend> make_gpu_backend(const BackendChoice& choice);

} // namespace nusselt::python
