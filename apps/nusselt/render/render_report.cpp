#include "render_report.h"
#include "apps/common/line_options.h"
#include "apps/common/print_message.h"
#include "render_files.h"

#include "base/json_output.h"
#include "base/memory_text.h"
#include "image/io.h"
#include "render/choices/line_choice.h"
#include "scene/model/scene_size.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

namespace nusselt::app {

namespace {

/// Null without line samples.
nlohmann::ordered_json line_samples_json(const render::RenderSettings& settings,
                                         const render::LineStatistics& work) {
    if (settings.light_samples != render::LightSamples::lines) return nullptr;
    const render::LineSettings& lines = settings.lines;
    const auto per_line = [&](std::uint64_t count) {
        return work.lines > 0 ? static_cast<double>(count) / static_cast<double>(work.lines) : 0.0;
    };
    nlohmann::ordered_json json = {{"lines", lines.count}};
    json.update(line_kind_json(lines));
    json.update({{"many_occluders", render::name_of(lines.many_occluders)},
                 {"bvh_seconds", work.build_seconds},
                 {"visibility_thread_seconds", work.visibility_seconds},
                 {"traced_lines", work.lines},
                 {"lights_with_lines", work.line_lights},
                 {"lights_with_points", work.point_lights},
                 {"box_tests", work.box_tests},
                 {"triangle_tests", work.triangle_tests},
                 {"shadow_tests", work.shadow_tests},
                 {"parts_per_line", per_line(work.parts)}});
    return json;
}

/// Scene and settings.
nlohmann::ordered_json settings_json(const RenderOptions& options, const render::RenderSettings& settings,
                                     const scene::Scene& scene) {
    nlohmann::ordered_json rigs = nlohmann::ordered_json::array();
    for (const std::filesystem::path& rig : options.rigs) rigs.push_back(rig.string());
    const bool is_combined = settings.strategies != render::Strategies::diffuse;
    return {
        {"scene", options.scene.string()},
        {"light_rigs", rigs},
        {"triangles", scene.triangles.size()},
        {"scene_bytes", scene::array_bytes(scene)},
        {"width", scene.film.width},
        {"height", scene.film.height},
        {"light_samples", render::name_of(settings.light_samples)},
        {"technique", render::name_of(settings.technique)},
        {"strategies", render::name_of(settings.strategies)},
        {"mis", is_combined ? nlohmann::ordered_json(render::name_of(settings.mis)) : nullptr},
        {"visibility_estimate", is_combined ? nlohmann::ordered_json(settings.visibility_estimate) : nullptr},
        {"samples", settings.samples},
        {"camera_rays", render::camera_ray_count(settings)},
        {"pixel_position", render::name_of(settings.pixel_position)},
        {"sampler", render::name_of(settings.sample_order)},
        {"brdf", render::name_of(settings.brdf)},
        {"seed", settings.seed},
        {"part", fmt::format("{}/{}", settings.part.number, settings.part.count)}};
}

nlohmann::ordered_json to_json(const render::NamedSeconds& times) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const auto& [name, seconds] : times) json[name] = seconds;
    return json;
}

double rate(std::uint64_t rays, double seconds) {
    return seconds > 0 ? static_cast<double>(rays) / seconds : 0.0;
}

} // namespace

void print_warnings(const RenderOptions& options, const render::RenderSettings& settings,
                    const scene::Scene& scene) {
    for (const std::string& warning : scene.warnings) print_message("warning: {}\n", warning);
    if (options.lines.has_old_name)
        print_message(
            "warning: --integrator is now called --light-samples; the next version removes the old name\n");
    if (scene.emitters.empty())
        print_message("warning: the scene has no lights, so the image is black; add lights with --lights\n");
    // Lights without extent, whose emission is no radiance, have nothing to sample.
    for (const scene::LightList& list : scene.lights)
        if (samples_visible_normals(settings.strategies) && !list.has_brdf_samples() && list.size() > 0 &&
            list.quantity() == scene::kRadiance)
            print_message(
                "warning: --strategies {}: visible normals support only polygons; {} alone samples {} {}\n",
                name_of(settings.strategies), name_of(settings.technique), list.size(),
                list.size() == 1 ? list.noun() : list.plural());
    if (settings.light_samples == render::LightSamples::lines &&
        settings.lines.many_occluders == render::ManyOccluders::points &&
        render::most_occluders_for_lines(settings.lines.count) < 0)
        print_message(
            "warning: --lines {}: points replace the lines because they are faster than fewer than 16 "
            "lines; use --many-occluders lines to keep lines\n",
            settings.lines.count);
    const std::vector<std::filesystem::path> outputs = output_paths(options, scene.film);
    if (options.exposure != 0 && std::none_of(outputs.begin(), outputs.end(), image::is_png))
        print_message("warning: --exposure has no effect, as none of the images is a PNG file\n");
    const auto wants_variance =
        std::count(settings.layers.begin(), settings.layers.end(), render::LayerKind::variance) > 0;
    if (wants_variance && !has_variance(settings))
        print_message(
            "warning: the layer of the variance is missing because it needs two or more camera rays "
            "per pixel; raise --spp{}\n",
            options.camera_rays ? " and --camera-rays" : "");
}

void print_layers(const render::FrameSize& size, std::size_t sum_bytes) {
    print_message("the image and its layers ({}) need {} of memory for {} x {} pixels\n", size.layers,
                  base::memory_text(static_cast<double>(size.bytes + sum_bytes)), size.width, size.height);
}

nlohmann::ordered_json report_json(const RenderOptions& options, const render::RenderSettings& settings,
                                   const scene::Scene& scene, const render::Backend& backend,
                                   const render::RenderStatistics& statistics, const Times& times) {
    const render::TimeReport spent = backend.times(statistics);
    nlohmann::ordered_json seconds = {{"load", times.load}};
    seconds.update(to_json(spent.preparation));
    seconds.update({{"render", statistics.render_seconds}, {"write", times.write}, {"total", times.total}});

    nlohmann::ordered_json json = settings_json(options, settings, scene);
    json["backend"] = backend.name();
    for (const auto& [name, value] : backend.properties()) json[name] = value;
    if (statistics.threads > 0) json["threads"] = statistics.threads;
    json["seconds"] = seconds;
    json[spent.work_name] = to_json(spent.work);
    json["rays"] = {{"primary", statistics.primary_rays}, {"shadow", statistics.shadow_rays}};
    json["line_samples"] = line_samples_json(settings, statistics.lines);
    json["rejected_samples"] = statistics.rejected_samples;
    if (statistics.threads > 0)
        json["rays_per_thread_second"] = {
            {"primary", rate(statistics.primary_rays, statistics.primary_seconds)},
            {"shadow", rate(statistics.shadow_rays, statistics.shadow_seconds)}};
    // Most time goes into lines then.
    const bool has_lines = settings.light_samples == render::LightSamples::lines;
    json["rays_per_second"] =
        has_lines ? nullptr
                  : nlohmann::ordered_json(
                        rate(statistics.primary_rays + statistics.shadow_rays, statistics.render_seconds));
    return json;
}

void write_report(const std::string& target, const nlohmann::ordered_json& report) {
    // Paths may hold bytes that are not UTF-8.
    base::write_json(target,
                     report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

} // namespace nusselt::app
