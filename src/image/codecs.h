#pragma once
/// The file formats behind read_image() and write_image(). Errors are std::exceptions that describe the
/// contents; io.cpp adds the path.

#include "image/image.h"
#include "image/layers.h"

#include <cstdint>
#include <fstream>
#include <string>

namespace nusselt::image {

/// Bytes from the position of the stream, which stays, to its end.
std::int64_t remaining_bytes(std::istream& stream);

/// \param name  of the file, for messages of OpenEXR
Image decode_exr(std::ifstream& stream, const std::string& name);
LayeredImage decode_exr_layers(std::ifstream& stream, const std::string& name);
LayeredImage decode_exr_layer_list(std::ifstream& stream, const std::string& name);
Metadata decode_exr_metadata(std::ifstream& stream, const std::string& name);

void encode_hdr(std::ostream& stream, const Image& image);
Image decode_hdr(std::istream& stream);

/// 32-bit floats, little endian.
void encode_pfm(std::ostream& stream, const Image& image);
/// Colour or grey, in both orders of bytes; values are multiplied by the absolute value of the scale.
Image decode_pfm(std::istream& stream);

/// \param scale  factor before the transfer function
void encode_png(std::ostream& stream, const Image& image, double scale);
/// PNG, JPG or TGA, whichever the contents are.
Image decode_srgb(std::istream& stream);

} // namespace nusselt::image
