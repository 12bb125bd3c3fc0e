/// Compiled once per instruction set; see emission_timing_kernel.h.

#include "lab/emission/emission_timing_kernel.h"

#include <nusselt/emission/environment_sampling.h>
#include <nusselt/emission/textured_polygon.h>
#include <nusselt/emission/windowed_polygon.h>

NUSSELT_NAMESPACE_BEGIN
namespace emission_timing {

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

// How each technique is made for a shading point, or for a pack of them.

using Packed = Pack<float, kNativeLanes<float>>;

template <class Number>
struct Uniform {
    using Real = Number;
    static PolygonProjectedSolidAngle<Real, 4> make(const EmissionViews& views, int i) {
        return PolygonProjectedSolidAngle<Real, 4>(
            rectangle_in<Real>(plane_of<Real>(views, i), {Real(0), Real(0)}, {Real(1), Real(1)}));
    }
};
template <class Number, class Texture, int n, class Descent = DescentByRadiance>
struct Textured {
    using Real = Number;
    static TexturedPolygon<Real, n, Descent> make(const EmissionViews& views, int i) {
        return {plane_of<Real>(views, i), textured_light<Texture, n>()};
    }
};
template <class Number, class Texture, int n>
struct TexturedLobe {
    using Real = Number;
    static TexturedPolygonLtc<Real, n> make(const EmissionViews& views, int i) {
        return {plane_of<Real>(views, i), textured_light<Texture, n>(), {lobe<Real>()}};
    }
};
template <class Number, int n>
struct Environment {
    using Real = Number;
    static EnvironmentCosine<Real, n> make(const EmissionViews& views, int i) {
        return {environment<n>(), frame_of<Real>(views, i)};
    }
};
template <class Number, int n>
struct EnvironmentLobe {
    using Real = Number;
    static EnvironmentLtc<Real, n> make(const EmissionViews& views, int i) {
        return {environment<n>(), frame_of<Real>(views, i), {lobe<Real>()}};
    }
};
template <int n>
struct Portal {
    using Real = float;
    static WindowedPolygon<float, n> make(const EmissionViews& views, int i) {
        return {
            to_shading_space(portal().plane, vector_of<float>(views.position, i), frame_of<float>(views, i)),
            portal()};
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
            const auto s = technique.sample(random_of<typename Maker::Real>(views, i, k));
            sum += s.pdf + s.wi.z;
        }
    }
    return sum_of(sum);
}

template <class Maker>
float ask_density(const EmissionViews& views) {
    using Real = typename Maker::Real;
    Real sum = 0;
    for (int i = 0; i < kEmissionViews; i += kStep<Maker>) {
        const TexturePlane<Real> plane = plane_of<Real>(views, i);
        sum += Maker::make(views, i).pdf(normalize(plane.point_at(random_of<Real>(views, i, 0))));
    }
    return sum_of(sum);
}

template <class Maker>
constexpr EmissionTechnique row(const char* name) {
    return {name, &prepare<Maker>, &sample<Maker, 1>, &sample<Maker, kEmissionSamples>, &ask_density<Maker>};
}

inline constexpr EmissionTechnique kTechniques[] = {
    row<Uniform<float>>("projected solid angle"),
    row<Textured<float, Busy, 16>>("texture, 16 x 16, busy"),
    row<Textured<float, Smooth, 16>>("texture, 16 x 16, smooth"),
    row<Textured<float, Busy, 8>>("texture, 8 x 8, busy"),
    row<Textured<float, Busy, 8, DescentByProduct>>("texture, 8 x 8, busy, product"),
    row<Textured<float, Smooth, 8>>("texture, 8 x 8, smooth"),
    row<TexturedLobe<float, Busy, 8>>("texture, 8 x 8, busy, lobe"),
    row<Uniform<Packed>>("packs: projected solid angle"),
    row<Textured<Packed, Busy, 16>>("packs: texture, 16 x 16, busy"),
    row<Textured<Packed, Busy, 8>>("packs: texture, 8 x 8, busy"),
    row<Textured<Packed, Busy, 8, DescentByProduct>>("packs: texture, 8 x 8, busy, product"),
    row<Textured<Packed, Smooth, 8>>("packs: texture, 8 x 8, smooth"),
    row<TexturedLobe<Packed, Busy, 8>>("packs: texture, 8 x 8, busy, lobe"),
    row<Environment<float, 16>>("environment, 16 x 16"),
    row<Environment<float, 8>>("environment, 8 x 8"),
    row<EnvironmentLobe<float, 8>>("environment, 8 x 8, lobe"),
    row<Environment<Packed, 16>>("packs: environment, 16 x 16"),
    row<Environment<Packed, 8>>("packs: environment, 8 x 8"),
    row<EnvironmentLobe<Packed, 8>>("packs: environment, 8 x 8, lobe"),
    row<Portal<8>>("portal, 8 x 8"),
    row<Portal<4>>("portal, 4 x 4"),
};

} // namespace emission_timing
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

template <>
EmissionTechniques emission_techniques<base::Isa::NUSSELT_UNIT_ISA>() {
    using emission_timing::kTechniques;
    return {kTechniques, static_cast<int>(sizeof kTechniques / sizeof kTechniques[0])};
}

} // namespace nusselt::lab
