#include "image/codecs.h"
#include "image/coded_file.h"
#include "image/srgb.h"

#include <stb/stb_image_write.h>

#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>

namespace nusselt::image {

namespace {

constexpr int kChannelCount = 3;

unsigned char code_from_linear(double linear) {
    return static_cast<unsigned char>(std::lround(255 * display_code(linear)));
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
    const std::string file(std::istreambuf_iterator<char>(stream), {});
    if (file.starts_with("BM"))
        throw std::runtime_error("this is neither PNG, JPG nor TGA; check its name or convert it");
    const CodedHeader header = read_coded_header(file);
    return {header.width, header.height, decode_codes(file, kChannelCount, linear_from_srgb)};
}

} // namespace nusselt::image
