#include "image/codecs.h"
#include "image/formats/bytes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <istream>
#include <locale>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace nusselt::image {

namespace {

/// Three mantissas with a common exponent: a channel is mantissa * 2^(exponent - 136).
using Rgbe = std::array<unsigned char, 4>;

constexpr int kExponentBias = 136;

float clamp_to_format(float value) {
    constexpr float kLargest = 0xFFp+119f; // mantissa 255, exponent 255
    return value > 0 ? std::min(value, kLargest) : 0.0f;
}

Rgbe rgbe_from_rgb(const float* rgb) {
    const std::array<float, 3> v = {clamp_to_format(rgb[0]), clamp_to_format(rgb[1]),
                                    clamp_to_format(rgb[2])};
    const float largest = *std::max_element(v.begin(), v.end());
    int exponent = 0;
    std::frexp(largest, &exponent);
    if (std::nearbyint(std::ldexp(largest, 8 - exponent)) > 255) ++exponent;
    if (largest == 0 || exponent + kExponentBias - 8 <= 0) return {0, 0, 0, 0};
    Rgbe result = {0, 0, 0, static_cast<unsigned char>(exponent + kExponentBias - 8)};
    for (std::size_t c = 0; c < 3; ++c)
        result[c] = static_cast<unsigned char>(std::nearbyint(std::ldexp(v[c], 8 - exponent)));
    return result;
}

void rgb_from_rgbe(const Rgbe& rgbe, float* rgb) {
    for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = rgbe[3] == 0 ? 0.0f : std::ldexp(float(rgbe[c]), rgbe[3] - kExponentBias);
}

unsigned char read_byte(std::istream& stream) {
    const int byte = stream.get();
    if (byte == std::istream::traits_type::eof())
        throw std::runtime_error("the file ends too early; it may be truncated");
    return static_cast<unsigned char>(byte);
}

Rgbe read_pixel(std::istream& stream) {
    Rgbe pixel;
    for (unsigned char& byte : pixel) byte = read_byte(stream);
    return pixel;
}

/// One channel of a row: a count above 128 repeats the next byte count - 128 times, others copy count bytes.
void read_run_lengths(std::istream& stream, std::vector<Rgbe>& row, std::size_t channel) {
    for (std::size_t x = 0; x < row.size();) {
        const std::size_t code = read_byte(stream);
        const bool repeats = code > 128;
        const std::size_t count = repeats ? code - 128 : code;
        if (count == 0 || count > row.size() - x)
            throw std::runtime_error("a run does not fit its row; the file is damaged");
        unsigned char byte = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (i == 0 || !repeats) byte = read_byte(stream);
            row[x++][channel] = byte;
        }
    }
}

void read_row(std::istream& stream, std::vector<Rgbe>& row) {
    row[0] = read_pixel(stream);
    const std::size_t encoded_width = row[0][2] * std::size_t(256) + row[0][3];
    if (row[0][0] == 2 && row[0][1] == 2 && row[0][2] < 128 && row.size() >= 8) {
        if (encoded_width != row.size())
            throw std::runtime_error("a row has a wrong width; the file is damaged");
        for (std::size_t channel = 0; channel < 4; ++channel) read_run_lengths(stream, row, channel);
    } else {
        for (std::size_t x = 1; x < row.size(); ++x) row[x] = read_pixel(stream);
    }
}

struct Header {
    int width = 0;
    int height = 0;
    std::array<double, 3> factors = {1, 1, 1}; ///< of the pixels: the stored values are multiplied by them
};

/// The numbers behind a keyword of the header, all above 0.
template <std::size_t Count>
std::array<double, Count> positive_numbers(const std::string& line, std::size_t begin) {
    std::array<double, Count> numbers = {};
    std::istringstream words(line.substr(begin));
    words.imbue(std::locale::classic());
    bool is_valid = true;
    for (double& number : numbers) is_valid = is_valid && words >> number && number > 0;
    if (!is_valid || !(words >> std::ws).eof())
        throw std::runtime_error("'" + line + "' in the header must have " + std::to_string(Count) +
                                 (Count == 1 ? " number" : " numbers") + " above 0; the file is damaged");
    return numbers;
}

/// Programs that multiply an image add a line. The values in units of radiance are those before all of them.
void divide_by_line(const std::string& line, std::array<double, 3>& factors) {
    constexpr std::string_view kExposure = "EXPOSURE=", kColourCorrection = "COLORCORR=";
    if (line.starts_with(kExposure)) {
        const double exposure = positive_numbers<1>(line, kExposure.size())[0];
        for (double& factor : factors) factor /= exposure;
    } else if (line.starts_with(kColourCorrection)) {
        const auto correction = positive_numbers<3>(line, kColourCorrection.size());
        for (std::size_t c = 0; c < 3; ++c) factors[c] /= correction[c];
    }
}

/// A line without its end, which may be CR LF.
bool read_line(std::istream& stream, std::string& line) {
    if (!std::getline(stream, line)) return false;
    if (line.ends_with('\r')) line.pop_back();
    return true;
}

/// Leaves the stream at the first pixel.
Header read_header(std::istream& stream) {
    Header header;
    std::string line;
    if (!read_line(stream, line) || !line.starts_with("#?"))
        throw std::runtime_error("this is not a Radiance HDR file, or it is empty; check its name");
    while (read_line(stream, line) && !line.empty()) {
        if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
            throw std::runtime_error("only FORMAT=32-bit_rle_rgbe is supported, not " + line);
        divide_by_line(line, header.factors);
    }
    if (!read_line(stream, line) ||
        std::sscanf(line.c_str(), "-Y %9d +X %9d", &header.height, &header.width) != 2)
        throw std::runtime_error("the size must be given as '-Y height +X width', not '" + line + "'");
    check_size(header.width, header.height);
    return header;
}

Image read_pixels(std::istream& stream, const Header& header) {
    Image image{header.width, header.height, {}};
    // Memory is touched only as rows arrive.
    image.pixels.reserve(3 * std::size_t(header.width) * std::size_t(header.height));
    std::vector<Rgbe> row(static_cast<std::size_t>(header.width));
    for (int y = 0; y < header.height; ++y) {
        read_row(stream, row);
        for (const Rgbe& rgbe : row) {
            float rgb[3];
            rgb_from_rgbe(rgbe, rgb);
            for (std::size_t c = 0; c < 3; ++c)
                image.pixels.push_back(float(header.factors[c] * double(rgb[c])));
        }
    }
    return image;
}

} // namespace

void encode_hdr(std::ostream& stream, const Image& image) {
    stream << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " << image.height << " +X " << image.width << "\n";
    // Pixels without run lengths are legal, too: the largest mantissa is at least 128, hence no pixel looks
    // like the mark (2, 2, <128) of a compressed row.
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        const Rgbe rgbe = rgbe_from_rgb(&image.pixels[i]);
        stream.write(reinterpret_cast<const char*>(rgbe.data()), std::streamsize(rgbe.size()));
    }
}

Image decode_hdr(std::istream& stream) {
    const Header header = read_header(stream);
    // A run of 127 pixels takes two bytes for each of four channels.
    if (std::int64_t(header.width) * header.height / 16 > remaining_bytes(stream)) fail_as_cut_off();
    return with_memory_for(header.width, header.height, 3, [&] { return read_pixels(stream, header); });
}

} // namespace nusselt::image
