#include "lab/emission/emission_comparisons.h"

namespace nusselt::lab {

namespace {

using render::EmissionSampling;
using render::Mis;
using render::Strategies;
using render::Technique;

/// Samples of a technique, and as many for the specular component.
render::RenderSettings pairs(int samples, Technique technique, Strategies strategies, Mis mis,
                             EmissionSampling emission) {
    render::RenderSettings settings;
    settings.technique = technique;
    settings.strategies = strategies;
    settings.mis = mis;
    settings.emission_sampling = emission;
    settings.samples = samples;
    settings.camera_rays = 1;
    settings.pixel_position = render::PixelPosition::center;
    return settings;
}

/// The three strategies of Figure 1, which ignore how the emission varies, and the last of them with samples in
/// proportion to the emission, too.
const Variant kSolidAngle = {"solid_angle + GGX", pairs(1, Technique::solid_angle, Strategies::diffuse_ggx,
                                                        Mis::balance, EmissionSampling::measure)};
const Variant kProjected = {"projected_solid_angle + GGX",
                            pairs(1, Technique::projected_solid_angle, Strategies::diffuse_ggx, Mis::balance,
                                  EmissionSampling::measure)};
const Variant kMeasure = {"projected_solid_angle + LTC",
                          pairs(1, Technique::projected_solid_angle, Strategies::diffuse_ltc,
                                Mis::clamped_optimal, EmissionSampling::measure)};
const Variant kProduct = {"with emission", pairs(1, Technique::projected_solid_angle, Strategies::diffuse_ltc,
                                                 Mis::clamped_optimal, EmissionSampling::product)};

/// The strategies of the paper in more time than products take, which take two to six times as long as one sample does here.
const Variant kMoreMeasure = {"projected_solid_angle + LTC, 16 samples",
                              pairs(16, Technique::projected_solid_angle, Strategies::diffuse_ltc,
                                    Mis::clamped_optimal, EmissionSampling::measure)};

ImageComparison emission_comparison(const char* name, const char* figure, const char* description,
                                    const char* scene, const Variant& reference,
                                    std::vector<Variant> variants) {
    ImageComparison comparison = {name,
                                  std::string("Peters 2021, polygonal lights, ") + figure,
                                  description,
                                  scene,
                                  reference.settings,
                                  std::move(variants),
                                  {}};
    comparison.reference.samples = 256;
    comparison.reference.sample_order = render::SampleOrder::sobol;
    comparison.frames = 16;
    comparison.reference_frames = 16;
    return comparison;
}

/// Products have less noise than the strategies of the paper outside of penumbrae.
/// \param share limit of their error, as a multiple
AtMostTimes less_noise(double share) {
    return {{Measure::rmse_outside_penumbrae}, kProduct.label, share, {kMeasure.label}};
}

// References take the strategies of the paper, so that an error of sampling by emission shows as bias.

ImageComparison textured_light() {
    ImageComparison comparison = emission_comparison(
        "textured-light", "Fig. 16b", "A room lit by a television, two rays per pixel: an image as emission.",
        "television.pbrt", kMeasure, {kSolidAngle, kProjected, kMeasure, kProduct});
    comparison.expectations = {
        Falling{{Measure::rmse}, {kSolidAngle.label, kMeasure.label, kProduct.label}}, less_noise(0.5),
        Unbiased{{kSolidAngle.label, kProjected.label, kMeasure.label, kProduct.label}}};
    return comparison;
}

ImageComparison profiled_light() {
    ImageComparison comparison = emission_comparison(
        "profiled-light", "Fig. 16a",
        "A gallery below a light with an IES profile, two rays per pixel: noise at hard transitions.",
        "evidence/gallery.pbrt", kMeasure, {kSolidAngle, kProjected, kMeasure, kProduct, kMoreMeasure});
    comparison.expectations = {
        Falling{{Measure::rmse}, {kSolidAngle.label, kMeasure.label, kProduct.label}}, less_noise(0.25),
        Unbiased{{kSolidAngle.label, kProjected.label, kMeasure.label, kProduct.label}}};
    return comparison;
}

ImageComparison portal() {
    ImageComparison comparison = emission_comparison(
        "portal", "Fig. 1",
        "An attic that the sky lights through a window with five corners, two rays per pixel.",
        "evidence/attic.pbrt", kMeasure, {kSolidAngle, kProjected, kMeasure, kProduct, kMoreMeasure});
    comparison.expectations = {
        Falling{{Measure::rmse_outside_penumbrae}, {kSolidAngle.label, kMeasure.label}},
        // The sky varies little behind the window: to know it is of little use, so that most points take the measure.
        AtMostTimes{{Measure::rmse_outside_penumbrae}, kProduct.label, 1.05, {kMeasure.label}},
        AtMostTimes{{Measure::rmse_outside_penumbrae}, kMeasure.label, 1.25, {kProduct.label}},
        Unbiased{{kSolidAngle.label, kProjected.label, kMeasure.label, kProduct.label}}};
    return comparison;
}

/// The strategies of the paper rarely meet the sun: the reference does not take them.
ImageComparison portal_with_sun() {
    ImageComparison comparison =
        emission_comparison("portal-sun", "Sec. 6.5",
                            "A room that sky and sun light through a window: the contrast for which the "
                            "paper asks for other samples.",
                            "window.pbrt", kProduct, {kMeasure, kProduct, kMoreMeasure});
    comparison.expectations = {
        AtMostTimes{{Measure::rmse}, kProduct.label, 0.2, {kMeasure.label, kMoreMeasure.label}},
        Unbiased{{kProduct.label}}};
    return comparison;
}

} // namespace

std::vector<ImageComparison> emission_comparisons() {
    return {portal(), portal_with_sun(), profiled_light(), textured_light()};
}

} // namespace nusselt::lab
