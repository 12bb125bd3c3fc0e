#include "image/formats/code_rows.h"

#include "image/image.h"

#include <stdexcept>

namespace nusselt::image {

void fail_as_cut_off() {
    throw std::runtime_error("the file is too small for its pixels; it may be truncated");
}

void check_claims(std::string_view file, const CodedHeader& header, double pixels_per_byte) {
    check_size(header.width, header.height);
    if (double(header.width) * double(header.height) > pixels_per_byte * double(file.size()))
        fail_as_cut_off();
}

CodeRows::CodeRows(const CodedHeader& header, int channels, const std::function<double(double)>& to_linear)
    : header_(header), channels_(static_cast<std::size_t>(channels)), linear_(std::size_t(1) << header.bits) {
    const double largest = static_cast<double>(linear_.size() - 1);
    for (std::size_t code = 0; code < linear_.size(); ++code)
        linear_[code] = static_cast<float>(to_linear(static_cast<double>(code) / largest));
    texels_.reserve(channels_ * static_cast<std::size_t>(header.width) *
                    static_cast<std::size_t>(header.height));
}

} // namespace nusselt::image
