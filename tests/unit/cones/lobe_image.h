#pragma once
/// Spheres, disks, ellipses and ellipsoids in the cosine space of a lobe.

#include "ltc/reference.h"
#include "proof/hostile/round_reference.h"

namespace nusselt_test {

/// \param exact a light in long double
/// \return the ellipse or the ellipsoid that the map of the lobe makes of it
template <class Light>
auto image_of(const Light& exact, const ReferenceLobe& lobe) {
    if constexpr (requires { nusselt::hostile::as_ellipsoid(exact); }) {
        const auto [center, axis] = nusselt::hostile::as_ellipsoid(exact);
        return nusselt::Ellipsoid<long double>{
            lobe.image(center), {lobe.image(axis[0]), lobe.image(axis[1]), lobe.image(axis[2])}};
    } else {
        const auto [center, u, v] = nusselt::hostile::as_ellipse(exact);
        return nusselt::Ellipse<long double>{lobe.image(center), lobe.image(u), lobe.image(v)};
    }
}

} // namespace nusselt_test
