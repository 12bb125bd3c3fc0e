#pragma once
/// The techniques as types from which a test or the fuzzer picks the instantiation that it wants.

#include <type_traits>

#include <nusselt/sampling/cylinder_area.h>
#include <nusselt/sampling/cylinder_ltc.h>
#include <nusselt/sampling/cylinder_projected_solid_angle.h>
#include <nusselt/sampling/cylinder_solid_angle.h>
#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_ltc.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_ltc.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN
namespace hostile {

enum class Measure { kArea, kSolidAngle, kProjectedSolidAngle, kLobe };
enum class Horizon { kIgnored, kClipped };

/// A light and the lobe of the surface: all that a technique for LTCs depends on.
template <class Real, int N>
struct PolygonOnLobe : ConvexPolygon<Real, N> {
    LtcCoefficients<Real> lobe;
};
/// \copydoc PolygonOnLobe
template <class Real>
struct LineOnLobe : LineSegment<Real> {
    LtcCoefficients<Real> lobe;
};

/// \copydoc PolygonOnLobe
template <class Real>
struct CylinderOnLobe : Cylinder<Real> {
    LtcCoefficients<Real> lobe;
};

struct AnyPolygonKind {
    template <class Real>
    using Random = Vec2<Real>;
};
/// \tparam N bound on the number of vertices.
template <int N>
struct PolygonKind : AnyPolygonKind {
    static constexpr int kVertices = N;
    template <class Real>
    using Light = ConvexPolygon<Real, N>;
};
struct LineKind {
    template <class Real>
    using Light = LineSegment<Real>;
    template <class Real>
    using Random = Real;
};

struct AnyCylinderKind {
    template <class Real>
    using Random = Vec2<Real>;
};

template <class Kind>
inline constexpr bool kIsCylinder = std::is_base_of_v<AnyCylinderKind, Kind>;
template <class Kind>
inline constexpr bool kIsPolygon = std::is_base_of_v<AnyPolygonKind, Kind>;
/// Whether samples take two random numbers.
template <class Kind>
inline constexpr bool kTakesPairs = kIsPolygon<Kind> || kIsCylinder<Kind>;
/// Whether the light comes with a lobe.
template <class Kind>
inline constexpr bool kHasLobe = Kind::kMeasure == Measure::kLobe;

template <int N>
struct PolygonAreaKindOf : PolygonKind<N> {
    template <class Real>
    using Technique = PolygonArea<Real, N>;
    static constexpr const char* kName = "PolygonArea";
    static constexpr Measure kMeasure = Measure::kArea;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
template <int N>
struct PolygonSolidAngleKindOf : PolygonKind<N> {
    template <class Real>
    using Technique = PolygonSolidAngle<Real, N>;
    static constexpr const char* kName = "PolygonSolidAngle";
    static constexpr Measure kMeasure = Measure::kSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
template <int N>
struct PolygonClippedSolidAngleKindOf : PolygonKind<N> {
    template <class Real>
    using Technique = PolygonClippedSolidAngle<Real, N>;
    static constexpr const char* kName = "PolygonClippedSolidAngle";
    static constexpr Measure kMeasure = Measure::kSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};
template <int N>
struct PolygonProjectedSolidAngleKindOf : PolygonKind<N> {
    template <class Real>
    using Technique = PolygonProjectedSolidAngle<Real, N>;
    static constexpr const char* kName = "PolygonProjectedSolidAngle";
    static constexpr Measure kMeasure = Measure::kProjectedSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};
template <int N>
struct PolygonBiasedKindOf : PolygonKind<N> {
    template <class Real>
    using Technique = PolygonProjectedSolidAngleBiased<Real, N>;
    static constexpr const char* kName = "PolygonProjectedSolidAngleBiased";
    static constexpr Measure kMeasure = Measure::kProjectedSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};
template <int N, class Horizons>
struct PolygonOnLobeKind : AnyPolygonKind {
    static constexpr int kVertices = N;
    template <class Real>
    using Light = PolygonOnLobe<Real, N>;
    template <class Real>
    struct Technique : PolygonLtc<Real, N, Horizons> {
        explicit Technique(const Light<Real>& light) noexcept
            : PolygonLtc<Real, N, Horizons>(light, Ltc<Real>(light.lobe)) {}
        template <class Single>
        explicit Technique(const Technique<Single>& single) noexcept
            : PolygonLtc<Real, N, Horizons>(single) {}
    };
    static constexpr Measure kMeasure = Measure::kLobe;
};
template <int N>
struct PolygonLtcKindOf : PolygonOnLobeKind<N, CosineHorizon> {
    static constexpr const char* kName = "PolygonLtc";
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
template <int N>
struct PolygonClippedLtcKindOf : PolygonOnLobeKind<N, BothHorizons> {
    static constexpr const char* kName = "PolygonClippedLtc";
    static constexpr Horizon kHorizon = Horizon::kClipped;
};
using PolygonAreaKind = PolygonAreaKindOf<4>;
using PolygonSolidAngleKind = PolygonSolidAngleKindOf<4>;
using PolygonClippedSolidAngleKind = PolygonClippedSolidAngleKindOf<4>;
using PolygonProjectedSolidAngleKind = PolygonProjectedSolidAngleKindOf<4>;
using PolygonBiasedKind = PolygonBiasedKindOf<4>;
using PolygonLtcKind = PolygonLtcKindOf<4>;
using PolygonClippedLtcKind = PolygonClippedLtcKindOf<4>;

struct LineAreaKind : LineKind {
    template <class Real>
    using Technique = LineArea<Real>;
    static constexpr const char* kName = "LineArea";
    static constexpr Measure kMeasure = Measure::kArea;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
struct LineSolidAngleKind : LineKind {
    template <class Real>
    using Technique = LineSolidAngle<Real>;
    static constexpr const char* kName = "LineSolidAngle";
    static constexpr Measure kMeasure = Measure::kSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
struct LineClippedSolidAngleKind : LineKind {
    template <class Real>
    using Technique = LineClippedSolidAngle<Real>;
    static constexpr const char* kName = "LineClippedSolidAngle";
    static constexpr Measure kMeasure = Measure::kSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};
struct LineProjectedSolidAngleKind : LineKind {
    template <class Real>
    using Technique = LineProjectedSolidAngle<Real>;
    static constexpr const char* kName = "LineProjectedSolidAngle";
    static constexpr Measure kMeasure = Measure::kProjectedSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};

template <class Horizons>
struct LineOnLobeKind {
    template <class Real>
    using Light = LineOnLobe<Real>;
    template <class Real>
    using Random = Real;
    template <class Real>
    struct Technique : LineLtc<Real, Horizons> {
        explicit Technique(const Light<Real>& light) noexcept
            : LineLtc<Real, Horizons>(light, Ltc<Real>(light.lobe)) {}
        template <class Single>
        explicit Technique(const Technique<Single>& single) noexcept : LineLtc<Real, Horizons>(single) {}
    };
    static constexpr Measure kMeasure = Measure::kLobe;
};
struct LineLtcKind : LineOnLobeKind<CosineHorizon> {
    static constexpr const char* kName = "LineLtc";
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
struct LineClippedLtcKind : LineOnLobeKind<BothHorizons> {
    static constexpr const char* kName = "LineClippedLtc";
    static constexpr Horizon kHorizon = Horizon::kClipped;
};

struct CylinderKind : AnyCylinderKind {
    template <class Real>
    using Light = Cylinder<Real>;
};
struct CylinderAreaKind : CylinderKind {
    template <class Real>
    using Technique = CylinderArea<Real>;
    static constexpr const char* kName = "CylinderArea";
    static constexpr Measure kMeasure = Measure::kArea;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
struct CylinderSolidAngleKind : CylinderKind {
    template <class Real>
    using Technique = CylinderSolidAngle<Real>;
    static constexpr const char* kName = "CylinderSolidAngle";
    static constexpr Measure kMeasure = Measure::kSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
struct CylinderProjectedSolidAngleKind : CylinderKind {
    template <class Real>
    using Technique = CylinderProjectedSolidAngle<Real>;
    static constexpr const char* kName = "CylinderProjectedSolidAngle";
    static constexpr Measure kMeasure = Measure::kProjectedSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};
struct CylinderLtcKind : AnyCylinderKind {
    template <class Real>
    using Light = CylinderOnLobe<Real>;
    template <class Real>
    struct Technique : CylinderLtc<Real> {
        explicit Technique(const Light<Real>& light) noexcept
            : CylinderLtc<Real>(light, Ltc<Real>(light.lobe)) {}
        template <class Single>
        explicit Technique(const Technique<Single>& single) noexcept : CylinderLtc<Real>(single) {}
    };
    static constexpr const char* kName = "CylinderLtc";
    static constexpr Measure kMeasure = Measure::kLobe;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};

} // namespace hostile
NUSSELT_NAMESPACE_END
