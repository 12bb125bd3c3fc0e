#include "image/codecs.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfThreading.h>

#include <array>
#include <stdexcept>
#include <thread>

namespace nusselt::image {

namespace {

constexpr std::array<const char*, 3> kRgb = {"R", "G", "B"};
constexpr std::size_t kPixelStride = 3 * sizeof(float);

const std::string& metadata_prefix() {
    static const std::string prefix = "nusselt:";
    return prefix;
}

/// Decompression runs on OpenEXR's global pool, which is empty unless it is asked for.
int decoding_thread_count() {
    static const int count = [] {
        Imf::setGlobalThreadCount(int(std::thread::hardware_concurrency()));
        return Imf::globalThreadCount();
    }();
    return count;
}

/// The stream is on its first byte before and after.
void check_magic_number(Imf::IStream& source) {
    if (!Imf::isOpenExrFile(source))
        throw std::runtime_error("this is not an OpenEXR file, or it is empty; check its name");
}

std::string channel_names(const Imf::ChannelList& channels) {
    std::string names;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        names += (names.empty() ? "" : ", ") + std::string(channel.name());
    return names.empty() ? "none" : names;
}

bool has_full_resolution(const Imf::ChannelList& channels, const char* name) {
    const Imf::Channel* channel = channels.findChannel(name);
    return channel != nullptr && channel->xSampling == 1 && channel->ySampling == 1;
}

/// Luminance alone; with RY and BY beside it, Y is one third of a colour image.
bool is_grey(const Imf::ChannelList& channels) {
    return has_full_resolution(channels, "Y") && channels.findChannel("RY") == nullptr &&
           channels.findChannel("BY") == nullptr;
}

bool is_rgb(const Imf::ChannelList& channels) {
    return has_full_resolution(channels, "R") && has_full_resolution(channels, "G") &&
           has_full_resolution(channels, "B");
}

/// OpenEXR fills rows that are stored shorter than the header claims with whatever the memory holds. Without
/// compression, the size of the file gives that away, before anything is allocated.
void check_file_size(const Imf::Header& header, std::int64_t pixel_count, std::int64_t file_size) {
    if (header.compression() != Imf::NO_COMPRESSION) return;
    std::int64_t bytes_per_pixel = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        if (channel.channel().xSampling == 1 && channel.channel().ySampling == 1)
            bytes_per_pixel += channel.channel().type == Imf::HALF ? 2 : 4;
    }
    if (file_size / pixel_count < bytes_per_pixel)
        throw std::runtime_error("the file is too small for its pixels; was it cut off?");
}

} // namespace

void encode_exr(std::ofstream& stream, const std::string& name, const Image& image,
                const Metadata& metadata) {
    Imf::Header header(image.width, image.height);
    // Noise in the mantissa hardly compresses. 1024 x 1024 noisy pixels on two cores, median of seven:
    // none 26 ms, 12.6 MB; RLE 48 ms, 12.6 MB; ZIPS 126 ms, 12.6 MB; ZIP 140 ms, 12.0 MB; PIZ 200 ms, 11.1
    // MB.
    header.compression() = Imf::NO_COMPRESSION;
    for (const auto& [key, value] : metadata)
        header.insert(metadata_prefix() + key, Imf::StringAttribute(value));

    Imf::FrameBuffer frame_buffer;
    for (std::size_t c = 0; c < kRgb.size(); ++c) {
        header.channels().insert(kRgb[c], Imf::Channel(Imf::FLOAT));
        frame_buffer.insert(kRgb[c],
                            Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, header.dataWindow(),
                                             kPixelStride, kPixelStride * std::size_t(image.width)));
    }
    Imf::StdOFStream sink(stream, name.c_str());
    Imf::OutputFile file(sink, header, 0);
    file.setFrameBuffer(frame_buffer);
    file.writePixels(image.height);
}

Image decode_exr(std::ifstream& stream, const std::string& name) {
    const std::int64_t file_size = stream.seekg(0, std::ios::end).tellg();
    stream.seekg(0);
    Imf::StdIFStream source(stream, name.c_str());
    check_magic_number(source);
    Imf::MultiPartInputFile file(source, decoding_thread_count(), false);
    const Imf::Header& header = file.header(0);
    if (header.hasType() && Imf::isDeepData(header.type()))
        throw std::runtime_error("deep images are not supported; flatten it first");

    // Before InputPart, which allocates rows of the size that the header claims.
    const auto& window = header.dataWindow();
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
    check_size(width, height);
    check_file_size(header, width * height, file_size);
    const bool rgb = is_rgb(header.channels());
    if (!rgb && !is_grey(header.channels())) {
        throw std::runtime_error(
            "the channels R, G and B or Y alone are needed at full resolution; the file has " +
            channel_names(header.channels()));
    }
    if (!file.partComplete(0)) throw std::runtime_error("rows are missing; was the file cut off?");

    Imf::InputPart part(file, 0);
    Image image = make_image(int(width), int(height));
    Imf::FrameBuffer frame_buffer;
    for (std::size_t c = 0; c < (rgb ? kRgb.size() : 1); ++c) {
        frame_buffer.insert(rgb ? kRgb[c] : "Y",
                            Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, window, kPixelStride,
                                             kPixelStride * std::size_t(image.width)));
    }
    part.setFrameBuffer(frame_buffer);
    part.readPixels(window.min.y, window.max.y);
    if (!rgb) {
        for (std::size_t i = 0; i < image.pixels.size(); i += 3)
            image.pixels[i + 1] = image.pixels[i + 2] = image.pixels[i];
    }
    return image;
}

Metadata decode_exr_metadata(std::ifstream& stream, const std::string& name) {
    Imf::StdIFStream source(stream, name.c_str());
    check_magic_number(source);
    const Imf::MultiPartInputFile file(source, 0, false);
    const Imf::Header& header = file.header(0);
    Metadata metadata;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const std::string attribute_name = attribute.name();
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (text != nullptr && attribute_name.starts_with(metadata_prefix()))
            metadata[attribute_name.substr(metadata_prefix().size())] = text->value();
    }
    return metadata;
}

} // namespace nusselt::image
