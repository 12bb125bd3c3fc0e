#include "image/coded_file.h"

#include "image/codecs.h"

#include <stb/stb_image.h>

#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

namespace nusselt::image {

namespace {

[[noreturn]] void fail_with_reason() {
    throw std::runtime_error(std::string("this is no PNG, JPG, TGA or BMP that can be decoded (") +
                             stbi_failure_reason() + "); check its name and whether it is complete");
}

const stbi_uc* bytes_of(std::string_view file) { return reinterpret_cast<const stbi_uc*>(file.data()); }

/// \param codes  from stb, which owns the memory; null if decoding failed
template <class Code>
std::vector<float> linear_values(Code* codes, std::size_t pixel_count, int channels,
                                 const std::function<double(double)>& to_linear) {
    if (codes == nullptr) fail_with_reason();
    const std::unique_ptr<Code, void (*)(void*)> owner(codes, stbi_image_free);
    constexpr std::size_t kLargest = std::numeric_limits<Code>::max();
    std::vector<float> color(kLargest + 1);
    for (std::size_t code = 0; code <= kLargest; ++code)
        color[code] = static_cast<float>(to_linear(static_cast<double>(code) / double(kLargest)));

    const auto stride = static_cast<std::size_t>(channels);
    std::vector<float> values(pixel_count * stride);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = color[codes[i]];
    if (stride % 2 != 0) return values;
    for (std::size_t i = stride - 1; i < values.size(); i += stride)
        values[i] = static_cast<float>(codes[i]) / float(kLargest);
    return values;
}

} // namespace

CodedHeader read_coded_header(std::string_view file) {
    if (file.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw std::runtime_error("files above 2 GiB are not supported");
    CodedHeader header;
    if (stbi_info_from_memory(bytes_of(file), int(file.size()), &header.width, &header.height,
                              &header.channels) == 0)
        fail_with_reason();
    check_coded_file(file, header.width, header.height);
    return header;
}

std::vector<float> decode_codes(std::string_view file, int channels,
                                const std::function<double(double)>& to_linear) {
    const int size = static_cast<int>(file.size());
    int width = 0;
    int height = 0;
    int channels_in_file = 0;
    const auto decode = [&](auto load) {
        auto* const codes = load(bytes_of(file), size, &width, &height, &channels_in_file, channels);
        const std::size_t pixel_count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        return linear_values(codes, pixel_count, channels, to_linear);
    };
    return stbi_is_16_bit_from_memory(bytes_of(file), size) != 0 ? decode(stbi_load_16_from_memory)
                                                                 : decode(stbi_load_from_memory);
}

} // namespace nusselt::image
