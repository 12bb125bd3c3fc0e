#include "render_setup.h"

#include "base/isa.h"
#include "render/film.h"
#include "scene/model/limits.h"

#include <algorithm>
#include <charconv>

namespace nusselt::app {

namespace {

struct Resolution {
    int width = 0;
    int height = 0;
};

std::optional<Resolution> parse_resolution(const std::string& text) {
    Resolution resolution;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, resolution.width);
    if (width.ec != std::errc() || width.ptr == end || *width.ptr != 'x') return {};
    const auto height = std::from_chars(width.ptr + 1, end, resolution.height);
    if (height.ec != std::errc() || height.ptr != end) return {};
    return resolution;
}

std::string check_part(const std::string& text) {
    if (parse_part(text)) return "";
    return "'" + text +
           "' must have the form NUMBER/COUNT, such as 1/4, with a NUMBER from 1 to COUNT and a COUNT of at "
           "most " +
           std::to_string(render::kMaxParts);
}

std::string check_resolution(const std::string& text) {
    const std::optional<Resolution> size = parse_resolution(text);
    if (!size) return "'" + text + "' must have the form WIDTHxHEIGHT, such as 640x480";
    if (std::min(size->width, size->height) < 1 || std::max(size->width, size->height) > scene::kMaxFilmSize)
        return "'" + text + "' must have sides from 1 to " + std::to_string(scene::kMaxFilmSize);
    return "";
}

} // namespace

void add_machine_options(CLI::App& command, std::optional<int>& threads, std::optional<std::string>& isa,
                         const std::string& default_threads) {
    constexpr int kMaxThreads = 1024;
    command.add_option("--threads", threads, "Threads, 1 to 1024. Default: " + default_threads)
        ->check(CLI::Range(1, kMaxThreads));
    add_isa_option(command, isa);
}

void add_isa_option(CLI::App& command, std::optional<std::string>& isa) {
    command
        .add_option(
            "--isa", isa,
            "Instruction set. Default: the environment variable NUSSELT_ISA if set, else the best one\n"
            "that the processor supports")
        ->check(CLI::IsMember(names_of(base::kAllIsas)));
}

void add_resolution_option(CLI::App& command, std::optional<std::string>& resolution) {
    command
        .add_option("--resolution", resolution,
                    "Image size WIDTHxHEIGHT in pixels, each 1 to 65536. Keeps the field of view along the\n"
                    "shorter axis. Default: the size in the scene")
        ->check(check_resolution, "WIDTHxHEIGHT");
}

void apply_resolution(const std::optional<std::string>& resolution, scene::Scene& scene) {
    if (!resolution) return;
    const std::optional<Resolution> size = parse_resolution(*resolution);
    if (!size) throw std::invalid_argument("resolution " + check_resolution(*resolution));
    render::resize_film(scene, size->width, size->height);
}

void add_layers_option(CLI::App& command, std::vector<std::string>& layers) {
    std::vector<std::string> names = names_of(render::kLayerKinds);
    names.emplace_back(kAllLayers);
    command
        .add_option(
            "--layers", layers,
            "Layers to store in EXR files beside the image, separated by commas: albedo, normal, depth,\n"
            "emission, diffuse, specular, lights (each lamp alone), pieces (visible parts per line\n"
            "sample), variance (of the mean of each pixel; needs two or more camera rays per pixel),\n"
            "or all. Default: none")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::IsMember(names));
}

void add_part_option(CLI::App& command, std::optional<std::string>& part) {
    command
        .add_option(
            "--part", part,
            "Render only the tiles of this part, such as 1/4, into an EXR file; `nusselt merge` joins\n"
            "all parts to the whole image. Default: 1/1")
        ->check(check_part, "NUMBER/COUNT");
}

std::optional<render::Part> parse_part(const std::string& text) {
    render::Part part;
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, part.number);
    if (number.ec != std::errc() || number.ptr == end || *number.ptr != '/') return {};
    const auto count = std::from_chars(number.ptr + 1, end, part.count);
    if (count.ec != std::errc() || count.ptr != end) return {};
    const bool is_possible =
        part.count >= 1 && part.count <= render::kMaxParts && part.number >= 1 && part.number <= part.count;
    return is_possible ? std::optional(part) : std::nullopt;
}

} // namespace nusselt::app
