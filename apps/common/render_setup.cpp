#include "render_setup.h"

#include "help.h"
#include "validators.h"

#include "base/isa.h"
#include "render/film.h"
#include "scene/model/limits.h"

#include <fmt/core.h>

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

void add_scene_argument(CLI::App& command, std::filesystem::path& scene) {
    command.add_option("SCENE", scene, "Scene file in pbrt syntax, version 3 or 4")->required();
}

void add_threads_option(CLI::App& command, std::optional<int>& threads, const std::string& default_threads) {
    constexpr int kMaxThreads = 1024;
    command.add_option("--threads", threads, "Number of threads")
        ->transform(to_whole_number(1, kMaxThreads))
        ->default_str(default_threads)
        ->group(kDeviceGroup);
}

void add_machine_options(CLI::App& command, std::optional<int>& threads, std::optional<std::string>& isa,
                         const std::string& default_threads) {
    add_threads_option(command, threads, default_threads);
    add_isa_option(command, isa);
}

void add_isa_option(CLI::App& command, std::optional<std::string>& isa) {
    command.add_option("--isa", isa, "Instruction set")
        ->transform(to_one_of(names_of(base::kAllIsas)))
        ->default_str(
            "the environment variable NUSSELT_ISA if set, else the best one that the processor supports")
        ->group(kDeviceGroup);
}

void add_resolution_option(CLI::App& command, std::optional<std::string>& resolution) {
    command
        .add_option("--resolution", resolution,
                    fmt::format("Image size in pixels, each side from 1 to {}, at most 2^28 pixels in all. "
                                "The field of view along the shorter "
                                "axis stays the same",
                                scene::kMaxFilmSize))
        ->type_name("WIDTHxHEIGHT")
        ->check(check_resolution)
        ->default_str("the size in the scene")
        ->group(kSceneGroup);
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
            "Layers to store in EXR files beside the image: albedo, normal, depth, emission, diffuse, "
            "specular, lights (each lamp alone), pieces (visible parts per line sample), variance (of the "
            "mean of each pixel; needs two or more camera rays per pixel), or all")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->transform(to_one_of(names))
        ->default_str(kNone)
        ->group(kOutputGroup);
}

void add_part_option(CLI::App& command, std::optional<std::string>& part) {
    command
        .add_option(
            "--part", part,
            "Render only the tiles of this part, such as 1/4, into an EXR file; `nusselt merge` joins all "
            "parts to the whole image")
        ->type_name("NUMBER/COUNT")
        ->check(check_part)
        ->default_str("1/1")
        ->group(kPartsGroup);
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
