#include "lab/figures/image_comparison.h"

#include "lab/emission/emission_comparisons.h"
#include "lab/lines/line_comparisons.h"
#include "lab/tubes/tube_comparisons.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace nusselt::lab {

namespace {

using render::Mis;
using render::PixelPosition;
using render::RenderSettings;
using render::SampleOrder;
using render::Strategies;
using render::Technique;

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
    return noise_measurement(Technique::projected_solid_angle, 1024, SampleOrder::sobol);
}

/// A technique for each component of the BRDF.
RenderSettings both(Mis mis, int samples, SampleOrder order = SampleOrder::independent) {
    RenderSettings settings = noise_measurement(Technique::projected_solid_angle, samples, order);
    settings.strategies = Strategies::diffuse_ltc;
    settings.mis = mis;
    return settings;
}

std::vector<Variant> one_sample_each(std::initializer_list<Technique> techniques) {
    std::vector<Variant> variants;
    for (const Technique technique : techniques)
        variants.push_back(
            {std::string(name_of(technique)), noise_measurement(technique, 1, SampleOrder::independent)});
    return variants;
}

/// Published methods that only the laboratory renders, one sample per pixel.
void append_published(std::initializer_list<const char*> techniques, std::vector<Variant>& variants) {
    for (const char* const technique : techniques) variants.push_back({technique, {}, technique});
}

/// Two rays per pixel: projected solid angle sampling alone, and with linearly transformed cosines by these heuristics.
std::vector<Variant> two_rays_each(std::initializer_list<Mis> heuristics) {
    std::vector<Variant> variants = {
        {"projected_solid_angle",
         noise_measurement(Technique::projected_solid_angle, 2, SampleOrder::independent)}};
    for (const Mis mis : heuristics)
        variants.push_back({std::string(name_of(mis)), both(mis, mis == Mis::one_sample ? 2 : 1)});
    return variants;
}

/// One sample of the technique and one of visible normals, under the balance heuristic.
Variant with_visible_normals(Technique technique) {
    RenderSettings settings = noise_measurement(technique, 1, SampleOrder::independent);
    settings.strategies = render::Strategies::diffuse_ggx;
    settings.mis = Mis::balance;
    return {std::string(name_of(technique)) + " + GGX", settings};
}

std::vector<std::string> labels_of(const std::vector<Variant>& variants) {
    std::vector<std::string> labels;
    for (const Variant& variant : variants) labels.push_back(variant.label);
    return labels;
}

ImageComparison line_diffuse() {
    const std::vector<std::string> order = {"area", "solid_angle", "clipped_solid_angle",
                                            "projected_solid_angle"};
    const Metric outside = {Measure::rmse_outside_penumbrae};
    ImageComparison comparison = {
        "line-diffuse",
        "Peters 2021, linear lights, Fig. 6",
        "A Lambertian Cornell box under a tube just below the ceiling, one sample per pixel.",
        "cornell-tube.pbrt",
        reference(),
        one_sample_each({Technique::area, Technique::solid_angle, Technique::clipped_solid_angle,
                         Technique::projected_solid_angle}),
        {AtMost{outside, "projected_solid_angle", 1e-4}, Falling{outside, order},
         Falling{{Measure::rmse}, order},
         // The linear warp deteriorates the ceiling, the quadratic one helps everywhere.
         Falling{outside, {"clipped_solid_angle", "LineClippedQuadraticWarpHart", "projected_solid_angle"}},
         AtMostTimes{outside, "LineProjectedSolidAngleLi", 0.05, {"clipped_solid_angle"}}}};
    append_published(
        {"LineClippedLinearWarpHart", "LineClippedQuadraticWarpHart", "LineProjectedSolidAngleLi"},
        comparison.variants);
    return comparison;
}

ImageComparison polygon_diffuse() {
    const std::vector<std::string> order = {"area", "solid_angle", "clipped_solid_angle",
                                            "projected_solid_angle"};
    const Metric outside = {Measure::rmse_outside_penumbrae};
    ImageComparison comparison = {
        "polygon-diffuse",
        "Peters 2021, polygonal lights, Fig. 12",
        "A Cornell box of roughness one with a panel stretching through it, one sample per pixel.",
        "cornell-panel.pbrt",
        reference(),
        one_sample_each({Technique::area, Technique::solid_angle, Technique::clipped_solid_angle,
                         Technique::projected_solid_angle, Technique::projected_solid_angle_biased}),
        {Falling{outside, order}, Falling{{Measure::rmse}, order},
         Falling{outside,
                 {"solid_angle", "PolygonBilinearWarpHart", "PolygonBiquadraticWarpHart",
                  "projected_solid_angle"}},
         Falling{outside,
                 {"clipped_solid_angle", "PolygonClippedBilinearWarpHart", "projected_solid_angle"}}}};
    append_published({"RectangleSolidAngle", "PolygonSolidAngleArvo", "PolygonBilinearWarpHart",
                      "PolygonClippedBilinearWarpHart", "PolygonBiquadraticWarpHart",
                      "PolygonProjectedSolidAngleArvo", "PolygonProjectedSolidAngleBisection",
                      "PolygonSubdivisionUrena"},
                     comparison.variants);
    comparison.frames = 8;
    return comparison;
}

/// Arvo's method is said to fail where edges are parallel to normals; ours, which shares the sectors of Peters, does not.
ImageComparison tilted_polygon() {
    ImageComparison comparison = {
        "polygon-tilted",
        "Peters 2021, polygonal lights, Fig. 12",
        "The same box with the panel turned by one degree around each axis, one sample per pixel.",
        "evidence/cornell-panel-tilted.pbrt",
        reference(),
        one_sample_each({Technique::projected_solid_angle}),
        {AtMostTimes{{Measure::rmse_outside_penumbrae},
                     "PolygonProjectedSolidAngleArvo",
                     1.5,
                     {"projected_solid_angle"}}}};
    append_published({"PolygonProjectedSolidAngleArvo", "PolygonProjectedSolidAngleBisection"},
                     comparison.variants);
    comparison.frames = 8;
    return comparison;
}

/// Of tiny lights, published techniques other than area sampling lose the position.
/// \param name of the file
ImageComparison far_light(const std::string& name, const std::string& size) {
    ImageComparison comparison = {
        name,
        "Peters 2021, polygonal lights, Fig. 7",
        "A wall lit by a square of " + size + " that is 40 m away, one sample per pixel.",
        "evidence/" + name + ".pbrt",
        noise_measurement(Technique::area, 1024, SampleOrder::sobol),
        one_sample_each({Technique::area, Technique::solid_angle, Technique::projected_solid_angle}),
        {AtMost{{Measure::rmse_outside_penumbrae}, "projected_solid_angle", 1e-3},
         Falling{{Measure::rmse_outside_penumbrae},
                 {"PolygonSolidAngleArvo", "PolygonSolidAnglePeters", "PolygonProjectedSolidAnglePeters",
                  "projected_solid_angle"}}}};
    append_published({"RectangleSolidAngle", "PolygonSolidAngleArvo", "PolygonSolidAnglePeters",
                      "PolygonProjectedSolidAngleArvo", "PolygonProjectedSolidAnglePeters"},
                     comparison.variants);
    return comparison;
}

ImageComparison planes_image() {
    std::vector<Variant> variants =
        two_rays_each({Mis::balance, Mis::clamped_optimal, Mis::weighted_balance});
    variants.push_back(
        {"ltc_analytic", noise_measurement(Technique::ltc_analytic, 1, SampleOrder::independent)});
    ImageComparison experiment = {
        "planes-image",
        "Peters 2021, polygonal lights, Fig. 14",
        "Three planes of roughness 0.2, 0.4, 0.6 under a square light, two samples per pixel.",
        "planes.pbrt",
        both(Mis::clamped_optimal, 1024, SampleOrder::sobol),
        variants,
        // Where nothing casts a shadow, the error of analytic shading is that of the fitted lobes.
        {Falling{{Measure::rmse},
                 {"projected_solid_angle", "balance", "clamped_optimal", "weighted_balance"}},
         AtMost{{Measure::relative_rmse}, "ltc_analytic", 0.05}}};
    experiment.frames = 16;
    return experiment;
}

ImageComparison wall() {
    ImageComparison experiment = {
        "wall",
        "Peters 2021, polygonal lights, Fig. 10",
        "A blue diffuse and a white glossy plane beside a light that a wall hides in part, two rays per "
        "pixel.",
        "wall.pbrt",
        both(Mis::clamped_optimal, 128, SampleOrder::sobol),
        two_rays_each({Mis::balance, Mis::power, Mis::weighted_balance, Mis::clamped_optimal, Mis::optimal,
                       Mis::one_sample, Mis::separate}),
        {}};
    for (const Technique technique : {Technique::solid_angle, Technique::projected_solid_angle})
        experiment.variants.push_back(with_visible_normals(technique));
    const std::vector<std::string> two_rays = labels_of(experiment.variants);
    // One technique is unbiased without any weights; with many samples it confirms the reference.
    experiment.variants.push_back(
        {"projected_solid_angle_64",
         noise_measurement(Technique::projected_solid_angle, 64, SampleOrder::sobol)});
    const Inset lit[] = {{"diffuse, lit", 0.42, 0.10, 0.52, 0.35},
                         {"highlight, lit", 0.285, 0.48, 0.36, 0.55}};
    const Inset penumbrae[] = {{"diffuse penumbra", 0.82, 0.20, 0.98, 0.50},
                               {"highlight penumbra", 0.27, 0.70, 0.37, 0.90}};
    const Inset boundary = {"boundary of the highlight", 0.36, 0.52, 0.42, 0.72};
    experiment.insets = {lit[0], lit[1], penumbrae[0], penumbrae[1], boundary};
    experiment.frames = 64;
    experiment.reference_frames = 32;
    // Where all of the light is visible, the balance heuristic's half of the estimate leaves half of its noise.
    for (const Inset& inset : lit)
        experiment.expectations.push_back(
            AtMostTimes{{Measure::rmse, inset.name}, "clamped_optimal", 0.75, {"balance"}});
    for (const Inset& inset : penumbrae)
        experiment.expectations.push_back(AtMostTimes{
            {Measure::rmse, inset.name}, "clamped_optimal", 1.25, {"balance", "weighted_balance"}});
    // Samples of visible normals that miss the light make the boundary rough.
    experiment.expectations.push_back(AtMostTimes{{Measure::rmse, boundary.name},
                                                  "clamped_optimal",
                                                  0.75,
                                                  {"solid_angle + GGX", "projected_solid_angle + GGX"}});
    experiment.expectations.push_back(AtMostTimes{{Measure::rmse_clamped}, "clamped_optimal", 1, two_rays});
    experiment.expectations.push_back(AtMostTimes{{Measure::rmse}, "weighted_balance", 1, two_rays});
    experiment.expectations.push_back(Unbiased{labels_of(experiment.variants)});
    return experiment;
}

ImageComparison biased() {
    constexpr int kSamples = 4096;
    Variant exact = {"projected_solid_angle", both(Mis::clamped_optimal, kSamples, SampleOrder::sobol)};
    Variant fast = {"projected_solid_angle_biased", exact.settings};
    fast.settings.technique = Technique::projected_solid_angle_biased;
    return {
        "biased",
        "Peters 2021, polygonal lights, Fig. 15",
        "A plane of low roughness under a large light that is hidden in part, converged, with and without "
        "iteration.",
        "biased.pbrt",
        both(Mis::clamped_optimal, kSamples, SampleOrder::sobol),
        {fast, exact},
        {Falling{{Measure::rmse, "plane"}, {fast.label, exact.label}},
         AtMost{{Measure::relative_rmse, "plane"}, fast.label, 0.01}},
        {{"plane", 0, 0.47, 1, 1}}};
}

/// \param scene with the limit of a thin tube, as in the paper, or with a closed cylinder.
ImageComparison tube(const std::string& name, const std::string& scene, const std::string& light) {
    return {name,
            "Peters 2021, linear lights, Fig. 1",
            "A long tube, " + light + ", over a pavement with bollards and a puddle, two rays per pixel.",
            scene,
            both(Mis::clamped_optimal, 1024, SampleOrder::sobol),
            two_rays_each({Mis::balance, Mis::weighted_balance, Mis::clamped_optimal}),
            {AtMostTimes{{Measure::rmse}, "clamped_optimal", 1.0 / 3, {"projected_solid_angle"}},
             AtMostTimes{{Measure::rmse_outside_penumbrae}, "clamped_optimal", 0.75, {"balance"}}}};
}

/// Three samples of each technique.
ImageComparison tube_samplers() {
    ImageComparison comparison = {
        "tube-samplers",
        "Peters 2021, linear lights, Fig. 7",
        "The same tube, three samples of each technique per pixel: independent, jittered and for screen "
        "space.",
        "evidence/bollards-line.pbrt",
        both(Mis::clamped_optimal, 1024, SampleOrder::sobol),
        {},
        {AtMostTimes{{Measure::rmse_in_penumbrae}, "jittered", 0.8, {"independent"}},
         AtMostTimes{{Measure::rmse_in_penumbrae}, "blue_noise", 1.1, {"jittered"}},
         AtMostTimes{{Measure::rmse_blurred}, "blue_noise", 0.8, {"jittered"}}}};
    for (const SampleOrder order :
         {SampleOrder::independent, SampleOrder::jittered, SampleOrder::blue_noise, SampleOrder::z_sobol})
        comparison.variants.push_back({std::string(name_of(order)), both(Mis::clamped_optimal, 3, order)});
    comparison.frames = 4;
    comparison.blur = 2;
    return comparison;
}

} // namespace

const std::vector<ImageComparison>& all_image_comparisons() {
    static const std::vector<ImageComparison> experiments = [] {
        std::vector<ImageComparison> all = {
            line_diffuse(),
            tube("linear-tube", "evidence/bollards-line.pbrt", "the limit of a thin cylinder"),
            tube("tube", "bollards.pbrt", "a closed cylinder"),
            tube_samplers(),
            wall(),
            polygon_diffuse(),
            tilted_polygon(),
            far_light("far-light-1cm", "1 cm"),
            far_light("far-light-1mm", "1 mm"),
            planes_image(),
            biased()};
        for (ImageComparison& experiment : emission_comparisons()) all.push_back(std::move(experiment));
        for (ImageComparison& experiment : line_comparisons()) all.push_back(std::move(experiment));
        for (ImageComparison& experiment : tube_comparisons()) all.push_back(std::move(experiment));
        return all;
    }();
    return experiments;
}

ImageComparison quick(ImageComparison comparison) {
    comparison.width = 192;
    const bool has_frames = comparison.reference_frames > 1;
    comparison.reference.samples = std::min(comparison.reference.samples, has_frames ? 32 : 256);
    comparison.frames = std::min(comparison.frames, 16);
    comparison.reference_frames = std::min(comparison.reference_frames, 16);
    return comparison;
}

std::string to_text(const Metric& metric) {
    const std::string where = metric.inset.empty() ? "" : fmt::format(" in '{}'", metric.inset);
    switch (metric.measure) {
    case Measure::rmse:
        return "RMSE" + where;
    case Measure::rmse_clamped:
        return "RMSE clamped at 1" + where;
    case Measure::relative_rmse:
        return "RMSE / mean" + where;
    case Measure::bias:
        return "bias / mean" + where;
    case Measure::rmse_in_penumbrae:
        return "RMSE in penumbrae / mean";
    case Measure::rmse_blurred:
        return "RMSE after a blur / mean";
    case Measure::rmse_outside_penumbrae:
        break;
    }
    return "RMSE outside penumbrae / mean";
}

namespace {

std::string to_text(const AtMost& e) {
    return fmt::format("{} of {} at most {:g}", to_text(e.metric), e.variant, e.limit);
}

std::string to_text(const AtMostTimes& e) {
    return fmt::format("{} of {} at most {:.3g} times that of {}", to_text(e.metric), e.variant, e.factor,
                       fmt::join(e.others, ", "));
}

std::string to_text(const Falling& e) {
    return fmt::format("{} falls in the order {}", to_text(e.metric), fmt::join(e.variants, ", "));
}

std::string to_text(const Unbiased& e) {
    return fmt::format("the mean is that of the reference: {}", fmt::join(e.variants, ", "));
}

} // namespace

std::string to_text(const Expectation& expectation) {
    return std::visit([](const auto& e) { return to_text(e); }, expectation);
}

} // namespace nusselt::lab
