#include "lab/emission/emission_comparisons.h"

namespace nusselt::lab {

namespace {

using render::EmissionSampling;
using render::Mis;
using render::Strategies;
using render::Technique;

/// One sample of a technique and one for the specular component.
render::RenderSettings two_rays(Technique technique, Strategies strategies, Mis mis,
                                EmissionSampling emission) {
    render::RenderSettings settings;
    settings.technique = technique;
    settings.strategies = strategies;
    settings.mis = mis;
    settings.emission_sampling = emission;
    settings.samples = 1;
    settings.pixel_position = render::PixelPosition::center;
    return settings;
}

/// The three strategies of Figure 1, which ignore how the emission varies, and the last of them with samples in
/// proportion to the emission, too.
const Variant kSolidAngle = {"solid_angle + GGX", two_rays(Technique::solid_angle, Strategies::diffuse_ggx,
                                                           Mis::balance, EmissionSampling::measure)};
const Variant kProjected = {"projected_solid_angle + GGX",
                            two_rays(Technique::projected_solid_angle, Strategies::diffuse_ggx, Mis::balance,
                                     EmissionSampling::measure)};
const Variant kMeasure = {"projected_solid_angle + LTC",
                          two_rays(Technique::projected_solid_angle, Strategies::diffuse_ltc,
                                   Mis::clamped_optimal, EmissionSampling::measure)};
const Variant kProduct = {"with emission", two_rays(Technique::projected_solid_angle, Strategies::diffuse_ltc,
                                                    Mis::clamped_optimal, EmissionSampling::product)};

/// The reference takes the strategies of the paper, so that an error of sampling by emission shows as bias.
/// \param share limit of the error outside penumbrae, as a multiple of the error of the strategies of the paper
ImageComparison emission_comparison(const char* name, const char* figure, const char* description,
                                    const char* scene, double share) {
    render::RenderSettings reference = kMeasure.settings;
    reference.samples = 256;
    reference.sample_order = render::SampleOrder::sobol;
    ImageComparison comparison = {
        name,
        std::string("Peters 2021, polygonal lights, ") + figure,
        description,
        scene,
        reference,
        {kSolidAngle, kProjected, kMeasure, kProduct},
        {Falling{{Measure::rmse}, {kSolidAngle.label, kMeasure.label, kProduct.label}},
         AtMostTimes{{Measure::rmse_outside_penumbrae}, kProduct.label, share, {kMeasure.label}},
         Unbiased{{kSolidAngle.label, kProjected.label, kMeasure.label, kProduct.label}}}};
    comparison.frames = 16;
    comparison.reference_frames = 16;
    return comparison;
}

} // namespace

std::vector<ImageComparison> emission_comparisons() {
    return {emission_comparison("textured-light", "Fig. 16b",
                                "A room lit by a television, two rays per pixel: an image as emission.",
                                "television.pbrt", 0.5)};
}

} // namespace nusselt::lab
