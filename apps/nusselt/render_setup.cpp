#include "render_setup.h"

#include "render_cpu/film.h"

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

std::string check_resolution(const std::string& text) {
    const std::optional<Resolution> size = parse_resolution(text);
    if (!size) return "'" + text + "' is not of the form WIDTHxHEIGHT, such as 640x480";
    if (std::min(size->width, size->height) < 1 ||
        std::max(size->width, size->height) > render_cpu::kMaxFilmSize)
        return "'" + text + "' has a side that does not lie between 1 and " +
               std::to_string(render_cpu::kMaxFilmSize);
    return "";
}

} // namespace

void add_machine_options(CLI::App& command, std::optional<int>& threads, std::optional<std::string>& isa) {
    constexpr int kMaxThreads = 1024;
    command
        .add_option("--threads", threads, "Threads, 1 to 1024. Default: as many as the machine runs at once")
        ->check(CLI::Range(1, kMaxThreads));
    command
        .add_option("--isa", isa,
                    "Instruction set. Default: the environment variable NUSSELT_ISA, else the best one that\n"
                    "the processor supports")
        ->check(CLI::IsMember({"sse42", "avx2", "avx512"}));
}

void add_resolution_option(CLI::App& command, std::optional<std::string>& resolution) {
    command
        .add_option("--resolution", resolution,
                    "Image size WIDTHxHEIGHT in pixels, each 1 to 65536, keeping the field of view of the\n"
                    "shorter axis. Default: as in the scene")
        ->check(check_resolution, "WIDTHxHEIGHT");
}

void apply_resolution(const std::optional<std::string>& resolution, scene::Scene& scene) {
    if (!resolution) return;
    const std::optional<Resolution> size = parse_resolution(*resolution);
    if (!size) throw std::invalid_argument("resolution " + check_resolution(*resolution));
    render_cpu::resize_film(scene, size->width, size->height);
}

} // namespace nusselt::app
