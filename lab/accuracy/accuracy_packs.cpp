/// Compiled once per instruction set; see accuracy_packs.h.

#include <cstring>

#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>
#include <nusselt/simd/pack.h>

#include "lab/accuracy/accuracy_packs.h"

NUSSELT_NAMESPACE_BEGIN
namespace accuracy {

using Native = Pack<float, kNativeLanes<float>>;

/// What a technique takes: the light, and random numbers read from the columns.
template <int N>
struct PolygonInput {
    static constexpr int kVertexBound = N;
    using Light = ConvexPolygon<Native, N>;
    static Vec2<Native> random(const lab::LightColumns& in, int i) {
        return {Native::load(in.u[0] + i), Native::load(in.u[1] + i)};
    }
};
struct LineInput {
    static constexpr int kVertexBound = 2;
    using Light = LineSegment<Native>;
    static Native random(const lab::LightColumns& in, int i) { return Native::load(in.u[0] + i); }
};

template <class Technique, class Input>
void run(const lab::LightColumns& in, lab::SampleColumns& out) {
    using Light = typename Input::Light;
    constexpr int kComponents = sizeof(Light) / sizeof(Native);
    static_assert(kComponents <= lab::LightColumns::kLargest);
    for (int i = 0; i < lab::kPackedLights; i += RealTraits<Native>::kLanes) {
        Native components[kComponents];
        for (int k = 0; k < kComponents; ++k) components[k] = Native::load(in.light[k] + i);
        Light light;
        std::memcpy(&light, components, sizeof light);
        const Technique technique(light);
        const LightSample<Native> s = technique.sample(Input::random(in, i));
        s.wi.x.store(out.wi[0] + i);
        s.wi.y.store(out.wi[1] + i);
        s.wi.z.store(out.wi[2] + i);
        s.pdf.store(out.pdf + i);
        technique.measure().store(out.measure + i);
    }
}

template <class Technique, class Input>
constexpr lab::PackedTechnique packed(const char* name) {
    return {name, Input::kVertexBound, run<Technique, Input>};
}

inline constexpr lab::PackedTechnique kTechniques[] = {
    packed<PolygonArea<Native, 4>, PolygonInput<4>>("PolygonArea"),
    packed<PolygonArea<Native, 8>, PolygonInput<8>>("PolygonArea"),
    packed<PolygonSolidAngle<Native, 4>, PolygonInput<4>>("PolygonSolidAngle"),
    packed<PolygonSolidAngle<Native, 8>, PolygonInput<8>>("PolygonSolidAngle"),
    packed<PolygonClippedSolidAngle<Native, 4>, PolygonInput<4>>("PolygonClippedSolidAngle"),
    packed<PolygonClippedSolidAngle<Native, 8>, PolygonInput<8>>("PolygonClippedSolidAngle"),
    packed<PolygonProjectedSolidAngle<Native, 4>, PolygonInput<4>>("PolygonProjectedSolidAngle"),
    packed<PolygonProjectedSolidAngle<Native, 8>, PolygonInput<8>>("PolygonProjectedSolidAngle"),
    packed<PolygonProjectedSolidAngleBiased<Native, 4>, PolygonInput<4>>("PolygonProjectedSolidAngleBiased"),
    packed<PolygonProjectedSolidAngleBiased<Native, 8>, PolygonInput<8>>("PolygonProjectedSolidAngleBiased"),
    packed<LineArea<Native>, LineInput>("LineArea"),
    packed<LineSolidAngle<Native>, LineInput>("LineSolidAngle"),
    packed<LineClippedSolidAngle<Native>, LineInput>("LineClippedSolidAngle"),
    packed<LineProjectedSolidAngle<Native>, LineInput>("LineProjectedSolidAngle"),
};

} // namespace accuracy
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

template <>
PackedTechniques packed_techniques<base::Isa::NUSSELT_UNIT_ISA>() {
    return {accuracy::kTechniques, sizeof(accuracy::kTechniques) / sizeof(accuracy::kTechniques[0])};
}

} // namespace nusselt::lab
