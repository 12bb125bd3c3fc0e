// Materials that pbrt does not have: extensions of its format.

#include "scene/import/pbrt/material_reader.h"
#include "scene/import/pbrt/syntax/name_table.h"
#include "scene/model/limits.h"
#include "scene/model/vector_math.h"

#include <cmath>
#include <utility>

namespace nusselt::scene {

namespace {

using Surface = std::optional<SurfaceFormula>;

/// Exponents between 0 and 1 would give lobes with a sharp end, which lines do not integrate exactly.
double phong_exponent(MaterialReader& m) {
    const double exponent = m.constant("exponent", 100);
    if (exponent >= 1 && exponent <= kLargestPhongExponent) return exponent;
    if (exponent == 0) return 0;
    if (!(exponent >= 0)) m.fail("exponent", "exponent must not be negative, found " + to_text(exponent));
    const double limit = exponent < 1 ? 1 : kLargestPhongExponent;
    m.warn("exponents other than 0 and 1 to 1e6 are clamped");
    return limit;
}

/// The surface of N. Billen and P. Dutre, Line Sampling for Direct Illumination, 2016, Sec. 5.3.
Surface phong(MaterialReader& m) {
    SurfaceFormula surface;
    surface.model = BrdfModel::phong;
    surface.diffuse = m.unit_colour("Kd", 0.25);
    surface.f0 = m.unit_colour("Ks", 0.25);
    surface.exponent = phong_exponent(m);
    // As phong_alpha() of the library has it.
    surface.roughness = grey_value(std::pow(2 * surface.exponent + 1, -0.25));
    return surface;
}

constexpr std::pair<std::string_view, MaterialReduction> kReductions[] = {
    {"phong", phong},
};

} // namespace

MaterialReduction find_extension(std::string_view type) { return find_named(kReductions, type); }

} // namespace nusselt::scene
