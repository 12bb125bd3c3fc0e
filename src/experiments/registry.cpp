#include "experiments/experiment.h"

#include <fmt/core.h>
#include <fmt/format.h>

namespace nusselt::experiments {

namespace {

using render_cpu::PixelPosition;
using render_cpu::RenderSettings;
using render_cpu::SampleOrder;
using render_cpu::Technique;

/// Camera rays through the centres of pixels, so that light sampling is the only source of noise.
RenderSettings noise_measurement(Technique technique, int samples, SampleOrder order) {
    RenderSettings settings;
    settings.technique = technique;
    settings.samples = samples;
    settings.pixel_position = PixelPosition::center;
    settings.sample_order = order;
    return settings;
}

RenderSettings reference() {
    RenderSettings settings = noise_measurement(Technique::projected_solid_angle, 1024, SampleOrder::sobol);
    settings.seed = 1;
    return settings;
}

std::vector<Variant> one_sample_each(std::initializer_list<Technique> techniques) {
    std::vector<Variant> variants;
    for (const Technique technique : techniques)
        variants.push_back(
            {std::string(name_of(technique)), noise_measurement(technique, 1, SampleOrder::independent)});
    return variants;
}

std::vector<Experiment> make_experiments() {
    return {
        {"line-diffuse",
         "Peters 2021, linear lights, Fig. 6",
         "A Lambertian Cornell box under a tube just below the ceiling, one sample per pixel.",
         "cornell-tube.pbrt",
         reference(),
         one_sample_each({Technique::area, Technique::solid_angle, Technique::clipped_solid_angle,
                          Technique::projected_solid_angle}),
         {AtMost{Metric::rmse_outside_penumbrae, "projected_solid_angle", 1e-4},
          Falling{Metric::rmse_outside_penumbrae,
                  {"area", "solid_angle", "clipped_solid_angle", "projected_solid_angle"}},
          Falling{Metric::rmse, {"area", "solid_angle", "clipped_solid_angle", "projected_solid_angle"}}}},
        {"polygon-diffuse",
         "Peters 2021, polygonal lights, Fig. 12",
         "A Cornell box of roughness one with a panel stretching through it, one sample per pixel.",
         "cornell-panel.pbrt",
         reference(),
         one_sample_each({Technique::area, Technique::solid_angle, Technique::clipped_solid_angle,
                          Technique::projected_solid_angle, Technique::projected_solid_angle_biased}),
         {Falling{Metric::rmse_outside_penumbrae,
                  {"area", "solid_angle", "clipped_solid_angle", "projected_solid_angle"}},
          Falling{Metric::rmse, {"area", "solid_angle", "clipped_solid_angle", "projected_solid_angle"}}}},
    };
}

} // namespace

const std::vector<Experiment>& all_experiments() {
    static const std::vector<Experiment> experiments = make_experiments();
    return experiments;
}

std::string to_text(Metric metric) {
    switch (metric) {
    case Metric::rmse:
        return "RMSE";
    case Metric::rmse_outside_penumbrae:
        return "RMSE outside penumbrae / mean";
    }
    return {};
}

std::string to_text(const Expectation& expectation) {
    if (const auto* limit = std::get_if<AtMost>(&expectation))
        return fmt::format("{} of {} at most {:g}", to_text(limit->metric), limit->variant, limit->limit);
    const auto& falling = std::get<Falling>(expectation);
    return fmt::format("{} falls in the order {}", to_text(falling.metric),
                       fmt::join(falling.variants, ", "));
}

} // namespace nusselt::experiments
