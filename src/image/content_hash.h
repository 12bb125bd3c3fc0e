#pragma once
/// A hash by which image files that were damaged are told from those that are as they were written. Shared folders of
/// many machines may show holes where a machine failed while it wrote; an EXR file without compression has no other
/// means to tell them from black pixels.

#include "image/layers.h"

#include <string>

namespace nusselt::image {

/// The key of the metadata with content_hash().
inline constexpr const char* kContentHashKey = "content_hash";

/// A hash of all that merging relies on: windows, names, channels and pixels of all layers, and the metadata that say
/// which pixels these are (tiles, part) and of which samples they are means (samples, seed).
/// \param image layers in any order, for files sort them; channels as readers give them: R, G, B and A first, then by name
/// \returns 16 hexadecimal digits
[[nodiscard]] std::string content_hash(const LayeredImage& image);

/// Writes the hash into the metadata. Whoever changes the image afterwards does that again, or erases the key.
void add_content_hash(LayeredImage& image);

/// \throws std::runtime_error if the image does not have the hash of its content. One without a hash may be damaged, too: where
///                            damage changes the key
void check_content_hash(const LayeredImage& image);

} // namespace nusselt::image
