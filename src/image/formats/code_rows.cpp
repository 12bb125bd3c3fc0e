#include "image/formats/code_rows.h"

#include "image/formats/bytes.h"
#include "image/image.h"

namespace nusselt::image {

void check_claims(std::int64_t file_size, const CodedHeader& header, double pixels_per_byte) {
    check_size(header.width, header.height);
    if (double(header.width) * double(header.height) > pixels_per_byte * double(file_size)) fail_as_cut_off();
}

CodeRows::CodeRows(const CodedHeader& header, int channels, const std::function<double(double)>& to_linear)
    : header_(header),
      colours_(channels >= 3 ? 3 : 1),
      may_have_alpha_(channels % 2 == 0 && header.channels % 2 == 0),
      channels_(colours_),
      linear_(std::size_t(1) << header.bits) {
    const double largest = static_cast<double>(linear_.size() - 1);
    for (std::size_t code = 0; code < linear_.size(); ++code)
        linear_[code] = static_cast<float>(to_linear(static_cast<double>(code) / largest));
    texels_.reserve((colours_ + (may_have_alpha_ ? 1 : 0)) * static_cast<std::size_t>(header.width) *
                    static_cast<std::size_t>(header.height));
}

void CodeRows::add_alpha() {
    const std::size_t count = texels_.size() / colours_;
    ++channels_;
    texels_.resize(channels_ * count);
    // In place from the end, so that no texel is overwritten before it moves.
    for (std::size_t i = count; i-- > 0;) {
        texels_[channels_ * i + colours_] = 1;
        for (std::size_t c = colours_; c-- > 0;) texels_[channels_ * i + c] = texels_[colours_ * i + c];
    }
}

} // namespace nusselt::image
