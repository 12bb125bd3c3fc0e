#pragma once
/// Images of the renderer as arrays of numpy.

#include "image/image.h"
#include "image/layers.h"

#include <pybind11/numpy.h>

#include <memory>
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

/// (layers, metadata, data window, display window, metadata of other programs). Layers are (name, channels, array) with
/// arrays (height, width, channels); windows are (x, y, width, height).
pybind11::tuple to_tuple(image::LayeredImage&& image);

/// The inverse.
image::LayeredImage layered_image_of(const pybind11::tuple& parts);

} // namespace nusselt::python
