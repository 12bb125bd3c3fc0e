#include "image/codecs.h"
#include "image/formats/bytes.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <istream>
#include <ostream>
#include <stdexcept>

namespace nusselt::image {

namespace {

struct Header {
    int channel_count;
    std::int64_t width, height;
    float scale; ///< negative for little endian
};

/// The next word of the header and the one byte of white space after it.
std::string read_word(std::istream& stream) {
    constexpr std::size_t kLongestWord = 32;
    std::string word;
    for (int byte = stream.get(); byte != std::istream::traits_type::eof(); byte = stream.get()) {
        const bool is_space = byte == ' ' || byte == '\n' || byte == '\r' || byte == '\t';
        if (is_space && !word.empty()) return word;
        if (is_space) continue;
        word += char(byte);
        if (word.size() > kLongestWord) break;
    }
    throw std::runtime_error("the header is not 'PF', width, height and scale; the file is damaged");
}

template <class Number>
Number read_number(std::istream& stream, const char* name) {
    const std::string word = read_word(stream);
    Number value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
        throw std::runtime_error(std::string("the ") + name + " '" + word + "' is not a number");
    return value;
}

Header read_header(std::istream& stream) {
    char magic[2] = {};
    stream.read(magic, 2);
    if (!stream || magic[0] != 'P' || (magic[1] != 'F' && magic[1] != 'f'))
        throw std::runtime_error("this is not a PFM file, or it is empty; check its name");
    Header header = {magic[1] == 'F' ? 3 : 1, 0, 0, 0};
    header.width = read_number<std::int64_t>(stream, "width");
    header.height = read_number<std::int64_t>(stream, "height");
    header.scale = read_number<float>(stream, "scale");
    check_size(header.width, header.height);
    if (!std::isfinite(header.scale) || header.scale == 0)
        throw std::runtime_error("the scale in the header must be finite and not 0; the file is damaged");
    return header;
}

float float_of(const char* bytes, bool little_endian) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) {
        const std::uint32_t byte = static_cast<unsigned char>(bytes[i]);
        bits |= byte << (little_endian ? 8 * i : 24 - 8 * i);
    }
    return std::bit_cast<float>(bits);
}

} // namespace

void encode_pfm(std::ostream& stream, const Image& image) {
    static_assert(std::endian::native == std::endian::little, "the scale below says so");
    stream << "PF\n" << image.width << " " << image.height << "\n-1.0\n";
    const std::size_t row_size = 3 * std::size_t(image.width);
    for (int y = image.height - 1; y >= 0; --y) {
        stream.write(reinterpret_cast<const char*>(&image.pixels[std::size_t(y) * row_size]),
                     std::streamsize(row_size * sizeof(float)));
    }
}

Image decode_pfm(std::istream& stream) {
    const Header header = read_header(stream);
    const std::int64_t row_bytes = 4 * header.channel_count * header.width;
    if (remaining_bytes(stream) / row_bytes < header.height) fail_as_cut_off();

    Image image = with_memory_for(int(header.width), int(header.height), 3,
                                  [&] { return make_image(int(header.width), int(header.height)); });
    std::vector<char> row(static_cast<std::size_t>(row_bytes));
    const std::size_t width = std::size_t(header.width);
    for (int y = image.height - 1; y >= 0; --y) {
        stream.read(row.data(), row_bytes);
        for (std::size_t i = 0; i < 3 * width; ++i) {
            const std::size_t value = header.channel_count == 3 ? i : i / 3;
            image.pixels[3 * width * std::size_t(y) + i] =
                std::abs(header.scale) * float_of(&row[4 * value], header.scale < 0);
        }
    }
    return image;
}

} // namespace nusselt::image
