#include "image/coded_file.h"

#include "image/codecs.h"
#include "image/formats/bmp.h"
#include "image/formats/jpg.h"
#include "image/formats/png.h"
#include "image/formats/tga.h"
#include "image/srgb.h"

#include <istream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace nusselt::image {

namespace {

/// One of the formats that store codes.
struct CodedFormat {
    bool (*matches)(std::string_view file);
    CodedHeader (*read_header)(std::string_view file);
    void (*decode)(std::string_view file, CodeRows& rows);
};

constexpr std::string_view kBmpMark = "BM";

/// TGA comes last since it has no mark: its reader looks for a header that makes sense.
constexpr CodedFormat kFormats[] = {
    {[](std::string_view file) { return file.starts_with("\x89PNG\r\n\x1A\n"); }, read_png_header,
     decode_png},
    {[](std::string_view file) { return file.starts_with("\xFF\xD8"); }, read_jpg_header, decode_jpg},
    {[](std::string_view file) { return file.starts_with(kBmpMark); }, read_bmp_header, decode_bmp},
    {is_tga, read_tga_header, decode_tga},
};

const CodedFormat& format_of(std::string_view file) {
    for (const CodedFormat& format : kFormats)
        if (format.matches(file)) return format;
    throw std::runtime_error("the file is not PNG, JPG, TGA or BMP; check its name or convert it");
}

} // namespace

CodedHeader read_coded_header(std::string_view file) { return format_of(file).read_header(file); }

std::vector<float> decode_codes(std::string_view file, int channels,
                                const std::function<double(double)>& to_linear) {
    const CodedFormat& format = format_of(file);
    CodeRows rows(format.read_header(file), channels, to_linear);
    format.decode(file, rows);
    return rows.take();
}

Image decode_srgb(std::istream& stream) {
    const std::string file(std::istreambuf_iterator<char>(stream), {});
    if (file.starts_with(kBmpMark))
        throw std::runtime_error("the file is not PNG, JPG or TGA; check its name or convert it");
    const CodedHeader header = read_coded_header(file);
    return {header.width, header.height, decode_codes(file, 3, linear_from_srgb)};
}

} // namespace nusselt::image
