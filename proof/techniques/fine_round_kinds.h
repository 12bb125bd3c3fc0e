#pragma once
/// Techniques for round lights that take kFineConePlaces, for tests. They are not in the registry: they are techniques of the
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
struct FineClippedRoundKind : Coarse {
    template <class Real>
    using Technique = ConeClippedSolidAngle<Real, Shape, kFineConePlaces>;
};
template <class Coarse, template <class> class Shape>
struct FineRoundOnLobeKind : Coarse {
    template <class Real>
    using Technique = WithLobe<ConeLtc<Real, Shape, kConeSteps<Real>, kFineConePlaces>>;
};
template <class Coarse, template <class> class Shape>
struct FineRoundAboveSurfaceKind : Coarse {
    template <class Real>
    using Technique = WithLobe<ConeClippedLtc<Real, Shape, kConeSteps<Real>, kFineConePlaces>>;
};

struct FineDiskKind : FineRoundKind<DiskProjectedSolidAngleKind, Disk> {
    static constexpr const char* kName = "FineDiskProjectedSolidAngle";
};
struct FineEllipsoidKind : FineRoundKind<EllipsoidProjectedSolidAngleKind, Ellipsoid> {
    static constexpr const char* kName = "FineEllipsoidProjectedSolidAngle";
};
struct FineClippedSphereKind : FineClippedRoundKind<SphereClippedSolidAngleKind, Sphere> {
    static constexpr const char* kName = "FineSphereClippedSolidAngle";
};
struct FineClippedEllipseKind : FineClippedRoundKind<EllipseClippedSolidAngleKind, Ellipse> {
    static constexpr const char* kName = "FineEllipseClippedSolidAngle";
};
struct FineSphereOnLobeKind : FineRoundOnLobeKind<SphereLtcKind, Sphere> {
    static constexpr const char* kName = "FineSphereLtc";
};
struct FineEllipseOnLobeKind : FineRoundOnLobeKind<EllipseLtcKind, Ellipse> {
    static constexpr const char* kName = "FineEllipseLtc";
};
struct FineDiskAboveSurfaceKind : FineRoundAboveSurfaceKind<DiskClippedLtcKind, Disk> {
    static constexpr const char* kName = "FineDiskClippedLtc";
};
struct FineEllipsoidAboveSurfaceKind : FineRoundAboveSurfaceKind<EllipsoidClippedLtcKind, Ellipsoid> {
    static constexpr const char* kName = "FineEllipsoidClippedLtc";
};

/// Flat and solid shapes in turn: what lies between a cone and its samples does not depend on the shape.
using FineRoundKinds = KindList<FineDiskKind, FineEllipsoidKind, FineClippedSphereKind,
                                FineClippedEllipseKind, FineSphereOnLobeKind, FineEllipseOnLobeKind,
                                FineDiskAboveSurfaceKind, FineEllipsoidAboveSurfaceKind>;

} // namespace hostile
NUSSELT_NAMESPACE_END
