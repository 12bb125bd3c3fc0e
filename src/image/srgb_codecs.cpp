#include "image/codecs.h"
#include "image/srgb.h"

#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <iterator>
#include <limits>
#include <memory>
#include <ostream>
#include <stdexcept>

namespace nusselt::image {

namespace {

constexpr int kChannelCount = 3;

unsigned char code_from_linear(double linear) {
    return static_cast<unsigned char>(std::lround(255 * display_code(linear)));
}

/// \param codes  from stb, which owns the memory; null if decoding failed
template <class Code>
Image linear_image(Code* codes, int width, int height) {
    const std::unique_ptr<Code, void (*)(void*)> owner(codes, stbi_image_free);
    if (codes == nullptr) {
        throw std::runtime_error(std::string("no PNG, JPG or TGA that can be decoded (") +
                                 stbi_failure_reason() + "); check its name and whether it is complete");
    }
    constexpr std::size_t kLargestCode = std::numeric_limits<Code>::max();
    std::vector<float> linear_from_code(kLargestCode + 1);
    for (std::size_t code = 0; code <= kLargestCode; ++code)
        linear_from_code[code] = float(linear_from_srgb(double(code) / double(kLargestCode)));

    Image image = make_image(width, height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = linear_from_code[codes[i]];
    return image;
}

} // namespace

void encode_png(std::ostream& stream, const Image& image, double scale) {
    std::vector<unsigned char> codes(image.pixels.size());
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = code_from_linear(scale * double(image.pixels[i]));
    const auto append = [](void* sink, void* data, int size) {
        static_cast<std::ostream*>(sink)->write(static_cast<const char*>(data), size);
    };
    if (stbi_write_png_to_func(append, &stream, image.width, image.height, kChannelCount, codes.data(),
                               kChannelCount * image.width) == 0)
        throw std::bad_alloc();
}

Image decode_srgb(std::istream& stream) {
    if (remaining_bytes(stream) > std::numeric_limits<int>::max())
        throw std::runtime_error("files above 2 GiB are not supported");
    const std::vector<char> file(std::istreambuf_iterator<char>(stream), {});
    const auto* bytes = reinterpret_cast<const stbi_uc*>(file.data());
    const int size = int(file.size());
    int width = 0;
    int height = 0;
    int channels_in_file = 0;
    if (stbi_info_from_memory(bytes, size, &width, &height, &channels_in_file) != 0)
        check_srgb_file(file, width, height);
    if (stbi_is_16_bit_from_memory(bytes, size) != 0) {
        stbi_us* codes =
            stbi_load_16_from_memory(bytes, size, &width, &height, &channels_in_file, kChannelCount);
        return linear_image(codes, width, height);
    }
    stbi_uc* codes = stbi_load_from_memory(bytes, size, &width, &height, &channels_in_file, kChannelCount);
    return linear_image(codes, width, height);
}

} // namespace nusselt::image
