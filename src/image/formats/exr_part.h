#pragma once
/// Code that the readers of EXR files share: checks before large allocations, and reading of channels.

#include "image/layers.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStdIO.h>

#include <fstream>
#include <string>
#include <vector>

namespace nusselt::image {

/// Channels that are read into one array, side by side for each pixel.
struct ChannelGroup {
    std::vector<std::string> channels; ///< full names
    std::vector<float>* data;
};

/// An open EXR file whose first part is known to be a flat image of at most kMaxPixelCount pixels, and not
/// larger than a file of this size can hold.
class ExrPart {
public:
    /// \throws std::exception  describing what is wrong with the contents
    explicit ExrPart(std::ifstream& stream);

    [[nodiscard]] const Imf::Header& header() const { return file_.header(0); }
    [[nodiscard]] int width() const;
    [[nodiscard]] int height() const;

    /// Whether there is a channel of this name with a value for every pixel.
    [[nodiscard]] bool has_full_resolution(const std::string& channel) const;

    /// Fills the arrays of all groups, which need not have a size. Half floats and integers become floats.
    void read(const std::vector<ChannelGroup>& groups);

private:
    void read_bands(const std::vector<ChannelGroup>& groups);

    Imf::StdIFStream source_;
    Imf::MultiPartInputFile file_;
};

/// The name of a channel of a layer in files.
[[nodiscard]] std::string full_name(const Layer& layer, const std::string& channel);

/// Names of all channels, for messages; "none" if there are none.
[[nodiscard]] std::string channel_names(const Imf::Header& header);

/// Stores metadata as attributes `nusselt:<key>`.
void insert_metadata(Imf::Header& header, const Metadata& metadata);

/// Splits the text attributes of a header into ours and those of other programs, under their full names.
struct ExrMetadata {
    Metadata ours;
    Metadata foreign;
};
[[nodiscard]] ExrMetadata text_attributes(const Imf::Header& header);

} // namespace nusselt::image
