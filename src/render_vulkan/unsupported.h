#pragma once
/// What GPUs do not render. Reasons do not say what to do instead: for some programs it is `--backend cpu`.

#include "render/settings.h"
#include "render_vulkan/scene_records.h"
#include "scene/model/scene.h"

#include <optional>
#include <string>

namespace nusselt::render_vulkan {

/// Names the first setting that GPUs do not support for any scene; nothing if they support all.
std::optional<std::string> why_unsupported(const render::RenderSettings& settings);

/// The same for a scene with features, whose lights GPUs support.
std::optional<std::string> why_unsupported(const SceneKinds& kinds, const render::RenderSettings& settings);

/// The same for a scene: names its first light that GPUs do not support, if it has one.
std::optional<std::string> why_unsupported(const scene::Scene& scene, const render::RenderSettings& settings);

} // namespace nusselt::render_vulkan
