#include "image/io.h"

#include "base/atomic_file.h"
#include "base/memory_text.h"
#include "image/codecs.h"
#include "image/packed_tiles.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>

namespace nusselt::image {

namespace {

/// \param problem  may quote the file, hence contain anything
[[noreturn]] void fail_to_read(const std::filesystem::path& path, const std::string& problem) {
    std::string message = "cannot read '" + path.string() + "': " + problem;
    std::replace_if(
        message.begin(), message.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
    throw std::runtime_error(message);
}

std::ifstream open_for_reading(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        fail_to_read(path, "this is a folder; use the name of a file");
    // Devices and pipes have no size to check, and some never end.
    if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
        fail_to_read(path, "this is a device or a pipe; use the name of a file");
    std::ifstream stream(path, std::ios::binary);
    if (!stream)
        fail_to_read(path, std::string(std::strerror(errno)) + "; check the path and its permissions");
    return stream;
}

/// Runs a decoder on the file and adds the path to its errors.
template <class Decoder>
auto decode_file(const std::filesystem::path& path, const Decoder& decode) {
    std::ifstream stream = open_for_reading(path);
    try {
        return decode(stream);
    } catch (const std::bad_alloc&) {
        fail_to_read(path, "not enough memory to decode the file");
    } catch (const std::exception& error) {
        fail_to_read(path, error.what());
    }
}

void check_before_writing(const Image& image, const Metadata& metadata) {
    const std::size_t expected = 3 * std::size_t(image.width) * std::size_t(image.height);
    if (image.width <= 0 || image.height <= 0 || image.pixels.size() != expected) {
        throw std::invalid_argument("an image cannot have " + std::to_string(image.width) + " x " +
                                    std::to_string(image.height) + " pixels and " +
                                    std::to_string(image.pixels.size()) + " floats");
    }
    for (const auto& [key, value] : metadata) {
        // 255 bytes is the limit of attribute names in EXR; readers cut off at a zero byte.
        if (key.empty() || key.size() > 200 || key.find('\0') != std::string::npos)
            throw std::invalid_argument("metadata key '" + key + "' must have 1 to 200 bytes, none zero");
    }
}

/// The memory that the floats of an image take.
std::string memory_text(std::int64_t width, std::int64_t height, std::int64_t channels) {
    return base::memory_text(sizeof(float) * double(width) * double(height) * double(channels));
}

enum class OutputFormat { exr, png, hdr, pfm };

OutputFormat output_format(const std::filesystem::path& path) {
    const std::string extension = lower_case_extension(path);
    if (extension == ".exr") return OutputFormat::exr;
    if (extension == ".png") return OutputFormat::png;
    if (extension == ".hdr") return OutputFormat::hdr;
    if (extension == ".pfm") return OutputFormat::pfm;
    throw std::runtime_error("cannot write '" + path.string() + "': unknown extension '" + extension +
                             "'; use .exr, .png, .hdr or .pfm");
}

} // namespace

std::string lower_case_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : char(c); });
    return extension;
}

bool is_exr(const std::filesystem::path& path) { return lower_case_extension(path) == ".exr"; }
bool is_png(const std::filesystem::path& path) { return lower_case_extension(path) == ".png"; }
bool is_high_dynamic_range(const std::filesystem::path& path) {
    const std::string extension = lower_case_extension(path);
    return extension == ".exr" || extension == ".hdr" || extension == ".pfm";
}

void check_size(std::int64_t width, std::int64_t height) {
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (width <= 0 || height <= 0)
        throw std::runtime_error("a size of " + size +
                                 " is not supported; width and height must be positive");
    if (width > kMaxPixelCount / height)
        throw std::runtime_error("a size of " + size + " is not supported: it would take " +
                                 memory_text(width, height, 3) +
                                 " of memory; the limit is 2^28 pixels, which take " +
                                 memory_text(kMaxPixelCount, 1, 3) + "; use a smaller image");
}

void fail_for_memory(int width, int height, std::int64_t channels) {
    throw std::runtime_error("not enough memory for its " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels (" + memory_text(width, height, channels) +
                             "); close other programs or use a smaller image");
}

std::int64_t remaining_bytes(std::istream& stream) {
    const auto position = stream.tellg();
    const auto end = stream.seekg(0, std::ios::end).tellg();
    stream.seekg(position);
    return end - position;
}

void write_image(const std::filesystem::path& path, const Image& image, const Metadata& metadata,
                 double exposure) {
    check_before_writing(image, metadata);
    switch (output_format(path)) {
    case OutputFormat::exr:
        write_exr(path, image, metadata);
        break;
    case OutputFormat::png:
        base::write_atomically(
            path, [&](std::ofstream& stream) { encode_png(stream, image, std::exp2(exposure)); });
        break;
    case OutputFormat::hdr:
        base::write_atomically(path, [&](std::ofstream& stream) { encode_hdr(stream, image); });
        break;
    case OutputFormat::pfm:
        base::write_atomically(path, [&](std::ofstream& stream) { encode_pfm(stream, image); });
        break;
    }
}

void check_writable_image(const std::filesystem::path& path) {
    output_format(path);
    base::check_writable(path);
}

Image read_image(const std::filesystem::path& path) {
    const std::string extension = lower_case_extension(path);
    if (extension == ".exr") return decode_file(path, decode_exr);
    if (extension == ".hdr") return decode_file(path, decode_hdr);
    if (extension == ".pfm") return decode_file(path, decode_pfm);
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".tga")
        return decode_file(path, decode_srgb);
    fail_to_read(path,
                 "unknown extension '" + extension + "'; use .exr, .hdr, .pfm, .png, .jpg, .jpeg or .tga");
}

LayeredImage read_layers(const std::filesystem::path& path) { return decode_file(path, decode_exr_layers); }

LayeredImage read_packed_layers(const std::filesystem::path& path) {
    return decode_file(path, decode_exr_packed_layers);
}

LayeredImage read_layer(const std::filesystem::path& path, std::string_view name) {
    return decode_file(path, [&](std::ifstream& stream) { return decode_exr_layer(stream, name); });
}

LayeredImage read_layer_list(const std::filesystem::path& path) {
    return decode_file(path, decode_exr_layer_list);
}

Metadata read_exr_metadata(const std::filesystem::path& path) {
    return decode_file(path, decode_exr_metadata);
}

} // namespace nusselt::image
