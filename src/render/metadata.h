#pragma once
/// What image files say about how they were made.

#include "image/image.h"
#include "render/settings.h"
#include "scene/model/scene.h"

namespace nusselt::render {

/// Settings, program version and a fingerprint of the scene.
image::Metadata make_metadata(const scene::Scene& scene, const RenderSettings& settings);

} // namespace nusselt::render
