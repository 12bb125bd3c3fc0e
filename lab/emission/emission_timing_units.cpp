/// Compiled once per instruction set; see emission_timing_kernel.h.

#include "lab/emission/emission_timing_kernel.h"

#include <nusselt/emission/environment_sampling.h>
#include <nusselt/emission/textured_polygon.h>
#include <nusselt/emission/windowed_polygon.h>
#include <nusselt/line_emission/textured_line.h>
#include <nusselt/line_emission/textured_tube.h>

NUSSELT_NAMESPACE_BEGIN
namespace emission_timing {

using lab::EmissionGroup;
using lab::EmissionTechnique;
using lab::EmissionViews;
using lab::kEmissionSamples;
using lab::kEmissionViews;

/// Of shading point i, or of as many as a pack has lanes from there on.
template <class Real>
Vec3<Real> vector_of(const float (&vectors)[kEmissionViews][3], int i) {
    constexpr int kLanes = RealTraits<Real>::kLanes;
    if constexpr (kLanes == 1) {
        return {vectors[i][0], vectors[i][1], vectors[i][2]};
    } else {
        float lanes[3][kLanes];
        for (int axis = 0; axis < 3; ++axis)
            for (int k = 0; k < kLanes; ++k) lanes[axis][k] = vectors[i + k][axis];
        return {Real::load(lanes[0]), Real::load(lanes[1]), Real::load(lanes[2])};
    }
}
template <class Real>
Frame<Real> frame_of(const EmissionViews& views, int i) {
    return {vector_of<Real>(views.tangent, i), vector_of<Real>(views.bitangent, i),
            vector_of<Real>(views.normal, i)};
}
template <class Real>
TexturePlane<Real> plane_of(const EmissionViews& views, int i) {
    const Real zero = Real(0), one = Real(1);
    const TexturePlane<Real> square{
        {zero, zero, zero}, {one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
    return to_shading_space(square, vector_of<Real>(views.position, i), frame_of<Real>(views, i));
}
/// Random numbers of sample k.
template <class Real>
Vec2<Real> random_of(const EmissionViews& views, int i, int k) {
    constexpr int kLanes = RealTraits<Real>::kLanes;
    if constexpr (kLanes == 1) {
        return {views.u[i][k][0], views.u[i][k][1]};
    } else {
        float lanes[2][kLanes];
        for (int lane = 0; lane < kLanes; ++lane) {
            lanes[0][lane] = views.u[i + lane][k][0];
            lanes[1][lane] = views.u[i + lane][k][1];
        }
        return {Real::load(lanes[0]), Real::load(lanes[1])};
    }
}
inline float sum_of(float x) { return x; }
template <int n>
float sum_of(const Pack<float, n>& x) {
    float lanes[n];
    x.store(lanes);
    float sum = 0;
    for (const float value : lanes) sum += value;
    return sum;
}

/// A lobe of half width 0.3, tilted.
template <class Real>
Ltc<Real> lobe() {
    return Ltc<Real>(LtcCoefficients<Real>{Real(0.3f), Real(0.1f), Real(0.4f), Real(0), Real(1), Real(0)});
}

/// A value in [0, 1) for a block of texels.
inline float noise(int i, int j) {
    unsigned x = static_cast<unsigned>(i) * 73856093u ^ static_cast<unsigned>(j) * 19349663u;
    x = (x ^ (x >> 13)) * 0x5bd1e995u;
    return static_cast<float>((x ^ (x >> 15)) >> 8) * (1.0f / 16777216.0f);
}
inline Vec3<float> grey(float x) { return {x, x, x}; }

// Blocks of all sizes in which cells are busy, and a slope on which they are smooth.
struct Busy {
    static Vec3<float> at(int i, int j) { return grey(noise(i / 8, j / 8) * noise(i / 3, j / 3)); }
};
struct Smooth {
    static Vec3<float> at(int i, int) { return grey(0.5f + static_cast<float>(i) / 512); }
};

template <class Texture, int n>
const TexturedLight<float, n>& textured_light() {
    constexpr int kSize = 256;
    static Vec3<float> texels[kSize * kSize];
    static float storage[2 * kSize * kSize];
    static const TexturedLight<float, n> light = [] {
        for (int k = 0; k < kSize * kSize; ++k) texels[k] = Texture::at(k % kSize, k / kSize);
        return make_textured_rectangle<BilinearFilter, n>(TextureView<float>{texels, kSize, kSize}, storage);
    }();
    return light;
}

/// A sky with a sun.
inline Vec3<float> sky_at(const Vec3<float>& w) {
    const float sun = w.x * 0.6f + w.y * 0.48f + w.z * 0.64f > 0.9998f ? 3000.0f : 0.0f;
    return grey(0.3f + 0.7f * max(w.z, 0.0f) + sun);
}

template <int n>
const EnvironmentMap<float, n>& environment() {
    constexpr int kSize = 256;
    static Vec3<float> texels[kSize * kSize];
    static float storage[3 * kSize * kSize];
    static const EnvironmentMap<float, n> map = [] {
        for (int k = 0; k < kSize * kSize; ++k)
            texels[k] =
                sky_at(octahedral_direction(Vec2<float>{(static_cast<float>(k % kSize) + 0.5f) / kSize,
                                                        (static_cast<float>(k / kSize) + 0.5f) / kSize}));
        return make_environment_map<n>(OctahedralMap<float>{texels, kSize}, storage);
    }();
    return map;
}

inline const WindowedLight<float>& portal() {
    constexpr int kSize = 512;
    static RectifiedSums sums[(kSize + 1) * (kSize + 1)];
    static Vec3<float> colour[(kSize + 1) * (kSize + 1)];
    static const RectifiedTable<float> table = make_rectified_table<float>(
        sky_at, RectifiedDomain<float>::hemisphere(), kSize, kSize, 1, sums, colour);
    static const Vec3<float> corners[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    // Points are in front of the square. Rays leave through it downwards.
    static const Frame<float> frame{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    static const WindowedLight<float> light = make_portal(frame, corners, 4, table);
    return light;
}

/// Radiance along a line.
template <class Texture, int n>
const LineProfile<float>& line_profile() {
    static const LineProfile<float> profile = [] {
        Vec3<float> texels[n];
        for (int k = 0; k < n; ++k) texels[k] = Texture::at(k * (256 / n), 0);
        return make_line_profile(texels, n);
    }();
    return profile;
}

// How each technique is made for a shading point, or for a pack of them; a direction to its light; its random numbers.

using Packed = Pack<float, kNativeLanes<float>>;

template <class Number>
struct OnSquare {
    using Real = Number;
    static Vec3<Real> to_light(const EmissionViews& views, int i) {
        return plane_of<Real>(views, i).point_at(random_of<Real>(views, i, 0));
    }
    static Vec2<Real> random(const EmissionViews& views, int i, int k) {
        return random_of<Real>(views, i, k);
    }
};
template <class Number>
struct Uniform : OnSquare<Number> {
    static PolygonProjectedSolidAngle<Number, 4> make(const EmissionViews& views, int i) {
        return PolygonProjectedSolidAngle<Number, 4>(
            rectangle_in<Number>(plane_of<Number>(views, i), {Number(0), Number(0)}, {Number(1), Number(1)}));
    }
};
template <class Number, class Texture, int n, class Descent = DescentByRadiance>
struct Textured : OnSquare<Number> {
    static TexturedPolygon<Number, n, Descent> make(const EmissionViews& views, int i) {
        return {plane_of<Number>(views, i), textured_light<Texture, n>()};
    }
};
template <class Number, class Texture, int n>
struct TexturedLobe : OnSquare<Number> {
    static TexturedPolygonLtc<Number, n> make(const EmissionViews& views, int i) {
        return {plane_of<Number>(views, i), textured_light<Texture, n>(), {lobe<Number>()}};
    }
};
template <class Number, int n>
struct Environment : OnSquare<Number> {
    static EnvironmentCosine<Number, n> make(const EmissionViews& views, int i) {
        return {environment<n>(), frame_of<Number>(views, i)};
    }
};
template <class Number, int n>
struct EnvironmentLobe : OnSquare<Number> {
    static EnvironmentLtc<Number, n> make(const EmissionViews& views, int i) {
        return {environment<n>(), frame_of<Number>(views, i), {lobe<Number>()}};
    }
};
template <int n>
struct Portal : OnSquare<float> {
    static WindowedPolygon<float, n> make(const EmissionViews& views, int i) {
        return {
            to_shading_space(portal().plane, vector_of<float>(views.position, i), frame_of<float>(views, i)),
            portal()};
    }
};

/// The line in the middle of the square.
template <class Real>
LineSegment<Real> line_of(const EmissionViews& views, int i) {
    const LineSegment<float> line{{0, 0.5f, 0}, {1, 0, 0}, 1};
    return to_shading_space(line, vector_of<Real>(views.position, i), frame_of<Real>(views, i));
}
template <class Number>
struct OnLine {
    using Real = Number;
    static Vec3<Real> to_light(const EmissionViews& views, int i) {
        const LineSegment<Real> line = line_of<Real>(views, i);
        return fma(random(views, i, 0) * line.length, line.s, line.p0);
    }
    static Real random(const EmissionViews& views, int i, int k) { return random_of<Real>(views, i, k).x; }
};
template <class Number>
struct UniformLine : OnLine<Number> {
    static LineProjectedSolidAngle<Number> make(const EmissionViews& views, int i) {
        return LineProjectedSolidAngle<Number>(line_of<Number>(views, i));
    }
};
template <class Number, int n>
struct TexturedLines : OnLine<Number> {
    static TexturedLine<Number> make(const EmissionViews& views, int i) {
        return {line_of<Number>(views, i), line_profile<Busy, n>()};
    }
};
template <class Number, int n>
struct TexturedLineLobe : OnLine<Number> {
    static TexturedLineLtc<Number> make(const EmissionViews& views, int i) {
        return {line_of<Number>(views, i), line_profile<Busy, n>(), {lobe<Number>()}};
    }
};

template <class Real>
Cylinder<Real> tube_of(const EmissionViews& views, int i) {
    return {line_of<Real>(views, i), Real(0.02f)};
}
template <class Number>
struct OnTube {
    using Real = Number;
    static Vec3<Real> to_light(const EmissionViews& views, int i) { return OnLine<Real>::to_light(views, i); }
    static Vec2<Real> random(const EmissionViews& views, int i, int k) {
        return random_of<Real>(views, i, k);
    }
};
template <class Number>
struct UniformTube : OnTube<Number> {
    static CylinderProjectedSolidAngle<Number> make(const EmissionViews& views, int i) {
        return CylinderProjectedSolidAngle<Number>(tube_of<Number>(views, i));
    }
};
template <class Number>
struct UniformTubeLobe : OnTube<Number> {
    static CylinderLtc<Number> make(const EmissionViews& views, int i) {
        return CylinderLtc<Number>(tube_of<Number>(views, i), lobe<Number>());
    }
};
template <class Uniform, int n>
struct TexturedTubes : OnTube<typename Uniform::Real> {
    using Real = typename Uniform::Real;
    static auto make(const EmissionViews& views, int i) {
        const auto uniform = Uniform::make(views, i);
        return TexturedTube<Real, std::remove_const_t<decltype(uniform)>>(uniform, tube_of<Real>(views, i),
                                                                          line_profile<Busy, n>());
    }
};

template <class Maker>
inline constexpr int kStep = RealTraits<typename Maker::Real>::kLanes;

template <class Maker>
float prepare(const EmissionViews& views) {
    typename Maker::Real sum = 0;
    for (int i = 0; i < kEmissionViews; i += kStep<Maker>) sum += Maker::make(views, i).measure();
    return sum_of(sum);
}

template <class Maker, int count>
float sample(const EmissionViews& views) {
    typename Maker::Real sum = 0;
    for (int i = 0; i < kEmissionViews; i += kStep<Maker>) {
        const auto technique = Maker::make(views, i);
        for (int k = 0; k < count; ++k) {
            const auto s = technique.sample(Maker::random(views, i, k));
            sum += s.pdf + s.wi.z;
        }
    }
    return sum_of(sum);
}

template <class Maker>
float ask_density(const EmissionViews& views) {
    typename Maker::Real sum = 0;
    for (int i = 0; i < kEmissionViews; i += kStep<Maker>)
        sum += Maker::make(views, i).pdf(normalize(Maker::to_light(views, i)));
    return sum_of(sum);
}

template <class Maker>
constexpr EmissionTechnique row(const char* name) {
    return {name, &prepare<Maker>, &sample<Maker, 1>, &sample<Maker, kEmissionSamples>, &ask_density<Maker>};
}

inline constexpr EmissionTechnique kPolygons[] = {
    row<Uniform<float>>("projected solid angle"),
    row<Textured<float, Busy, 16>>("texture, 16 x 16, busy"),
    row<Textured<float, Smooth, 16>>("texture, 16 x 16, smooth"),
    row<Textured<float, Busy, 8>>("texture, 8 x 8, busy"),
    row<Textured<float, Busy, 8, DescentByProduct>>("texture, 8 x 8, busy, product"),
    row<Textured<float, Smooth, 8>>("texture, 8 x 8, smooth"),
    row<TexturedLobe<float, Busy, 8>>("texture, 8 x 8, busy, lobe"),
    row<Environment<float, 16>>("environment, 16 x 16"),
    row<Environment<float, 8>>("environment, 8 x 8"),
    row<EnvironmentLobe<float, 8>>("environment, 8 x 8, lobe"),
    row<Portal<8>>("portal, 8 x 8"),
    row<Portal<4>>("portal, 4 x 4"),
};
inline constexpr EmissionTechnique kPolygonPacks[] = {
    row<Uniform<Packed>>("packs: projected solid angle"),
    row<Textured<Packed, Busy, 16>>("packs: texture, 16 x 16, busy"),
    row<Textured<Packed, Busy, 8>>("packs: texture, 8 x 8, busy"),
    row<Textured<Packed, Busy, 8, DescentByProduct>>("packs: texture, 8 x 8, busy, product"),
    row<Textured<Packed, Smooth, 8>>("packs: texture, 8 x 8, smooth"),
    row<TexturedLobe<Packed, Busy, 8>>("packs: texture, 8 x 8, busy, lobe"),
    row<Environment<Packed, 16>>("packs: environment, 16 x 16"),
    row<Environment<Packed, 8>>("packs: environment, 8 x 8"),
    row<EnvironmentLobe<Packed, 8>>("packs: environment, 8 x 8, lobe"),
};
inline constexpr EmissionTechnique kLines[] = {
    row<UniformLine<float>>("line: projected solid angle"),
    row<TexturedLines<float, 4>>("line: 4 texels"),
    row<TexturedLines<float, 64>>("line: 64 texels"),
    row<TexturedLineLobe<float, 4>>("line: 4 texels, lobe"),
    row<TexturedLineLobe<float, 64>>("line: 64 texels, lobe"),
};
inline constexpr EmissionTechnique kLinePacks[] = {
    row<UniformLine<Packed>>("packs: line: projected solid angle"),
    row<TexturedLines<Packed, 4>>("packs: line: 4 texels"),
    row<TexturedLines<Packed, 64>>("packs: line: 64 texels"),
    row<TexturedLineLobe<Packed, 4>>("packs: line: 4 texels, lobe"),
    row<TexturedLineLobe<Packed, 64>>("packs: line: 64 texels, lobe"),
};
inline constexpr EmissionTechnique kTubes[] = {
    row<UniformTube<float>>("tube: projected solid angle"),
    row<TexturedTubes<UniformTube<float>, 64>>("tube: 64 texels"),
    row<UniformTubeLobe<float>>("tube: lobe"),
    row<TexturedTubes<UniformTubeLobe<float>, 64>>("tube: 64 texels, lobe"),
};
inline constexpr EmissionTechnique kTubePacks[] = {
    row<UniformTube<Packed>>("packs: tube: projected solid angle"),
    row<TexturedTubes<UniformTube<Packed>, 64>>("packs: tube: 64 texels"),
    row<UniformTubeLobe<Packed>>("packs: tube: lobe"),
    row<TexturedTubes<UniformTubeLobe<Packed>, 64>>("packs: tube: 64 texels, lobe"),
};

template <int n>
constexpr EmissionGroup group(const EmissionTechnique (&rows)[n]) {
    return {rows, n};
}
inline constexpr EmissionGroup kGroups[] = {group(kPolygons),  group(kPolygonPacks), group(kLines),
                                            group(kLinePacks), group(kTubes),        group(kTubePacks)};

} // namespace emission_timing
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

template <>
EmissionGroups emission_groups<base::Isa::NUSSELT_UNIT_ISA>() {
    using emission_timing::kGroups;
    return {kGroups, static_cast<int>(sizeof kGroups / sizeof kGroups[0])};
}

} // namespace nusselt::lab
