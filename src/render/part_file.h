#pragma once
/// What protects parts of an image on their way to whoever merges them.

#include "image/layers.h"

#include <string>

namespace nusselt::render {

/// The key of the metadata with the hash of a part's pixels. Shared folders of many machines may show holes where a machine
/// failed while it wrote; an EXR file without compression has no other means to tell them from black pixels.
inline constexpr const char* kContentHashKey = "content_hash";

/// A hash of names and pixels of all layers, whatever their order: files sort them. It is 16 hexadecimal digits.
std::string content_hash(const image::LayeredImage& image);

} // namespace nusselt::render
