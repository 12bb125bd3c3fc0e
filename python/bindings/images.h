#pragma once
/// Images of the renderer as arrays of numpy.

#include "image/layers.h"

#include <pybind11/numpy.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::python {

/// An array that takes a vector over.
template <class Number>
pybind11::array_t<Number> array_of(std::vector<Number>&& values, std::vector<pybind11::ssize_t> shape) {
    auto owner = std::make_unique<std::vector<Number>>(std::move(values));
    Number* const data = owner->data();
    const pybind11::capsule capsule(owner.get(),
                                    [](void* vector) { delete static_cast<std::vector<Number>*>(vector); });
    static_cast<void>(owner.release());
    return pybind11::array_t<Number>(std::move(shape), data, capsule);
}

/// An image as users see it: of a part of a rendering, all pixels of the whole.
struct Picture {
    image::LayeredImage whole;
    std::string tiles; ///< which ones a file of it holds (image/packed_tiles.h); empty: all pixels
};

/// \param file with nothing but its tiles, if it has some
/// \throws std::runtime_error if the metadata of tiles are damaged
Picture unpacked(image::LayeredImage&& file);

/// (layers, metadata, data window, display window, metadata of other programs, tiles). Layers are (name, channels, array)
/// with arrays (height, width, channels); windows are (x, y, width, height).
pybind11::tuple to_tuple(Picture&& picture);

/// The inverse, as it goes into files: of a part, nothing but its tiles.
/// \throws std::invalid_argument if a layer does not have the pixels of the data window, or if this is not the one that the
///                               tiles belong to
image::LayeredImage layered_image_of(const pybind11::tuple& parts);

} // namespace nusselt::python
