#include "python/bindings/images.h"
#include "python/bindings/bindings.h"
#include "python/bindings/text.h"
#include "python/bindings/without_gil.h"

#include "image/difference.h"
#include "image/flip.h"
#include "image/io.h"
#include "image/metrics.h"
#include "image/packed_tiles.h"
#include "image/ssim.h"

#include <pybind11/stl.h>

#include <stdexcept>
#include <string>
#include <tuple>

namespace nusselt::python {

namespace py = pybind11;

namespace {

using Pixels = py::array_t<float, py::array::c_style | py::array::forcecast>;

py::dict to_dict(const image::Metadata& metadata) {
    py::dict texts;
    for (const auto& [key, text] : metadata) texts[text_of(key)] = text_of(text);
    return texts;
}

image::Metadata metadata_of(const py::dict& texts) {
    image::Metadata metadata;
    for (const auto& [key, text] : texts) metadata[bytes_of(key)] = bytes_of(text);
    return metadata;
}

py::tuple to_tuple(const image::Window& window) {
    return py::make_tuple(window.x, window.y, window.width, window.height);
}

image::Window window_of(const py::handle& window) {
    const auto [x, y, width, height] = window.cast<std::tuple<int, int, int, int>>();
    return {x, y, width, height};
}

/// \throws std::invalid_argument if an array does not have the pixels of the window and a number for each channel
void check_shape(const std::string& name, const py::array& pixels, const image::Window& window,
                 std::size_t channels) {
    const auto length = [&](int axis) { return pixels.ndim() == 3 ? pixels.shape(axis) : -1; };
    if (length(0) == window.height && length(1) == window.width &&
        length(2) == static_cast<py::ssize_t>(channels))
        return;
    throw std::invalid_argument("layer '" + name + "' must have the shape (" + std::to_string(window.height) +
                                ", " + std::to_string(window.width) + ", " + std::to_string(channels) +
                                ") of the data window and the names of its channels, not " +
                                py::str(pixels.attr("shape")).cast<std::string>());
}

/// \throws std::runtime_error naming the path
Picture read_picture(const std::string& path) {
    image::LayeredImage file = image::read_packed_layers(path);
    try {
        return unpacked(std::move(file));
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("cannot read image '" + path + "': " + error.what());
    }
}

/// \param pixels (height, width, 3)
image::Image image_of(const Pixels& pixels) {
    image::Image image;
    image.height = static_cast<int>(pixels.shape(0));
    image.width = static_cast<int>(pixels.shape(1));
    image.pixels.assign(pixels.data(), pixels.data() + pixels.size());
    return image;
}

py::array to_array(image::Image&& image) {
    return array_of(std::move(image.pixels), {image.height, image.width, 3});
}

py::array to_array(image::Plane&& plane) {
    return array_of(std::move(plane.values), {plane.height, plane.width});
}

py::dict to_dict(const image::Comparison& c) {
    const auto invalid = [](const image::InvalidPixels& pixels) { return pixels.count; };
    using namespace py::literals;
    return py::dict("mse"_a = c.mse, "rmse"_a = c.rmse, "relative_rmse"_a = c.relative_rmse, "mae"_a = c.mae,
                    "rel_mse"_a = c.rel_mse, "mrse"_a = c.mrse, "mean"_a = c.mean_a,
                    "mean_of_reference"_a = c.mean_b, "compared_pixels"_a = c.compared_pixels,
                    "invalid_pixels"_a = invalid(c.invalid_a),
                    "invalid_pixels_of_reference"_a = invalid(c.invalid_b));
}

/// Calls a function with two images, without the GIL.
template <class Function>
auto with_images(const Pixels& a, const Pixels& reference, const Function& function) {
    const image::Image image = image_of(a);
    const image::Image other = image_of(reference);
    const WithoutGil released;
    return function(image, other);
}

py::tuple flip(const Pixels& a, const Pixels& reference, double pixels_per_degree, double exposure) {
    auto [map, mean] = with_images(a, reference, [&](const image::Image& x, const image::Image& y) {
        image::Plane plane = image::flip(x, y, pixels_per_degree, exposure);
        const double average = image::mean_of_valid(plane, x, y);
        return std::pair(std::move(plane), average);
    });
    return py::make_tuple(to_array(std::move(map)), mean);
}

py::tuple hdr_flip(const Pixels& a, const Pixels& reference, double pixels_per_degree) {
    auto [map, mean] = with_images(a, reference, [&](const image::Image& x, const image::Image& y) {
        image::Plane plane = image::hdr_flip(x, y, image::flip_exposures(y), pixels_per_degree);
        const double average = image::mean_of_valid(plane, x, y);
        return std::pair(std::move(plane), average);
    });
    return py::make_tuple(to_array(std::move(map)), mean);
}

void write_image(const std::string& path, const Pixels& pixels, const py::dict& texts, double exposure) {
    const image::Image image = image_of(pixels);
    const image::Metadata metadata = metadata_of(texts);
    const WithoutGil released;
    image::write_image(path, image, metadata, exposure);
}

} // namespace

Picture unpacked(image::LayeredImage&& file) {
    const auto tiles = file.metadata.find(image::kTilesKey);
    std::string text = tiles == file.metadata.end() ? "" : tiles->second;
    return {unpack(std::move(file)), std::move(text)};
}

py::tuple to_tuple(Picture&& picture) {
    image::LayeredImage& image = picture.whole;
    py::list layers;
    for (image::Layer& layer : image.layers) {
        const py::list channels = texts_of(layer.channels);
        const auto count = static_cast<py::ssize_t>(channels.size());
        layers.append(
            py::make_tuple(text_of(layer.name), channels,
                           array_of(std::move(layer.data), {image.data.height, image.data.width, count})));
    }
    return py::make_tuple(layers, to_dict(image.metadata), to_tuple(image.data), to_tuple(image.display),
                          to_dict(image.foreign_metadata), text_of(picture.tiles));
}

image::LayeredImage layered_image_of(const py::tuple& parts) {
    image::LayeredImage image;
    image.data = window_of(parts[2]);
    image.display = window_of(parts[3]);
    if (py::len(parts[0]) == 0) throw std::invalid_argument("an image must have a layer");
    for (const py::handle& part : parts[0]) {
        const auto [name, names, data] = part.cast<std::tuple<py::str, py::list, Pixels>>();
        image::Layer& layer = image.layers.emplace_back();
        layer.name = bytes_of(name);
        std::vector<std::string> channels;
        for (const py::handle& channel : names) channels.push_back(bytes_of(channel));
        check_shape(layer.name, data, image.data, channels.size());
        layer.channels = image::ChannelNames(channels);
        layer.data.assign(data.data(), data.data() + data.size());
    }
    image.metadata = metadata_of(parts[1]);
    image.foreign_metadata = metadata_of(parts[4]);
    const std::string text = bytes_of(parts[5]);
    if (text.empty()) return image;
    const image::PackedTiles tiles(text);
    if (!(tiles.whole() == image.data))
        throw std::invalid_argument(
            "the image is a part of a rendering, whose data window must stay as it is");
    return pack(std::move(image), tiles);
}

void bind_images(py::module_& module) {
    module.def("read_layers", [](const std::string& path) {
        Picture picture = [&] {
            const WithoutGil released;
            return read_picture(path);
        }();
        return to_tuple(std::move(picture));
    });
    module.def("write_layers", [](const std::string& path, const py::tuple& parts) {
        const image::LayeredImage image = layered_image_of(parts);
        const WithoutGil released;
        image::write_layers(path, image);
    });
    module.def("read_image", [](const std::string& path) {
        image::Image image = [&] {
            const WithoutGil released;
            return image::read_image(path);
        }();
        return to_array(std::move(image));
    });
    module.def("write_image", &write_image);
    module.def("is_exr", [](const std::string& path) { return image::is_exr(path); });
    module.def("compare", [](const Pixels& a, const Pixels& reference) {
        return to_dict(with_images(a, reference, image::compare));
    });
    module.def("flip", &flip);
    module.def("hdr_flip", &hdr_flip);
    module.attr("pixels_per_degree") = image::kFlipPixelsPerDegree;
    module.def("psnr", [](const Pixels& a, const Pixels& reference, double exposure) {
        return with_images(a, reference,
                           [&](const auto& x, const auto& y) { return image::psnr(x, y, exposure); });
    });
    module.def("ssim", [](const Pixels& a, const Pixels& reference, double exposure) {
        return with_images(a, reference,
                           [&](const auto& x, const auto& y) { return image::ssim(x, y, exposure); });
    });
}

} // namespace nusselt::python
