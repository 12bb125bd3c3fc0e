#pragma once
/// Metadata of image files about their origin.

#include "image/image.h"
#include "render/backend.h"
#include "render/settings.h"
#include "scene/model/scene.h"

namespace nusselt::render {

/// Settings, program version and a fingerprint of the scene.
image::Metadata make_metadata(const scene::Scene& scene, const RenderSettings& settings);

/// The same with what the backend adds: all that the bits of an image depend on.
image::Metadata make_metadata(const scene::Scene& scene, const RenderSettings& settings,
                              const Backend& backend);

} // namespace nusselt::render
