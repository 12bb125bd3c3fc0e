#pragma once
/// The file formats behind read_image() and write_image(). Errors are std::exceptions that describe the
/// contents; io.cpp adds the path.

#include "image/image.h"
#include "image/layers.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::image {

/// Bytes from the position of the stream, which stays, to its end.
std::int64_t remaining_bytes(std::istream& stream);

/// Reports that there is no memory for the floats of an image.
[[noreturn]] void fail_for_memory(int width, int height, std::int64_t channels);

/// Runs the part of a decoder whose memory grows with the image.
/// \throws std::runtime_error  with the size of the image, if there is not enough memory
template <class Decoder>
auto with_memory_for(int width, int height, std::int64_t channels, const Decoder& decode) {
    try {
        return decode();
    } catch (const std::bad_alloc&) {
        fail_for_memory(width, height, channels);
    }
}

Image decode_exr(std::ifstream& stream);
LayeredImage decode_exr_layers(std::ifstream& stream);
/// Of packed tiles, nothing but these; see packed_tiles.h.
LayeredImage decode_exr_packed_layers(std::ifstream& stream);
LayeredImage decode_exr_layer(std::ifstream& stream, std::string_view layer);
LayeredImage decode_exr_layer_list(std::ifstream& stream);
Metadata decode_exr_metadata(std::ifstream& stream);
/// write_layers() of a picture, without a copy of its pixels.
void write_exr(const std::filesystem::path& path, const Image& picture, const Metadata& metadata);

void encode_hdr(std::ostream& stream, const Image& image);
Image decode_hdr(std::istream& stream);

/// 32-bit floats, little endian.
void encode_pfm(std::ostream& stream, const Image& image);
/// Colour or grey, in both orders of bytes; values are multiplied by the absolute value of the scale.
Image decode_pfm(std::istream& stream);

/// \param scale  factor before the transfer function
void encode_png(std::ostream& stream, const Image& image, double scale);
/// \param codes  three bytes per pixel, stored as they are
void encode_png_codes(std::ostream& stream, int width, int height, const std::vector<unsigned char>& codes);
/// PNG, JPG or TGA, whichever the contents are. Of the file, it keeps a few rows in memory.
Image decode_srgb(std::istream& stream);

} // namespace nusselt::image
