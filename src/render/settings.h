#pragma once
/// What a user can choose about a rendering.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace nusselt::render {

/// How directions towards lights are sampled.
enum class Technique : std::uint32_t {
    area,
    solid_angle,
    clipped_solid_angle,
    projected_solid_angle,
    projected_solid_angle_biased, ///< for line lights the same as projected_solid_angle
    ltc_analytic,                 ///< integrals of linearly transformed cosines: no samples and no shadows
};

/// Which techniques take samples of a light.
enum class Strategies : std::uint32_t {
    diffuse,     ///< one for all components of the BRDF: that of RenderSettings::technique
    diffuse_ltc, ///< that one for the diffuse component, linearly transformed cosines for the specular one
    // The same with GGX visible normals for the specular one. No such sample hits a linear light: they are left to the
    // technique for the diffuse component.
    diffuse_ggx,
    diffuse_ggx_bounded,
};

/// How samples of several techniques are combined; see nusselt/estimate/mis.h.
enum class Mis : std::uint32_t {
    balance,
    power,
    weighted_balance,
    clamped_optimal,
    optimal,
    one_sample, ///< one sample of either technique instead of one of each
    separate,   ///< each technique estimates its own component of the BRDF only
};

/// How the samples of a pixel and light relate to each other; see nusselt::Sampler.
enum class SampleOrder : std::uint32_t { independent, sobol, jittered, stratified };

/// Where camera rays pass through their pixel.
enum class PixelPosition : std::uint32_t { jittered, center };

/// Which BRDF all surfaces have.
enum class BrdfChoice : std::uint32_t {
    material, ///< that of the scene file
    lambert,  ///< diffuse albedo / pi
};

/// What images can show beside the radiance of their pixels; see make_frame().
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

/// One of several shares of the tiles of an image, for work on several machines.
struct Part {
    int number = 1; ///< 1 to count
    int count = 1;  ///< 1 to kMaxParts
    bool operator==(const Part&) const = default;
};

/// What is sampled of polygonal lights. Linear lights always get points.
enum class Integrator : std::uint32_t {
    points,
    lines, ///< whole segments, with exact visibility
};

/// Directions of line samples in the plane of their light.
enum class LineOrientation : std::uint32_t {
    parallel,    ///< random, the same for all lines of a shading point and light
    fixed,       ///< along the longest edge of the light
    independent, ///< random for each line
};

/// Density of the offsets of line samples.
enum class LineOffsets : std::uint32_t {
    length, ///< in proportion to the length of the line on the light
    uniform,
    reflected, ///< in proportion to what the surface would reflect of the line without shadows
};

/// How the visible parts of a line sample are shaded.
enum class LineShading : std::uint32_t {
    unbiased, ///< the integral of a fitted lobe, and one point for what the BRDF is beyond that
    analytic, ///< the integral of the fitted lobe alone
};

/// What shading points take of lights with many occluders in between.
enum class ManyOccluders : std::uint32_t {
    points, ///< point samples, where these are cheaper
    lines,  ///< line samples, as everywhere
};

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
    Integrator integrator = Integrator::points;
    LineSettings lines; ///< for Integrator::lines
    Technique technique = Technique::projected_solid_angle;
    Strategies strategies = Strategies::diffuse;
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

/// Whether linearly transformed cosines are needed.
bool uses_lobes(const RenderSettings& settings);

/// Camera rays per pixel: as given, else one for each sample if their positions differ, else one.
int camera_ray_count(const RenderSettings& settings);

/// Whether the noise of pixels is known: it is estimated from the differences between camera rays.
bool has_variance(const RenderSettings& settings);

/// \throws std::invalid_argument naming the first setting out of range, its value and the range
void validate(const RenderSettings& settings);

// All values in the order in which they are listed to users, and their names.
inline constexpr std::array kTechniques = {Technique::area,
                                           Technique::solid_angle,
                                           Technique::clipped_solid_angle,
                                           Technique::projected_solid_angle,
                                           Technique::projected_solid_angle_biased,
                                           Technique::ltc_analytic};
inline constexpr std::array kStrategies = {Strategies::diffuse, Strategies::diffuse_ltc,
                                           Strategies::diffuse_ggx, Strategies::diffuse_ggx_bounded};
inline constexpr std::array kMisHeuristics = {Mis::balance,         Mis::power,   Mis::weighted_balance,
                                              Mis::clamped_optimal, Mis::optimal, Mis::one_sample,
                                              Mis::separate};
inline constexpr std::array kSampleOrders = {SampleOrder::independent, SampleOrder::sobol,
                                             SampleOrder::jittered, SampleOrder::stratified};
inline constexpr std::array kPixelPositions = {PixelPosition::jittered, PixelPosition::center};
inline constexpr std::array kBrdfChoices = {BrdfChoice::material, BrdfChoice::lambert};
inline constexpr std::array kLayerKinds = {LayerKind::albedo,   LayerKind::normal,  LayerKind::depth,
                                           LayerKind::emission, LayerKind::diffuse, LayerKind::specular,
                                           LayerKind::lights,   LayerKind::pieces,  LayerKind::variance};
inline constexpr std::array kIntegrators = {Integrator::points, Integrator::lines};
inline constexpr std::array kLineOrientations = {LineOrientation::parallel, LineOrientation::fixed,
                                                 LineOrientation::independent};
inline constexpr std::array kLineOffsets = {LineOffsets::length, LineOffsets::uniform,
                                            LineOffsets::reflected};
inline constexpr std::array kLineShadings = {LineShading::unbiased, LineShading::analytic};
inline constexpr std::array kManyOccludersChoices = {ManyOccluders::points, ManyOccluders::lines};
std::string_view name_of(Technique technique);
std::string_view name_of(Strategies strategies);
std::string_view name_of(Mis mis);
std::string_view name_of(SampleOrder order);
std::string_view name_of(PixelPosition position);
std::string_view name_of(BrdfChoice brdf);
std::string_view name_of(LayerKind kind);
std::string_view name_of(Integrator integrator);
std::string_view name_of(LineOrientation orientation);
std::string_view name_of(LineOffsets offsets);
std::string_view name_of(LineShading shading);
std::string_view name_of(ManyOccluders choice);

} // namespace nusselt::render
