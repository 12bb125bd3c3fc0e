#pragma once
/// Images of parts or seeds of one rendering, put together.

#include "image/layers.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace nusselt::render {

/// Adds up images that this program has written. Pixels are means over the samples of all images, weighted by their
/// numbers; where only one image has samples, its floats are kept bit by bit. The variance becomes that of the mean of
/// independent images.
class Merger {
public:
    Merger();
    ~Merger();
    Merger(const Merger&) = delete;
    Merger& operator=(const Merger&) = delete;

    /// \param image as image::read_packed_layers() or image::read_layers() gives it
    /// \param path  for messages
    /// \throws std::runtime_error naming the path, if the image is none of this program; if its size, layers, scene or
    ///                            settings differ from those of the first one, saying what differs; if a pixel has samples
    ///                            of the same seed already, which would count twice; or if its pixels are not those that
    ///                            were written
    void add(const image::LayeredImage& image, const std::filesystem::path& path);

    /// Which parts are missing or unfinished, in words; empty if all pixels have samples.
    std::string what_is_missing() const;

    /// \throws std::logic_error without images
    image::LayeredImage result() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace nusselt::render
