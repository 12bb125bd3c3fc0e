#pragma once
/// Images of which a file holds some tiles only: these tiles lie side by side, in rows of cells of one size.
///
/// Such a file is an ordinary EXR file, which any program opens: it shows the tiles as a mosaic. Metadata under
/// kTilesKey say where each belongs. Two other forms were considered. EXR files whose table lacks tiles are damaged
/// to most programs. Files of the whole image whose black pixels are compressed look right everywhere, but whoever
/// merges n parts then decodes n images; that time grows with the square of the number of parts for a given amount of
/// work.
///
/// read_image(), read_layers(), read_layer() and read_layer_list() of such a file give the whole image, black where
/// no tile is, with the layer kSamplesLayer. Only who merges many parts reads them as they are.

#include "image/layers.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::image {

/// The key of the metadata that say which tiles a file holds: x, y, width and height of the whole image, the size of
/// tiles and, in hexadecimal digits of four tiles each, which tiles are there, row by row.
inline constexpr const char* kTilesKey = "tiles";

/// The layer with the number of samples per pixel. Files have it unless that is the same in all their pixels; metadata under
/// the same name then have the number.
inline constexpr const char* kSamplesLayer = "samples";

/// The key of the metadata with which unpack() keeps the hash of a file: pack() writes the same file again if nothing has
/// changed, and one that is known as changed otherwise.
inline constexpr const char* kPackedHashKey = "packed_hash";

/// Pixels in one row of both images, counted row by row.
struct PixelRun {
    std::size_t packed; ///< first pixel among those that are stored
    std::size_t whole;  ///< first pixel in the whole image
    std::size_t count;
};

/// Which tiles of an image are there, and where a file has them.
class PackedTiles {
public:
    /// The tiles of the film that have pixels of a window, none of them chosen.
    /// \param whole with x, y >= 0 and at most kMaxPixelCount pixels
    /// \param size  of a tile [pixels]; the borders of tiles are at its multiples on the film
    PackedTiles(const Window& whole, int size);

    /// From metadata. \throws std::runtime_error if they are damaged
    explicit PackedTiles(const std::string& text);

    /// Chooses the tile with this pixel of the film.
    void add(int x, int y);

    [[nodiscard]] std::string text() const;
    [[nodiscard]] const Window& whole() const { return whole_; }
    /// The pixels of the file: all cells, of which the last ones may be empty; one of them without any tile.
    [[nodiscard]] Window window() const;
    /// Pixels that are there, each once.
    [[nodiscard]] std::vector<PixelRun> runs() const;

private:
    [[nodiscard]] std::size_t chosen_count() const;

    Window whole_;
    int size_;
    int columns_, rows_; ///< tiles
    std::vector<bool> is_there_;
};

/// The tiles of a file that was read as it is; nothing if it holds all pixels of its window.
/// \throws std::runtime_error if the window of the file contradicts its metadata
[[nodiscard]] std::optional<PackedTiles> packed_tiles_of(const LayeredImage& file);

/// Keeps the chosen tiles only, and adds the hash of what is left (content_hash.h). Of an image from unpack(), the hash is
/// the one that the file had.
/// \param image is moved from; its window is the one of `tiles`
[[nodiscard]] LayeredImage pack(LayeredImage&& image, const PackedTiles& tiles);

/// read_layers() of a file as it is: of packed tiles, nothing but these.
[[nodiscard]] LayeredImage read_packed_layers(const std::filesystem::path& path);

/// Puts tiles of a file back to their places. The rest is zero, and has zero samples in the layer kSamplesLayer. The hash
/// is compared, and moves to kPackedHashKey: it is not that of the whole image. Files without packed tiles stay as they are.
/// \param file with all layers, or with none of their data
/// \throws std::runtime_error if the metadata or pixels are damaged, or the whole image has more than 2^30 values or 2^14
///                            times the pixels of the file
[[nodiscard]] LayeredImage unpack(LayeredImage&& file);

/// unpack() of a single layer, which no hash protects alone. Of other layers than `samples`, nothing is added.
/// \param file with at most this layer
[[nodiscard]] LayeredImage unpack_layer(LayeredImage&& file, std::string_view name);

} // namespace nusselt::image
