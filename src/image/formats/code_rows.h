#pragma once
/// The way from the codes in files to texels: what decoders of PNG, JPG, TGA and BMP have in common.

#include "image/coded_file.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace nusselt::image {

/// Fails unless the size is supported and the file large enough.
/// \param file_size        in bytes
/// \param pixels_per_byte  the largest number that the format can store in a byte
void check_claims(std::int64_t file_size, const CodedHeader& header, double pixels_per_byte);

/// The place of the pixels of a decoded row.
struct RowPlace {
    std::size_t y = 0; ///< counted from the top
    std::size_t x = 0; ///< of the first pixel
    std::size_t step = 1;
};

/// Takes rows of codes and makes texels of them. Memory is touched only as rows arrive.
class CodeRows {
public:
    /// \param channels, to_linear  see decode_codes()
    CodeRows(const CodedHeader& header, int channels, const std::function<double(double)>& to_linear);

    const CodedHeader& header() const { return header_; }

    /// \tparam Code  std::uint8_t or std::uint16_t, as the header says
    /// \param codes  `count` pixels with the channels of the header
    template <class Code>
    void put(const Code* codes, std::size_t count, RowPlace place);

    Texels take() { return {static_cast<int>(channels_), std::move(texels_)}; }

private:
    template <class Code>
    bool needs_alpha(const Code* codes, std::size_t count) const;
    void add_alpha();

    CodedHeader header_;
    std::size_t colours_;       ///< channels of the texels without alpha
    bool may_have_alpha_;       ///< whether both the file and the texels are to have it
    std::size_t channels_;      ///< of the texels so far: most files with alpha are opaque and never need it
    std::vector<float> linear_; ///< the texel value of each code
    std::vector<float> texels_;
};

/// Whether an alpha other than 1 is the first one.
template <class Code>
bool CodeRows::needs_alpha(const Code* codes, std::size_t count) const {
    if (!may_have_alpha_ || channels_ > colours_) return false;
    const auto source_channels = static_cast<std::size_t>(header_.channels);
    for (std::size_t i = 0; i < count; ++i)
        if (codes[(i + 1) * source_channels - 1] != linear_.size() - 1) return true;
    return false;
}

template <class Code>
void CodeRows::put(const Code* codes, std::size_t count, RowPlace place) {
    const auto source_channels = static_cast<std::size_t>(header_.channels);
    const bool has_colour = source_channels >= 3;

    if (needs_alpha(codes, count)) add_alpha();
    const std::size_t row_size = channels_ * static_cast<std::size_t>(header_.width);
    if (texels_.size() < (place.y + 1) * row_size) texels_.resize((place.y + 1) * row_size);
    float* texel = texels_.data() + place.y * row_size + place.x * channels_;
    for (std::size_t i = 0; i < count; ++i, codes += source_channels, texel += place.step * channels_) {
        for (std::size_t c = 0; c < colours_; ++c) texel[c] = linear_[codes[has_colour ? c : 0]];
        if (channels_ > colours_)
            texel[colours_] = float(codes[source_channels - 1]) / float(linear_.size() - 1);
    }
}

} // namespace nusselt::image
