/// Compiled once per instruction set; see accuracy_packs.h.

#include <cstring>

#include <nusselt/simd/pack.h>

#include "lab/accuracy/accuracy_packs.h"
#include "proof/techniques/registry.h"

NUSSELT_NAMESPACE_BEGIN
namespace accuracy {

using Native = Pack<float, kNativeLanes<float>>;

template <class Kind>
void run(const lab::LightColumns& in, lab::SampleColumns& out) {
    using Light = typename Kind::template Light<Native>;
    constexpr int kComponents = sizeof(Light) / sizeof(Native);
    static_assert(kComponents <= lab::LightColumns::kLargest);
    for (int i = 0; i < lab::kPackedLights; i += RealTraits<Native>::kLanes) {
        Native components[kComponents];
        for (int k = 0; k < kComponents; ++k) components[k] = Native::load(in.light[k] + i);
        Light light;
        std::memcpy(&light, components, sizeof light);
        const typename Kind::template Technique<Native> technique(light);
        const LightSample<Native> s = [&] {
            if constexpr (hostile::kTakesPairs<Kind>)
                return technique.sample({Native::load(in.u[0] + i), Native::load(in.u[1] + i)});
            else
                return technique.sample(Native::load(in.u[0] + i));
        }();
        s.wi.x.store(out.wi[0] + i);
        s.wi.y.store(out.wi[1] + i);
        s.wi.z.store(out.wi[2] + i);
        s.pdf.store(out.pdf + i);
        technique.measure().store(out.measure + i);
    }
}

template <class Kind>
constexpr lab::PackedTechnique packed() {
    int bound = 2;
    if constexpr (hostile::kIsPolygon<Kind>) bound = Kind::kVertices;
    return {Kind::kName, bound, run<Kind>};
}

template <class List>
inline constexpr lab::PackedTechnique kTechniquesOf[1] = {};
template <class... Kinds>
inline constexpr lab::PackedTechnique kTechniquesOf<hostile::KindList<Kinds...>>[] = {packed<Kinds>()...};

inline constexpr auto& kTechniques = kTechniquesOf<hostile::KindsWithBounds<4, 8>>;

} // namespace accuracy
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

template <>
PackedTechniques packed_techniques<base::Isa::NUSSELT_UNIT_ISA>() {
    return {accuracy::kTechniques, sizeof(accuracy::kTechniques) / sizeof(accuracy::kTechniques[0])};
}

} // namespace nusselt::lab
