#pragma once
/// The parts of a BRDF that samplers distinguish.

#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// Values of a BRDF by component, without the cosine [1/sr].
template <class Real>
struct BrdfComponents {
    Vec3<Real> diffuse;
    Vec3<Real> specular;
};

NUSSELT_NAMESPACE_END
