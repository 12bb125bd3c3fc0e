#pragma once
/// What GPUs do not render, or not as the settings say. Reasons do not say what to do instead: for some programs it is `--backend cpu`.

#include "render/settings.h"
#include "render_vulkan/scene_records.h"
#include "scene/model/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace nusselt::render_vulkan {

/// Names the first setting that GPUs do not support for any scene; nothing if they support all.
std::optional<std::string> why_unsupported(const render::RenderSettings& settings);

/// The same for a scene with lights and surfaces of these kinds.
/// \param kinds of a scene that make_light_records() accepts
std::optional<std::string> why_unsupported(const SceneKinds& kinds, const render::RenderSettings& settings);

/// The same for a scene: names the first kind of light that GPUs do not have, or else what its lights do not support.
std::optional<std::string> why_unsupported(const scene::Scene& scene, const render::RenderSettings& settings);

/// Names the lights that GPUs sample by another technique than the settings say.
std::vector<std::string> sampling_warnings(const scene::Scene& scene, const render::RenderSettings& settings);

} // namespace nusselt::render_vulkan
