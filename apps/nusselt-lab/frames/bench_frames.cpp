#include "bench_frames.h"

#include "apps/common/help.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"

namespace nusselt::app {

void add_frame_options(CLI::App& command, BenchFramesOptions& options, const std::string& samples_of) {
    add_scene_argument(command, options.scene);
    command.add_option("--spp", options.samples, "Samples per " + samples_of)
        ->transform(to_whole_number(1, 64))
        ->group(kSamplingGroup);
    command.add_option("--repetitions", options.repetitions, "Runs of each kind")
        ->transform(to_whole_number(1, 1000));
    add_machine_options(command, options.threads, options.isa);
    add_resolution_option(command, options.resolution);
}

void append_line_kind(const render::LineSettings& lines,
                      std::vector<std::pair<std::string, lab::Cell>>& settings) {
    settings.emplace_back("orientation", std::string(name_of(lines.orientation)));
    settings.emplace_back("offsets", std::string(name_of(lines.offsets)));
    settings.emplace_back("line_shading", std::string(name_of(lines.shading)));
}

std::vector<std::pair<std::string, lab::Cell>>
frame_settings(const BenchFramesOptions& options, const scene::Scene& scene, base::Isa isa, int threads) {
    return {{"scene", options.scene.stem().string()},
            {"width", scene.film.width},
            {"height", scene.film.height},
            {"samples", options.samples},
            {"repetitions", options.repetitions},
            {"threads", threads},
            {"isa", std::string(name_of(isa))}};
}

} // namespace nusselt::app
