#include "convert.h"
#include "apps/common/output_files.h"
#include "apps/common/validators.h"

#include "image/io.h"
#include "image/layers.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace nusselt::app {

namespace {

/// The name of a layer as users pass it on the command line.
std::string display_name(const image::Layer& layer) { return layer.name.empty() ? "(picture)" : layer.name; }

void print_layers(const ConvertOptions& options) {
    const image::LayeredImage file = image::read_layer_list(options.input);
    for (const image::Layer& layer : file.layers)
        fmt::print("{:<24} {}\n", display_name(layer), fmt::join(layer.channels, " "));
}

image::Image named_layer(const image::LayeredImage& file, const std::string& name,
                         const std::filesystem::path& path) {
    const image::Layer* layer = image::find_layer(file, name);
    if (layer != nullptr) return image::layer_image(file, *layer);
    throw std::runtime_error(
        fmt::format("'{}' has no layer '{}'; use --list-layers to list its layers", path.string(), name));
}

void make_brighter(image::Image& picture, double exposure) {
    const double scale = std::exp2(exposure);
    for (float& value : picture.pixels) value = float(scale * double(value));
}

/// Keeps the metadata of the picture.
void convert_exr_to_exr(const ConvertOptions& options) {
    const bool named = options.layer.has_value();
    image::LayeredImage file =
        named ? image::read_layers(options.input) : image::read_layer_list(options.input);
    image::Image picture =
        named ? named_layer(file, *options.layer, options.input) : image::read_image(options.input);
    make_brighter(picture, options.exposure);
    file.layers = {image::color_layer(picture)};
    file.metadata[image::kConvertedKey] = "yes";
    image::write_layers(*options.output, file);
}

void convert_to_other_format(const ConvertOptions& options) {
    image::Image picture = options.layer
                               ? named_layer(image::read_layers(options.input), *options.layer, options.input)
                               : image::read_image(options.input);
    make_brighter(picture, options.exposure);
    image::write_image(*options.output, picture);
}

} // namespace

void setup_convert(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<ConvertOptions>();
    CLI::App* command = app.add_subcommand(
        "convert",
        "Convert an image to another format, given by the extension of OUT. EXR and PFM store floats;\n"
        "HDR stores 8-bit floats with a common exponent; PNG stores 8 bits with the transfer function\n"
        "of sRGB, clamped to [0, 1]. PNG, JPG and TGA files are converted to linear when they are\n"
        "read. From EXR to EXR, metadata and the position of a crop on the film are kept; other\n"
        "layers are dropped.");
    command
        ->add_option("IN", options->input,
                     "Image to read: .exr, .hdr, .pfm, .png, .jpg, .jpeg or .tga; at most 2^28 pixels")
        ->required();
    command->add_option("OUT", options->output, "Image to write: .exr, .hdr, .pfm or .png");
    command
        ->add_option("--exposure", options->exposure,
                     "Brighten the image by this many stops, that is, multiply it by 2^N")
        ->check(exposure())
        ->capture_default_str();
    command->add_option(
        "--layer", options->layer,
        "Layer of an EXR file with one channel (converted to grey) or three. Default: the picture, that is,\n"
        "the channels R, G and B, or Y, without the name of a layer");
    command->add_flag("--list-layers", options->list_layers,
                      "Print the layers of the EXR file IN with their channels, and write nothing");
    command->callback([options, &exit_code] {
        if (!options->list_layers && !options->output) throw CLI::RequiredError("OUT");
        exit_code = run_convert(*options);
    });
}

int run_convert(const ConvertOptions& options) {
    if ((options.list_layers || options.layer) && !image::is_exr(options.input))
        throw std::runtime_error("'" + options.input.string() + "' has no layers; only EXR files have them");
    if (options.list_layers) {
        print_layers(options);
        return 0;
    }
    image::check_writable_image(*options.output);
    check_distinct({*options.output}, {options.input});
    if (image::is_exr(options.input) && image::is_exr(*options.output)) {
        convert_exr_to_exr(options);
    } else {
        convert_to_other_format(options);
    }
    return 0;
}

} // namespace nusselt::app
