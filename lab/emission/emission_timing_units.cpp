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

inline Vec3<float> vector_of(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
inline Frame<float> frame_of(const EmissionViews& views, int i) {
    return {vector_of(views.tangent[i]), vector_of(views.bitangent[i]), vector_of(views.normal[i])};
}
inline TexturePlane<float> plane_of(const EmissionViews& views, int i) {
    const TexturePlane<float> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return to_shading_space(square, vector_of(views.position[i]), frame_of(views, i));
}

/// A lobe of half width 0.3, tilted.
inline Ltc<float> lobe() { return Ltc<float>(LtcCoefficients<float>{0.3f, 0.1f, 0.4f, 0, 1, 0}); }

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

// How each technique is made for a shading point.

struct Uniform {
    static PolygonProjectedSolidAngle<float, 4> make(const EmissionViews& views, int i) {
        return PolygonProjectedSolidAngle<float, 4>(rectangle_in<float>(plane_of(views, i), {0, 0}, {1, 1}));
    }
};
template <class Texture, int n, class Descent = DescentByRadiance>
struct Textured {
    static TexturedPolygon<float, n, Descent> make(const EmissionViews& views, int i) {
        return {plane_of(views, i), textured_light<Texture, n>()};
    }
};
template <class Texture, int n>
struct TexturedLobe {
    static TexturedPolygonLtc<float, n> make(const EmissionViews& views, int i) {
        return {plane_of(views, i), textured_light<Texture, n>(), {lobe()}};
    }
};
template <int n>
struct Environment {
    static EnvironmentCosine<float, n> make(const EmissionViews& views, int i) {
        return {environment<n>(), frame_of(views, i)};
    }
};
template <int n>
struct EnvironmentLobe {
    static EnvironmentLtc<float, n> make(const EmissionViews& views, int i) {
        return {environment<n>(), frame_of(views, i), {lobe()}};
    }
};
template <int n>
struct Portal {
    static WindowedPolygon<float, n> make(const EmissionViews& views, int i) {
        return {to_shading_space(portal().plane, vector_of(views.position[i]), frame_of(views, i)), portal()};
    }
};

template <class Maker>
float prepare(const EmissionViews& views) {
    float sum = 0;
    for (int i = 0; i < kEmissionViews; ++i) sum += Maker::make(views, i).measure();
    return sum;
}

template <class Maker, int count>
float sample(const EmissionViews& views) {
    float sum = 0;
    for (int i = 0; i < kEmissionViews; ++i) {
        const auto technique = Maker::make(views, i);
        for (int k = 0; k < count; ++k) {
            const auto s = technique.sample({views.u[i][k][0], views.u[i][k][1]});
            sum += s.pdf + s.wi.z;
        }
    }
    return sum;
}

template <class Maker>
float ask_density(const EmissionViews& views) {
    float sum = 0;
    for (int i = 0; i < kEmissionViews; ++i) {
        const TexturePlane<float> plane = plane_of(views, i);
        sum += Maker::make(views, i).pdf(normalize(plane.point_at({views.u[i][0][0], views.u[i][0][1]})));
    }
    return sum;
}

template <class Maker>
constexpr EmissionTechnique row(const char* name) {
    return {name, &prepare<Maker>, &sample<Maker, 1>, &sample<Maker, kEmissionSamples>, &ask_density<Maker>};
}

inline constexpr EmissionTechnique kTechniques[] = {
    row<Uniform>("projected solid angle"),
    row<Textured<Busy, 16>>("texture, 16 x 16, busy"),
    row<Textured<Smooth, 16>>("texture, 16 x 16, smooth"),
    row<Textured<Busy, 8>>("texture, 8 x 8, busy"),
    row<Textured<Busy, 8, DescentByProduct>>("texture, 8 x 8, busy, product"),
    row<Textured<Smooth, 8>>("texture, 8 x 8, smooth"),
    row<TexturedLobe<Busy, 8>>("texture, 8 x 8, busy, lobe"),
    row<Environment<16>>("environment, 16 x 16"),
    row<Environment<8>>("environment, 8 x 8"),
    row<EnvironmentLobe<8>>("environment, 8 x 8, lobe"),
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
