#pragma once
/// Metadata of image files about their origin.

#include "image/image.h"
#include "image/layers.h"
#include "render/backend.h"
#include "render/settings.h"
#include "scene/model/scene.h"

#include <string>

namespace nusselt::render {

/// Settings, program version and a fingerprint of the scene.
image::Metadata make_metadata(const scene::Scene& scene, const RenderSettings& settings);

/// The same with what the backend adds: all that the bits of an image depend on.
image::Metadata make_metadata(const scene::Scene& scene, const RenderSettings& settings,
                              const Backend& backend);

/// The key of the metadata with the hash of a part's pixels. Shared folders of many machines may show holes where a machine
/// failed while it wrote; an EXR file without compression has no other means to tell them from black pixels.
inline constexpr const char* kContentHashKey = "content_hash";

/// A hash of names and pixels of all layers, whatever their order: files sort them. It is 16 hexadecimal digits.
std::string content_hash(const image::LayeredImage& image);

} // namespace nusselt::render
