// The code in README.md and in the second half of docs/porting.md, as functions. The tests compile this file and compare
// what the functions return with closed forms.

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <nusselt/simd/pack.h>

#include <nusselt/nusselt.h>
using namespace nusselt;

namespace {

using Vec = Vec3<float>;

/// The BRDF of a Lambertian surface and its cosine-weighted sampling; in shading space.
constexpr float kAlbedo = 0.5f;
float brdf(const Vec&, const Vec&) { return kAlbedo / kPi<float>; }
constexpr Vec kColouredAlbedo{0.5f, 0.25f, 0.125f};
Vec coloured_brdf(const Vec&, const Vec&) { return kColouredAlbedo / kPi<float>; }
float brdf_pdf(const Vec&, const Vec& wi) { return wi.z > 0 ? wi.z / kPi<float> : 0.0f; }
Vec sample_brdf(const Vec&, const Vec2<float>& u) {
    const float radius = std::sqrt(u.x);
    const float azimuth = 2 * kPi<float> * u.y;
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1 - u.x)};
}

/// There is nothing but the light.
bool visible(const Vec&, const Vec&) { return true; }

/// Whether a direction hits a polygon; in shading space.
bool hits(const ConvexPolygon<float, 4>& light, const Vec& wi) {
    const float side = plane_distance(light) < 0 ? -1.0f : 1.0f;
    bool inside = side * dot(light.normal, wi) > 0;
    for (int j = 0; j < 4; ++j) inside = inside && side * dot(cross(light.vertex[j], light.edge[j]), wi) >= 0;
    return inside;
}

/// \tparam Colour a number or a vector.
template <class Colour, class Brdf>
Colour direct_light(const Vec* corners, const Vec& point, const Vec& normal, const Colour& emitted,
                    const Brdf& brdf, float u0, float u1) {
    const Vec wo{0, 0, 1};
    Colour radiance{};
    const auto light = make_polygon<4>(corners, 4);       // once per light
    const auto frame = Frame<float>::from_normal(normal); // at each shading point
    const PolygonProjectedSolidAngle<float, 4> technique(to_shading_space(light, point, frame));
    const auto s = technique.sample({u0, u1});
    if (s.pdf > 0 && visible(point, point + frame.to_world(s.p)))
        radiance += emitted * brdf(wo, s.wi) * s.wi.z / s.pdf;
    return radiance;
}

/// \param panel in world space.
float direct_light_mis(const ConvexPolygon<float, 4>& panel, const Vec& point, const Vec& normal,
                       float emitted, const Vec2<float>& u, const Vec2<float>& v) {
    const auto frame = Frame<float>::from_normal(normal);
    const auto light = to_shading_space(panel, point, frame);
    const Vec wo{0, 0, 1};
    float radiance = 0;
    const PolygonSolidAngle<float, 4> technique(light);
    const auto s = technique.sample(u);
    if (s.pdf > 0 && s.wi.z > 0 && visible(point, point + frame.to_world(s.p)))
        radiance += emitted * brdf(wo, s.wi) * s.wi.z / (s.pdf + brdf_pdf(wo, s.wi));

    const Vec wi = sample_brdf(wo, v);
    const float pdf = brdf_pdf(wo, wi);
    if (pdf > 0 && hits(light, wi)) radiance += emitted * brdf(wo, wi) * wi.z / (pdf + technique.pdf(wi));
    return radiance;
}

/// A table of lobes in memory.
struct Lobes {
    std::vector<float> entries;
    LtcTableView view;
};

/// \param bytes of data/ltc-frostbite.bin
Lobes load_lobes(const std::string& bytes) {
    const LtcTableFile file = open_ltc_table(bytes.data(), bytes.size());
    if (file.problem != nullptr) throw std::runtime_error(file.problem);
    std::vector<float> entries(file.entries());
    file.decode(entries.data());
    const LtcTableView table{entries.data(), file.roughnesses, file.inclinations, file.f0s};
    return {std::move(entries), table};
}

/// Reflected by a glossy surface at the origin. \param light in world space.
float glossy_direct_light(const ConvexPolygon<float, 4>& light, const SurfacePoint<float>& point,
                          const LtcTableView& table, float emitted, const Vec2<float> (&u)[2]) {
    float radiance = 0;
    const ClampedOptimalHeuristic<float> heuristic{0.5f};
    const auto two = sample_direct_light(point, light, table, heuristic, u);
    for (const auto& s : two.sample) {
        const bool lit =
            s.shadowed.x > 0 && visible(point.position, point.position + s.distance * s.direction);
        radiance += emitted * ((lit ? s.shadowed.x : 0) + s.constant.x);
    }
    return radiance;
}

/// Reflected by the lobe of a glossy surface alone. \param panel, wo in world space.
float light_in_lobe(const ConvexPolygon<float, 4>& panel, const Vec& point, const Vec& normal, const Vec& wo,
                    float roughness, float f0, const LtcTableView& table, float emitted,
                    const Vec2<float>& u) {
    float radiance = 0;
    const auto coefficients = table.lookup(roughness, dot(normal, wo), f0);
    const Ltc<float> lobe(coefficients);
    const auto frame = shading_frame(normal, wo); // not from_normal(): lobes point away from the eye
    const PolygonLtc<float, 4> technique(to_shading_space(panel, point, frame), lobe);
    const auto s = technique.sample(u);
    if (s.pdf > 0 && s.wi.z > 0 && visible(point, point + frame.to_world(s.p)))
        radiance += emitted * coefficients.albedo * lobe.density(s.wi) / s.pdf;
    return radiance;
}

/// Mean of wi.z / pdf over eight samples of one light.
float mean_of_samples(const ConvexPolygon<float, 4>& light, const float* u0, const float* u1) {
    using Real = Pack<float, 8>;
    const PolygonProjectedSolidAngle<float, 4> single(light);
    const PolygonProjectedSolidAngle<Real, 4> technique(single);
    const auto s = technique.sample({Real::load(u0), Real::load(u1)});
    const auto lit = s.pdf > Real(0);
    const Real weight = select(lit, s.wi.z / select(lit, s.pdf, Real(1)), Real(0));

    float sum = 0;
    for (int i = 0; i < 8; ++i) sum += weight.lane(i);
    return sum / 8;
}

/// Projected solid angles of one light at eight shading points.
void projected_solid_angles(const ConvexPolygon<float, 4>& light, const Vec3<Pack<float, 8>>& points,
                            const Frame<Pack<float, 8>>& frames, float* result) {
    using Real = Pack<float, 8>;
    const PolygonProjectedSolidAngle<Real, 4> technique(to_shading_space(light, points, frames));
    technique.measure().store(result);
}

/// What a triangle hides of a line.
Interval<float> hidden_by(const std::array<Vec, 3>& triangle, const ShadowFrame<float>& frame, float offset) {
    const auto [a, b, c] = triangle;
    const auto shadows = make_triangle_shadow(frame, a, b, c);
    return shadows.partial ? hidden_interval(make_partial_shadow(frame, a, b, c), offset)
                           : hidden_interval(shadows.shadow, offset);
}

/// \param light, triangles in world space. \param u random, stratified.
float light_of_lines(const ConvexPolygon<float, 4>& light, std::vector<std::array<Vec, 3>> triangles,
                     const Vec& point, const Vec& normal, float emitted, const std::vector<float>& u) {
    // Neighbours in a mesh have their edge in common, bit by bit.
    for (auto& triangle : triangles)
        std::sort(triangle.begin(), triangle.end(), [](const Vec& a, const Vec& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
    float radiance = 0;
    const auto frame = Frame<float>::from_normal(normal);
    const float angle = 0.7f;
    const LineFamily<float, 4> family(light, angle);
    const auto plane = to_shading_space(family.plane(), point, frame);
    const LobePlane<float, BothSides> lines({plane, family.reach()});
    const auto shadow_frame = make_shadow_frame(family.plane(), point);
    for (const float random : u) {
        const auto line = family.sample_by_length(random);
        if (!(line.pdf > 0)) continue;
        const auto chord = family.chord(line.offset);
        Interval<float> memory[64];
        VisibleParts<float> parts(memory, 64);
        parts.reset(chord.extent);
        for (const auto& triangle : triangles) parts.cut(hidden_by(triangle, shadow_frame, line.offset));
        const auto seen = lines.line(line.offset);
        for (int k = 0; k < parts.count(); ++k)
            radiance += emitted * kAlbedo * diffuse_part(seen, parts[k]) / line.pdf;
    }
    return radiance / static_cast<float>(u.size());
}

/// Runs on the host and on the device.
NUSSELT_HD float irradiance(const LineSegment<float>& tube, float radiance_times_radius,
                            const Vec3<float>& point, const Vec3<float>& normal) {
    const auto frame = Frame<float>::from_normal(normal);
    const LineProjectedSolidAngle<float> technique(to_shading_space(tube, point, frame));
    return radiance_times_radius * technique.measure();
}

} // namespace
