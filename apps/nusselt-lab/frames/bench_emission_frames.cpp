#include "bench_emission_frames.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "base/process_time.h"
#include "render_cpu/renderer.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>
#include <stdexcept>

namespace nusselt::app {

namespace {

/// Frames of one scene with one way to sample lights.
struct EmissionFrames {
    std::string emission;
    const render_cpu::Renderer* renderer;
    render::RenderSettings settings;
    std::vector<double> seconds = {}; ///< of processor time, for each repetition
};

/// Replaces the image or profile of each area light and environment by its mean.
/// \returns of how many lights
std::size_t make_uniform(scene::Lights& lights) {
    std::size_t count = 0;
    const auto drop = [&](auto&... indices) {
        if (((indices >= 0) || ...)) ++count;
        ((indices = -1), ...);
    };
    for (scene::PolygonLight& light : lights.of<scene::PolygonLight>()) drop(light.texture, light.profile);
    for (scene::LineLight& light : lights.of<scene::LineLight>()) drop(light.texture, light.profile);
    for (scene::EnvironmentLight& light : lights.of<scene::EnvironmentLight>()) drop(light.map);
    return count;
}

/// Interleaves the frames, so that other load on the machine affects all rows alike.
void measure(std::vector<EmissionFrames>& rows, base::Isa isa, int repetitions) {
    for (int i = 0; i < repetitions; ++i) {
        for (EmissionFrames& row : rows) {
            const double begin = base::process_seconds();
            row.renderer->render(row.settings, isa);
            row.seconds.push_back(base::process_seconds() - begin);
        }
    }
}

} // namespace

void setup_bench_emission_frames(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchEmissionFramesOptions>();
    CLI::App* command = bench.add_subcommand(
        "emission-frames",
        "Cost of lights whose radiance varies, in whole frames with one camera ray per pixel: samples in "
        "proportion to measure times radiance, samples by measure, and the same scene with the mean in place "
        "of each image and profile of area lights and environments. Medians of processor time of interleaved "
        "frames.");
    add_frame_options(*command, *options, "pixel and light");
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_emission_frames(*options); });
}

int run_bench_emission_frames(const BenchEmissionFramesOptions& options) {
    const base::Isa isa = base::choose_isa(options.isa);
    const int threads = render_cpu::checked_thread_count(options.threads);
    scene::Scene scene = load_scene(options.scene, options.json);
    apply_resolution(options.resolution, scene);
    scene::Scene uniform = scene;
    if (make_uniform(uniform.lights) == 0)
        throw std::runtime_error(options.scene.string() +
                                 ": no area light has an image or a profile, and no environment has a map");
    const render_cpu::Renderer varying_renderer(scene, threads), uniform_renderer(uniform, threads);
    render::RenderSettings settings;
    settings.samples = options.samples;
    settings.camera_rays = 1;
    render::RenderSettings by_measure = settings;
    by_measure.emission_sampling = render::EmissionSampling::measure;
    std::vector<EmissionFrames> rows = {{"uniform", &uniform_renderer, settings},
                                        {"measure", &varying_renderer, by_measure},
                                        {"product", &varying_renderer, settings}};
    measure(rows, isa, options.repetitions);

    lab::ResultTable table = {"emission_frames", {{"emission"}, {"seconds", "s"}, {"ratio"}}};
    std::string text = fmt::format("{:<12}{:>12}{:>18}\n", "emission", "CPU ms", "ratio to uniform");
    const double least = median(rows[0].seconds);
    for (const EmissionFrames& row : rows) {
        const double seconds = median(row.seconds);
        text += fmt::format("{:<12}{:>12.1f}{:>18.2f}\n", row.emission, 1e3 * seconds, seconds / least);
        table.rows.push_back({row.emission, seconds, seconds / least});
    }
    const lab::Results results = {
        "emission-frames", frame_settings(options, scene, isa, threads), {std::move(table)}};
    write_results(options.json, results, [&] { fmt::print("{}", text); });
    return 0;
}

} // namespace nusselt::app
