#pragma once
/// Classes of lights for each kind of technique. Lights on lobes take their lobes from the shipped table.

#include "proof/accuracy/lights.h"
#include "tables/ltc_table.h"

#include <random>
#include <vector>

namespace nusselt::lab {

/// \param uniform draws numbers in [0, 1).
template <class Uniform>
LtcCoefficients<float> lobe_of_table(Uniform uniform) {
    const auto roughness = static_cast<float>(uniform());
    const auto cos_o = static_cast<float>(uniform());
    const auto f0 = static_cast<float>(uniform());
    return tables::frostbite_ltc_table().view().lookup(roughness, cos_o, f0);
}

inline LtcCoefficients<float> random_lobe(proof::Engine& engine) {
    return lobe_of_table([&] { return std::uniform_real_distribution<float>(0, 1)(engine); });
}

inline const auto& classes_of(const proof::PolygonClass*) { return proof::polygon_classes(); }
inline const auto& classes_of(const proof::LineClass*) { return proof::line_classes(); }
inline const auto& classes_of(const proof::CylinderClass*) { return proof::cylinder_classes(); }
inline const auto& classes_of(const proof::RoundClass*) { return proof::round_classes(); }
template <class Base>
const auto& classes_of(const proof::OnLobes<Base>*) {
    static const auto classes = proof::on_lobes(classes_of(static_cast<const Base*>(nullptr)), random_lobe);
    return classes;
}

/// Polygons with more vertices need the larger bound.
inline bool fits_bound(const proof::PolygonClass& lights, int bound) {
    return bound == 4 ? lights.vertex_count <= 4 : 4 < lights.vertex_count && lights.vertex_count <= bound;
}
inline bool fits_bound(const proof::LineClass&, int) { return true; }
inline bool fits_bound(const proof::CylinderClass&, int) { return true; }
inline bool fits_bound(const proof::RoundClass&, int) { return true; }
template <class Base>
bool fits_bound(const proof::OnLobes<Base>& lights, int bound) {
    return fits_bound(*lights.base, bound);
}

} // namespace nusselt::lab
