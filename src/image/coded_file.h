#pragma once
/// Images that files store as integers, which stand for fractions of light after some transfer function.

#include <functional>
#include <string_view>
#include <vector>

namespace nusselt::image {

/// The properties of the pixels in a PNG, JPG, TGA or BMP file.
struct CodedHeader {
    int width = 0;
    int height = 0;
    int channels = 0; ///< 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha
    int bits = 8;     ///< of a code after decoding: 8 or 16
};

/// Takes no memory for pixels. \param file the contents of a PNG, JPG, TGA or BMP file, whichever it is
/// \throws std::runtime_error  describing the contents, if this is no such file, if it has more than kMaxPixelCount
///                             pixels or cannot have as many as it claims
[[nodiscard]] CodedHeader read_coded_header(std::string_view file);

/// The pixels, row 0 on top, the channels of a pixel side by side.
/// \param file       see read_coded_header(), which must have accepted it
/// \param channels   of the result, as in CodedHeader; 3 or 4 for files with colour
/// \param to_linear  transfer function of codes in [0, 1], which does not apply to alpha
/// \throws std::runtime_error  describing the contents, if they are damaged
[[nodiscard]] std::vector<float> decode_codes(std::string_view file, int channels,
                                              const std::function<double(double)>& to_linear);

} // namespace nusselt::image
