#pragma once
/// Images that files store as integers, which stand for fractions of light after some transfer function.

#include <functional>
#include <istream>
#include <vector>

namespace nusselt::image {

/// The properties of the pixels in a PNG, JPG, TGA or BMP file.
struct CodedHeader {
    int width = 0;
    int height = 0;
    int channels = 0; ///< 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha
    int bits = 8;     ///< of a code after decoding: 8 or 16
};

/// Takes no memory for pixels.
/// \param file  a PNG, JPG, TGA or BMP file, whichever it is, from its first byte; its position does not matter
/// \throws std::runtime_error  describing the contents, if this is no such file, if it has more than kMaxPixelCount
///                             pixels or cannot have as many as it claims
[[nodiscard]] CodedHeader read_coded_header(std::istream& file);

/// Decoded pixels, row 0 on top, the channels of a pixel side by side.
struct Texels {
    int channels = 0;
    std::vector<float> values;
};

/// Reads row after row, so that the memory in use is that of the result and of a few rows. Progressive JPG files take
/// two bytes more for each pixel and channel.
/// \param file       see read_coded_header(), which must have accepted it
/// \param channels   of the result, as in CodedHeader; 3 or 4 for files with colour. There is one less if they include
///                   an alpha that is 1 everywhere.
/// \param to_linear  transfer function of codes in [0, 1], which does not apply to alpha
/// \throws std::runtime_error  describing the contents if they are damaged, or the size if there is not enough memory
[[nodiscard]] Texels decode_codes(std::istream& file, int channels,
                                  const std::function<double(double)>& to_linear);

} // namespace nusselt::image
