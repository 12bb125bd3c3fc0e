#include "image/formats/exr_header.h"

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace nusselt::image {

namespace {

constexpr std::uint32_t kSeveralParts = 0x1000; // a bit of the version

[[noreturn]] void fail(const std::string& problem) {
    throw std::runtime_error("the header is damaged: " + problem);
}

/// Little endian. Zero at the end of the stream.
std::uint32_t read_uint32(std::istream& stream) {
    std::array<unsigned char, 4> bytes{};
    stream.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | bytes[i];
    return value;
}

/// The text up to the next zero byte; OpenEXR reads no longer ones.
std::string read_name(std::istream& stream) {
    constexpr std::size_t kMaxLength = 255;
    std::string name;
    for (int byte = stream.get(); byte > 0; byte = stream.get()) {
        name += static_cast<char>(byte);
        if (name.size() > kMaxLength) fail("a name has more than 255 bytes");
    }
    return name;
}

/// OpenEXR reads that many bytes for these types, whatever size the attribute has.
std::optional<std::uint64_t> fixed_size(std::string_view type) {
    static constexpr std::pair<std::string_view, std::uint64_t> kSizes[] = {
        {"box2f", 16},         {"box2i", 16},    {"chromaticities", 32},
        {"compression", 1},    {"double", 8},    {"envmap", 1},
        {"deepImageState", 1}, {"float", 4},     {"int", 4},
        {"keycode", 28},       {"lineOrder", 1}, {"m33d", 72},
        {"m33f", 36},          {"m44d", 128},    {"m44f", 64},
        {"rational", 8},       {"tiledesc", 9},  {"timecode", 8},
        {"v2d", 16},           {"v2f", 8},       {"v2i", 8},
        {"v3d", 24},           {"v3f", 12},      {"v3i", 12}};
    for (const auto& [name, size] : kSizes)
        if (name == type) return size;
    return std::nullopt;
}

/// The size of a list of texts, or something above `limit`.
std::uint64_t size_of_texts(std::istream& stream, std::uint64_t limit) {
    std::uint64_t size = 0;
    while (size < limit) {
        const std::uint64_t length = read_uint32(stream);
        size += 4 + length;
        stream.seekg(static_cast<std::streamoff>(length), std::ios::cur);
    }
    return size;
}

/// The size of a list of channels, or something above `limit`.
std::uint64_t size_of_channels(std::istream& stream, std::uint64_t limit) {
    constexpr std::uint64_t kDescription = 16; // behind each name
    std::uint64_t size = 0;
    while (size <= limit) {
        const std::string name = read_name(stream);
        size += name.size() + 1;
        if (name.empty()) break;
        size += kDescription;
        stream.seekg(static_cast<std::streamoff>(kDescription), std::ios::cur);
    }
    return size;
}

/// Width, height and four bytes per pixel.
std::uint64_t size_of_preview(std::istream& stream, std::uint64_t limit) {
    const std::uint64_t width = read_uint32(stream);
    const std::uint64_t height = read_uint32(stream);
    return width <= limit && height <= limit ? 8 + 4 * width * height : limit + 1;
}

/// The number of bytes that OpenEXR reads from the stream for the contents of an attribute.
std::uint64_t size_of_contents(std::istream& stream, std::string_view type, std::uint64_t size) {
    if (type == "stringvector") return size_of_texts(stream, size);
    if (type == "chlist") return size_of_channels(stream, size);
    if (type == "preview") return size_of_preview(stream, size);
    // Its first number is the size that it is unpacked to, which nothing bounds. Images do not need it.
    if (type == "idmanifest") fail("attributes of type idmanifest are not supported");
    return fixed_size(type).value_or(size);
}

} // namespace

void check_exr_attributes(std::istream& stream) {
    const std::streamoff file_size = stream.seekg(0, std::ios::end).tellg();
    stream.seekg(4);
    const bool has_several_parts = (read_uint32(stream) & kSeveralParts) != 0;
    bool is_at_header = true;
    while (true) {
        const std::string name = read_name(stream);
        if (!stream) break;
        if (name.empty()) {
            // An empty name ends a header; an empty header ends a list of several.
            if (is_at_header || !has_several_parts) break;
            is_at_header = true;
            continue;
        }
        is_at_header = false;
        const std::string type = read_name(stream);
        const std::uint64_t size = read_uint32(stream);
        const std::streamoff begin = stream.tellg();
        if (!stream || size > static_cast<std::uint64_t>(file_size - begin))
            fail("an attribute is longer than the file; the file may be truncated");
        if (size_of_contents(stream, type, size) != size)
            fail("the size of an attribute does not fit its contents");
        stream.seekg(begin + static_cast<std::streamoff>(size));
    }
    stream.clear();
    stream.seekg(0);
}

} // namespace nusselt::image
