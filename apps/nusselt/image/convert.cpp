#include "convert.h"
#include "apps/common/print_message.h"
#include "apps/common/validators.h"
#include "base/file_checks.h"

#include "image/content_hash.h"
#include "image/io.h"
#include "image/layers.h"
#include "image/packed_tiles.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <utility>

namespace nusselt::app {

namespace {

/// The name of a layer as users pass it on the command line.
std::string display_name(const image::Layer& layer) { return layer.name.empty() ? "(picture)" : layer.name; }

void print_layers(const ConvertOptions& options) {
    const image::LayeredImage file = image::read_layer_list(options.input);
    for (const image::Layer& layer : file.layers)
        fmt::print("{:<24} {}\n", display_name(layer), fmt::join(layer.channels, " "));
}

/// The picture, or the layer that the options name.
image::Image read_picture(const ConvertOptions& options) {
    if (!options.layer) return image::read_image(options.input);
    image::LayeredImage file = image::read_layer(options.input, *options.layer);
    if (file.layers.empty())
        throw std::runtime_error(fmt::format("'{}' has no layer '{}'; use --list-layers to list its layers",
                                             options.input.string(), *options.layer));
    return image::layer_image(file.data, std::move(file.layers[0]));
}

/// Warns of values that become infinite.
void make_brighter(image::Image& picture, double exposure) {
    const double scale = std::exp2(exposure);
    std::size_t overflow_count = 0;
    for (float& value : picture.pixels) {
        const float brighter = float(scale * double(value));
        if (std::isinf(brighter) && !std::isinf(value)) ++overflow_count;
        value = brighter;
    }
    if (overflow_count > 0)
        print_message("warning: --exposure {} makes {} of {} values larger than a float can be; they become "
                      "infinite; use a smaller exposure\n",
                      exposure, overflow_count, picture.pixels.size());
}

/// Keeps the metadata of the picture.
void convert_exr_to_exr(const ConvertOptions& options) {
    image::LayeredImage file = image::read_layer_list(options.input);
    image::Image picture = read_picture(options);
    make_brighter(picture, options.exposure);
    file.layers.clear();
    file.layers.push_back(image::color_layer(std::move(picture)));
    file.metadata[image::kConvertedKey] = "yes";
    file.metadata.erase(image::kContentHashKey);
    file.metadata.erase(image::kPackedHashKey);
    image::write_layers(*options.output, file);
}

void convert_to_other_format(const ConvertOptions& options) {
    image::Image picture = read_picture(options);
    make_brighter(picture, options.exposure);
    image::write_image(*options.output, picture);
}

/// \throws CLI::ValidationError
void check_usage(const ConvertOptions& options) {
    if (!options.list_layers && !options.output) throw CLI::RequiredError("OUT");
    if (options.list_layers && options.output)
        throw CLI::ValidationError("--list-layers writes no image; leave out OUT or --list-layers");
    if (options.list_layers && options.layer)
        throw CLI::ValidationError("--list-layers prints all layers; leave out --layer or --list-layers");
    if (options.layer && options.layer->empty())
        throw CLI::ValidationError("--layer needs the name of a layer; leave it out to convert the picture");
}

} // namespace

void setup_convert(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<ConvertOptions>();
    CLI::App* command = app.add_subcommand(
        "convert",
        "Convert an image to another format, given by the extension of OUT. EXR and PFM store floats; "
        "HDR stores 8-bit floats with a common exponent; PNG stores 8 bits with the transfer function "
        "of sRGB, clamped to [0, 1]. PNG, JPG and TGA files are converted to linear when they are "
        "read. From EXR to EXR, metadata and the position of a crop on the film are kept; other "
        "layers are dropped.");
    command
        ->add_option("IN", options->input,
                     "Image to read: .exr, .hdr, .pfm, .png, .jpg, .jpeg or .tga; at most 2^28 pixels")
        ->required();
    command->add_option("OUT", options->output,
                        "Image to write: .exr, .hdr, .pfm or .png; not with --list-layers");
    command
        ->add_option("--exposure", options->exposure,
                     "Brighten the image by this many stops, that is, multiply it by 2^X. Values that exceed "
                     "the largest float become infinite, with a warning")
        ->check(exposure());
    command
        ->add_option("--layer", options->layer,
                     "Layer of an EXR file with one channel (converted to grey) or three")
        ->type_name("NAME")
        ->default_str("the picture, that is, the channels R, G and B, or Y, without the name of a layer");
    command->add_flag("--list-layers", options->list_layers,
                      "Print the layers of the EXR file IN with their channels, and write nothing");
    command->callback([options, &exit_code] {
        check_usage(*options);
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
    base::check_distinct({*options.output}, {options.input});
    if (image::is_exr(options.input) && image::is_exr(*options.output)) {
        convert_exr_to_exr(options);
    } else {
        convert_to_other_format(options);
    }
    return 0;
}

} // namespace nusselt::app
