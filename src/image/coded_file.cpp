#include "image/coded_file.h"

#include "image/codecs.h"
#include "image/formats/bmp.h"
#include "image/formats/bytes.h"
#include "image/formats/jpg.h"
#include "image/formats/png.h"
#include "image/formats/tga.h"
#include "image/srgb.h"

#include <istream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace nusselt::image {

namespace {

/// One of the formats that store codes.
struct CodedFormat {
    std::string_view mark; ///< the first bytes
    CodedHeader (*read_header)(std::istream& file);
    void (*decode)(std::istream& file, CodeRows& rows);
};

constexpr std::string_view kBmpMark = "BM";

/// TGA comes last since it has no mark: its reader looks for a header that makes sense.
constexpr CodedFormat kFormats[] = {{"\x89PNG\r\n\x1A\n", read_png_header, decode_png},
                                    {"\xFF\xD8", read_jpg_header, decode_jpg},
                                    {kBmpMark, read_bmp_header, decode_bmp},
                                    {"", read_tga_header, decode_tga}};

const CodedFormat& format_of(std::istream& file) {
    constexpr std::size_t kLongestMark = 8;
    const std::string begin = bytes_at(file, 0, kLongestMark);
    const auto* format = kFormats;
    while (!begin.starts_with(format->mark)) ++format;
    return *format;
}

} // namespace

CodedHeader read_coded_header(std::istream& file) { return format_of(file).read_header(file); }

Texels decode_codes(std::istream& file, int channels, const std::function<double(double)>& to_linear) {
    const CodedFormat& format = format_of(file);
    const CodedHeader header = format.read_header(file);
    return with_memory_for(header.width, header.height, channels, [&] {
        CodeRows rows(header, channels, to_linear);
        format.decode(file, rows);
        return rows.take();
    });
}

Image decode_srgb(std::istream& stream) {
    if (bytes_at(stream, 0, kBmpMark.size()) == kBmpMark)
        throw std::runtime_error("this is a BMP file, which only textures may be; convert it to PNG");
    const CodedHeader header = read_coded_header(stream);
    return {header.width, header.height, decode_codes(stream, 3, linear_from_srgb).values};
}

} // namespace nusselt::image
