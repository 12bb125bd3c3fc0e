#include "image/formats/exr_part.h"

#include "image/codecs.h"
#include "image/formats/bytes.h"
#include "image/formats/exr_header.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

namespace nusselt::image {

namespace {

constexpr std::string_view kMetadataPrefix = "nusselt:";

/// The memory in use grows with the rows that could be decoded, so that a file that only claims to be large fails
/// early.
constexpr int kRowsPerBand = 256;

/// Tiles are decoded as a whole and may be larger than their image.
constexpr std::int64_t kMaxTilePixels = std::int64_t(1) << 22;

/// Rows are decoded in chunks as a whole, even where the image has fewer.
constexpr std::int64_t kMaxChunkBytes = std::int64_t(1) << 27;

/// Decompression runs on OpenEXR's global pool, which is empty unless it is asked for.
int decoding_thread_count() {
    static const int count = [] {
        Imf::setGlobalThreadCount(int(std::thread::hardware_concurrency()));
        return Imf::globalThreadCount();
    }();
    return count;
}

/// What OpenEXR calls the file in its messages.
constexpr const char* kStreamName = "file";

/// Runs `step`, which calls OpenEXR. The names of the file are taken out of its messages, as the caller adds the path.
template <class Step>
auto call(const Step& step) {
    try {
        return step();
    } catch (const Iex::BaseExc& error) {
        static const std::string kEndOfName = '"' + std::string(kStreamName) + "\". ";
        const std::string message = error.what();
        const std::size_t name = message.rfind(kEndOfName);
        throw std::runtime_error(
            "cannot decode its EXR data (" +
            (name == std::string::npos ? message : message.substr(name + kEndOfName.size())) +
            "); the file may be damaged or truncated");
    }
}

/// The stream, which `source` reads, is on its first byte before and after.
Imf::IStream& checked(Imf::IStream& source, std::istream& stream) {
    if (!Imf::isOpenExrFile(source))
        throw std::runtime_error("this is not an OpenEXR file, or it is empty; check its name");
    check_exr_attributes(stream);
    return source;
}

/// Bytes of pixels that one byte of a file can stand for at most.
std::int64_t largest_compression_ratio(Imf::Compression compression) {
    switch (compression) {
    case Imf::NO_COMPRESSION:
        return 1;
    // Two bytes for a run of 128.
    case Imf::RLE_COMPRESSION:
        return 64;
    // 4 x 4 half floats in three bytes.
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
        return 11;
    // A match of deflate is up to 258 bytes in two bits.
    case Imf::ZIPS_COMPRESSION:
    case Imf::ZIP_COMPRESSION:
        return 1032;
    // The same of 24 bits for 32; codes of Huffman with runs of 255 values stay below that.
    case Imf::PXR24_COMPRESSION:
    case Imf::PIZ_COMPRESSION:
        return 1376;
    // DWA: a block of 8 x 8 is two bytes before deflate.
    default:
        return std::int64_t(1) << 18;
    }
}

int rows_per_chunk(Imf::Compression compression) {
    switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
        return 1;
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
        return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
        return 32;
    default:
        return 256;
    }
}

std::int64_t bytes_per_pixel(const Imf::ChannelList& channels) {
    std::int64_t bytes = 0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        if (channel.channel().xSampling == 1 && channel.channel().ySampling == 1)
            bytes += channel.channel().type == Imf::HALF ? 2 : 4;
    }
    return bytes;
}

/// Without compression this also finds rows that are stored shorter than the header claims, which OpenEXR
/// fills with whatever the memory holds.
void check_file_size(const Imf::Header& header, std::int64_t width, std::int64_t height,
                     std::int64_t file_size) {
    const std::int64_t ratio = largest_compression_ratio(header.compression());
    const std::int64_t pixel_bytes = std::max<std::int64_t>(1, bytes_per_pixel(header.channels()));
    if (width * height / ratio > file_size / pixel_bytes) fail_as_cut_off();
    if (!header.hasTileDescription()) {
        if (width > kMaxChunkBytes / rows_per_chunk(header.compression()) / pixel_bytes)
            throw std::runtime_error(
                "rows of " + std::to_string(width) + " pixels with " + std::to_string(pixel_bytes) +
                " bytes are not supported with this compression; save the image with ZIP");
        return;
    }
    const Imf::TileDescription& tile = header.tileDescription();
    if (std::int64_t(tile.xSize) > kMaxTilePixels / std::max<std::int64_t>(1, tile.ySize)) {
        throw std::runtime_error(
            "tiles of " + std::to_string(tile.xSize) + " x " + std::to_string(tile.ySize) +
            " pixels are not supported; save the image with smaller tiles or as scan lines");
    }
}

} // namespace

ExrPart::ExrPart(std::ifstream& stream)
    : source_(stream, kStreamName), file_(call([&] {
          return Imf::MultiPartInputFile(checked(source_, stream), decoding_thread_count(), false);
      })) {
    if (header().hasType() && Imf::isDeepData(header().type()))
        throw std::runtime_error("deep images are not supported; flatten the image first");
    const auto& window = header().dataWindow();
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
    check_size(width, height);
    check_file_size(header(), width, height, stream.tellg() + remaining_bytes(stream));
    if (!file_.partComplete(0)) throw std::runtime_error("rows are missing; the file may be truncated");
}

int ExrPart::width() const {
    const auto& window = header().dataWindow();
    return window.max.x - window.min.x + 1;
}

int ExrPart::height() const {
    const auto& window = header().dataWindow();
    return window.max.y - window.min.y + 1;
}

bool ExrPart::has_full_resolution(const std::string& channel) const {
    const Imf::Channel* found = header().channels().findChannel(channel);
    return found != nullptr && found->xSampling == 1 && found->ySampling == 1;
}

void ExrPart::read(const std::vector<ChannelGroup>& groups) {
    std::int64_t channel_count = 0;
    for (const ChannelGroup& group : groups) channel_count += std::int64_t(group.channels.size());
    with_memory_for(width(), height(), channel_count, [&] { call([&] { read_bands(groups); }); });
}

void ExrPart::read_bands(const std::vector<ChannelGroup>& groups) {
    // Memory is touched only as bands arrive.
    for (const ChannelGroup& group : groups)
        group.data->reserve(group.channels.size() * std::size_t(width()) * std::size_t(height()));
    Imf::InputPart part(file_, 0);
    auto band = header().dataWindow();
    const int last_row = band.max.y;
    for (int rows_left = height(); rows_left > 0; rows_left -= kRowsPerBand) {
        const int rows = std::min(kRowsPerBand, rows_left);
        band.max.y = band.min.y + (rows - 1);
        const std::size_t pixel_count = std::size_t(width()) * std::size_t(rows);
        Imf::FrameBuffer frame_buffer;
        for (const ChannelGroup& group : groups) {
            const std::size_t channel_count = group.channels.size();
            const std::size_t begin = group.data->size();
            group.data->resize(begin + channel_count * pixel_count);
            const std::size_t stride = channel_count * sizeof(float);
            for (std::size_t c = 0; c < channel_count; ++c) {
                frame_buffer.insert(group.channels[c],
                                    Imf::Slice::Make(Imf::FLOAT, group.data->data() + begin + c, band, stride,
                                                     stride * std::size_t(width())));
            }
        }
        part.setFrameBuffer(frame_buffer);
        part.readPixels(band.min.y, band.max.y);
        if (band.max.y < last_row) band.min.y = band.max.y + 1;
    }
}

std::string full_name(const Layer& layer, const std::string& channel) {
    return layer.name.empty() ? channel : layer.name + "." + channel;
}

std::string channel_names(const Imf::Header& header) {
    std::string names;
    const Imf::ChannelList& channels = header.channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        names += (names.empty() ? "" : ", ") + std::string(channel.name());
    return names.empty() ? "none" : names;
}

void insert_metadata(Imf::Header& header, const Metadata& metadata) {
    for (const auto& [key, value] : metadata)
        header.insert(std::string(kMetadataPrefix) + key, Imf::StringAttribute(value));
}

ExrMetadata text_attributes(const Imf::Header& header) {
    ExrMetadata metadata;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const std::string name = attribute.name();
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (text == nullptr || name == "type") continue; // scan lines or tiles: no information for people
        if (name.starts_with(kMetadataPrefix)) {
            metadata.ours[name.substr(kMetadataPrefix.size())] = text->value();
        } else {
            metadata.foreign[name] = text->value();
        }
    }
    return metadata;
}

} // namespace nusselt::image
