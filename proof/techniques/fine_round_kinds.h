#pragma once
/// Techniques for round lights that take kFineConePlaces, for tests. They are not in the registry: they are the techniques of the
/// registry with another template argument.

#include "proof/techniques/registry.h"

NUSSELT_NAMESPACE_BEGIN
namespace hostile {

/// \tparam Coarse the kind of the registry.
template <class Coarse, template <class> class Shape>
struct FineRoundKind : Coarse {
    template <class Real>
    using Technique = ConeProjectedSolidAngle<Real, Shape, kConeSteps<Real>, kFineConePlaces>;
};
template <class Coarse, template <class> class Shape>
struct FineRoundOnLobeKind : Coarse {
    template <class Real>
    using Technique = WithLobe<ConeLtc<Real, Shape, kConeSteps<Real>, kFineConePlaces>>;
};

struct FineSphereKind : FineRoundKind<SphereProjectedSolidAngleKind, Sphere> {
    static constexpr const char* kName = "FineSphereProjectedSolidAngle";
};
struct FineDiskKind : FineRoundKind<DiskProjectedSolidAngleKind, Disk> {
    static constexpr const char* kName = "FineDiskProjectedSolidAngle";
};
struct FineEllipseKind : FineRoundKind<EllipseProjectedSolidAngleKind, Ellipse> {
    static constexpr const char* kName = "FineEllipseProjectedSolidAngle";
};
struct FineEllipsoidKind : FineRoundKind<EllipsoidProjectedSolidAngleKind, Ellipsoid> {
    static constexpr const char* kName = "FineEllipsoidProjectedSolidAngle";
};
struct FineSphereOnLobeKind : FineRoundOnLobeKind<SphereLtcKind, Sphere> {
    static constexpr const char* kName = "FineSphereLtc";
};
struct FineDiskOnLobeKind : FineRoundOnLobeKind<DiskLtcKind, Disk> {
    static constexpr const char* kName = "FineDiskLtc";
};
struct FineEllipseOnLobeKind : FineRoundOnLobeKind<EllipseLtcKind, Ellipse> {
    static constexpr const char* kName = "FineEllipseLtc";
};
struct FineEllipsoidOnLobeKind : FineRoundOnLobeKind<EllipsoidLtcKind, Ellipsoid> {
    static constexpr const char* kName = "FineEllipsoidLtc";
};

using FineRoundKinds = KindList<FineSphereKind, FineDiskKind, FineEllipseKind, FineEllipsoidKind>;
using FineRoundOnLobeKinds =
    KindList<FineSphereOnLobeKind, FineDiskOnLobeKind, FineEllipseOnLobeKind, FineEllipsoidOnLobeKind>;

} // namespace hostile
NUSSELT_NAMESPACE_END
