#pragma once
/// The settings of a rendering. The table behind each enumeration has all of its values, in the order in which
/// they are listed to users.

#include "interface/settings.h"
#include "render/names.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace nusselt::render {

/// Techniques that sample directions towards lights.
enum class Technique : std::uint32_t {
    area = interface::kTechniqueArea,
    solid_angle = interface::kTechniqueSolidAngle,
    clipped_solid_angle = interface::kTechniqueClippedSolidAngle,
    projected_solid_angle = interface::kTechniqueProjectedSolidAngle,
    projected_solid_angle_biased =
        interface::kTechniqueProjectedSolidAngleBiased, ///< for line lights the same as projected_solid_angle
    ltc_analytic = interface::
        kTechniqueLtcAnalytic, ///< integrals of linearly transformed cosines: no samples and no shadows
};

template <>
inline constexpr auto kNames<Technique> = std::to_array<Named<Technique>>({
    {Technique::area, "area"},
    {Technique::solid_angle, "solid_angle"},
    {Technique::clipped_solid_angle, "clipped_solid_angle"},
    {Technique::projected_solid_angle, "projected_solid_angle"},
    {Technique::projected_solid_angle_biased, "projected_solid_angle_biased"},
    {Technique::ltc_analytic, "ltc_analytic"},
});
inline constexpr auto kTechniques = values_of(kNames<Technique>);
static_assert(kTechniques.size() == interface::kTechniqueCount);

/// The set of techniques that take samples of a light.
enum class Strategies : std::uint32_t {
    diffuse = interface::
        kStrategiesDiffuse, ///< one for all components of the BRDF: that of RenderSettings::technique
    diffuse_ltc = interface::
        kStrategiesDiffuseLtc, ///< that one for the diffuse component, linearly transformed cosines for the specular one
    // The same with GGX visible normals for the specular one. No such sample hits a linear light: they are left to the
    // technique for the diffuse component.
    diffuse_ggx = interface::kStrategiesDiffuseGgx,
    diffuse_ggx_bounded = interface::kStrategiesDiffuseGgxBounded,
};

template <>
inline constexpr auto kNames<Strategies> = std::to_array<Named<Strategies>>({
    {Strategies::diffuse, "diffuse"},
    {Strategies::diffuse_ltc, "diffuse+ltc"},
    {Strategies::diffuse_ggx, "diffuse+ggx"},
    {Strategies::diffuse_ggx_bounded, "diffuse+ggx_bounded"},
});
inline constexpr auto kStrategies = values_of(kNames<Strategies>);
static_assert(kStrategies.size() == interface::kStrategiesCount);

/// What samples of lights whose radiance varies, such as those with a texture, are proportional to.
enum class EmissionSampling : std::uint32_t {
    /// Radiance times the measure of Technique::projected_solid_angle, and of linearly transformed cosines for the specular
    /// component. Other techniques do not know the radiance.
    product = interface::kEmissionSamplingProduct,
    measure =
        interface::kEmissionSamplingMeasure, ///< the measure alone (Peters 2021, polygonal lights, Sec. 6.5)
};

template <>
inline constexpr auto kNames<EmissionSampling> = std::to_array<Named<EmissionSampling>>({
    {EmissionSampling::product, "product"},
    {EmissionSampling::measure, "measure"},
});
inline constexpr auto kEmissionSamplings = values_of(kNames<EmissionSampling>);
static_assert(kEmissionSamplings.size() == interface::kEmissionSamplingCount);

/// Heuristics that combine samples of several techniques; see nusselt/estimate/mis.h.
enum class Mis : std::uint32_t {
    balance = interface::kMisBalance,
    power = interface::kMisPower,
    weighted_balance = interface::kMisWeightedBalance,
    clamped_optimal = interface::kMisClampedOptimal,
    optimal = interface::kMisOptimal,
    one_sample = interface::kMisOneSample, ///< one sample of either technique instead of one of each
    separate = interface::kMisSeparate,    ///< each technique estimates its own component of the BRDF only
};

template <>
inline constexpr auto kNames<Mis> = std::to_array<Named<Mis>>({
    {Mis::balance, "balance"},
    {Mis::power, "power"},
    {Mis::weighted_balance, "weighted_balance"},
    {Mis::clamped_optimal, "clamped_optimal"},
    {Mis::optimal, "optimal"},
    {Mis::one_sample, "one_sample"},
    {Mis::separate, "separate"},
});
inline constexpr auto kMisHeuristics = values_of(kNames<Mis>);
static_assert(kMisHeuristics.size() == interface::kMisCount);

/// The pattern of the samples of a pixel and light; see nusselt::Sampler.
enum class SampleOrder : std::uint32_t {
    independent = interface::kSamplerIndependent,
    sobol = interface::kSamplerSobol,
    jittered = interface::kSamplerJittered,
    stratified = interface::kSamplerStratified,
    z_sobol = interface::kSamplerZSobol,
    blue_noise = interface::kSamplerBlueNoise,
};

template <>
inline constexpr auto kNames<SampleOrder> = std::to_array<Named<SampleOrder>>({
    {SampleOrder::independent, "independent"},
    {SampleOrder::sobol, "sobol"},
    {SampleOrder::jittered, "jittered"},
    {SampleOrder::stratified, "stratified"},
    {SampleOrder::z_sobol, "z_sobol"},
    {SampleOrder::blue_noise, "blue_noise"},
});
inline constexpr auto kSampleOrders = values_of(kNames<SampleOrder>);
static_assert(kSampleOrders.size() == interface::kSamplerCount);

/// The position at which camera rays pass through their pixel.
enum class PixelPosition : std::uint32_t { jittered, center };

template <>
inline constexpr auto kNames<PixelPosition> = std::to_array<Named<PixelPosition>>({
    {PixelPosition::jittered, "jittered"},
    {PixelPosition::center, "center"},
});
inline constexpr auto kPixelPositions = values_of(kNames<PixelPosition>);

/// The choice of the BRDF for all surfaces.
enum class BrdfChoice : std::uint32_t {
    material = interface::kBrdfMaterial, ///< that of the scene file
    lambert = interface::kBrdfLambert,   ///< diffuse albedo / pi
};

template <>
inline constexpr auto kNames<BrdfChoice> = std::to_array<Named<BrdfChoice>>({
    {BrdfChoice::material, "material"},
    {BrdfChoice::lambert, "lambert"},
});
inline constexpr auto kBrdfChoices = values_of(kNames<BrdfChoice>);
static_assert(kBrdfChoices.size() == interface::kBrdfCount);

/// Layers of an image beside the radiance of its pixels; see make_frame().
enum class LayerKind : std::uint32_t {
    albedo,
    normal,
    depth,
    emission,
    diffuse,
    specular,
    lights,
    pieces, ///< visible parts per line sample
    variance,
};

template <>
inline constexpr auto kNames<LayerKind> = std::to_array<Named<LayerKind>>({
    {LayerKind::albedo, "albedo"},
    {LayerKind::normal, "normal"},
    {LayerKind::depth, "depth"},
    {LayerKind::emission, "emission"},
    {LayerKind::diffuse, "diffuse"},
    {LayerKind::specular, "specular"},
    {LayerKind::lights, "lights"},
    {LayerKind::pieces, "pieces"},
    {LayerKind::variance, "variance"},
});
inline constexpr auto kLayerKinds = values_of(kNames<LayerKind>);

/// One of several shares of the tiles of an image, for work on several machines.
struct Part {
    int number = 1; ///< 1 to count
    int count = 1;  ///< 1 to kMaxParts
    bool operator==(const Part&) const = default;
};

/// Samples of polygonal lights: points or lines. Linear lights always get points.
enum class LightSamples : std::uint32_t {
    points,
    lines, ///< whole segments, with exact visibility
};

template <>
inline constexpr auto kNames<LightSamples> = std::to_array<Named<LightSamples>>({
    {LightSamples::points, "points"},
    {LightSamples::lines, "lines"},
});
inline constexpr auto kLightSamples = values_of(kNames<LightSamples>);

/// Directions of line samples in the plane of their light.
enum class LineOrientation : std::uint32_t {
    parallel,    ///< random, the same for all lines of a shading point and light
    fixed,       ///< along the longest edge of the light
    independent, ///< random for each line
};

template <>
inline constexpr auto kNames<LineOrientation> = std::to_array<Named<LineOrientation>>({
    {LineOrientation::parallel, "parallel"},
    {LineOrientation::fixed, "fixed"},
    {LineOrientation::independent, "independent"},
});
inline constexpr auto kLineOrientations = values_of(kNames<LineOrientation>);

/// Density of the offsets of line samples.
enum class LineOffsets : std::uint32_t {
    length, ///< in proportion to the length of the line on the light
    uniform,
    reflected, ///< in proportion to what the surface would reflect of the line without shadows
};

template <>
inline constexpr auto kNames<LineOffsets> = std::to_array<Named<LineOffsets>>({
    {LineOffsets::length, "length"},
    {LineOffsets::uniform, "uniform"},
    {LineOffsets::reflected, "reflected"},
});
inline constexpr auto kLineOffsets = values_of(kNames<LineOffsets>);

/// The estimator for the visible parts of a line sample.
enum class LineShading : std::uint32_t {
    unbiased, ///< the integral of a fitted lobe, and one point for what the BRDF is beyond that
    analytic, ///< the integral of the fitted lobe alone
};

template <>
inline constexpr auto kNames<LineShading> = std::to_array<Named<LineShading>>({
    {LineShading::unbiased, "unbiased"},
    {LineShading::analytic, "analytic"},
});
inline constexpr auto kLineShadings = values_of(kNames<LineShading>);

/// Samples of lights behind many potential occluders.
enum class ManyOccluders : std::uint32_t {
    points, ///< point samples, where these are cheaper
    lines,  ///< line samples, as everywhere
};

template <>
inline constexpr auto kNames<ManyOccluders> = std::to_array<Named<ManyOccluders>>({
    {ManyOccluders::points, "points"},
    {ManyOccluders::lines, "lines"},
});
inline constexpr auto kManyOccludersChoices = values_of(kNames<ManyOccluders>);

struct LineSettings {
    int count = 16; ///< per shading point and light, 1 to kMaxLines
    LineOrientation orientation = LineOrientation::parallel;
    LineOffsets offsets = LineOffsets::reflected;
    LineShading shading = LineShading::unbiased;
    ManyOccluders many_occluders = ManyOccluders::points;
    bool operator==(const LineSettings&) const = default;
};

inline constexpr int kMaxLines = 1 << 16;
/// Bound on the lines of a pixel and light, over all of its camera rays.
inline constexpr std::int64_t kMaxLinesPerPixel = std::int64_t(1) << 31;
inline constexpr int kMaxSamples = 1 << 20;
inline constexpr int kMaxParts = 1 << 20;

struct RenderSettings {
    LightSamples light_samples = LightSamples::points;
    LineSettings lines; ///< for LightSamples::lines
    Technique technique = Technique::projected_solid_angle;
    Strategies strategies = Strategies::diffuse;
    EmissionSampling emission_sampling = EmissionSampling::product;
    Mis mis = Mis::clamped_optimal;
    float visibility_estimate = 0.5f; ///< for Mis::clamped_optimal and optimal, in [0, 1]
    int samples = 1;                  ///< per pixel, light and technique, 1 to kMaxSamples
    std::optional<int> camera_rays;   ///< per pixel, a divisor of samples; default: see camera_ray_count()
    PixelPosition pixel_position = PixelPosition::jittered;
    SampleOrder sample_order = SampleOrder::sobol;
    BrdfChoice brdf = BrdfChoice::material;
    std::uint32_t seed = 0;
    std::vector<LayerKind> layers; ///< beside the image; in any order
    Part part;
    bool operator==(const RenderSettings&) const = default;
};

/// Whether there are samples of these strategies with the technique for the diffuse component.
bool allows(Technique technique, Strategies strategies);

bool samples_visible_normals(Strategies strategies);

/// Whether the heuristic is of use for samples of these strategies: some need to know what lights contribute unshadowed,
/// which sampling of visible normals does not tell.
bool allows(Strategies strategies, Mis mis);

/// Whether the heuristic weighs samples by RenderSettings::visibility_estimate.
bool uses_visibility_estimate(Mis mis);

/// Whether linearly transformed cosines are needed.
bool uses_lobes(const RenderSettings& settings);

/// Camera rays per pixel: as given, else one for each sample if their positions differ, else one.
int camera_ray_count(const RenderSettings& settings);

/// Whether the noise of pixels is known: it is estimated from the differences between camera rays.
bool has_variance(const RenderSettings& settings);

/// \throws std::invalid_argument naming the first setting out of range, its value and the range
void validate(const RenderSettings& settings);

} // namespace nusselt::render
