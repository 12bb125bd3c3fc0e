#pragma once
/// The techniques under test, each as a type from which a test picks the instantiation that it wants.

#include <cstring>
#include <type_traits>

#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

namespace nusselt_test {

enum class Measure { kArea, kSolidAngle, kProjectedSolidAngle };
enum class Horizon { kIgnored, kClipped };

struct AnyPolygonKind {
    template <class Real>
    using Random = nusselt::Vec2<Real>;
};
/// \tparam N bound on the number of vertices.
template <int N>
struct PolygonKind : AnyPolygonKind {
    static constexpr int kVertices = N;
    template <class Real>
    using Light = nusselt::ConvexPolygon<Real, N>;
};
struct LineKind {
    template <class Real>
    using Light = nusselt::LineSegment<Real>;
    template <class Real>
    using Random = Real;
};

template <class Kind>
inline constexpr bool kIsPolygon = std::is_base_of_v<AnyPolygonKind, Kind>;

template <int N>
struct PolygonAreaKindOf : PolygonKind<N> {
    template <class Real>
    using Technique = nusselt::PolygonArea<Real, N>;
    static constexpr const char* kName = "PolygonArea";
    static constexpr Measure kMeasure = Measure::kArea;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
template <int N>
struct PolygonSolidAngleKindOf : PolygonKind<N> {
    template <class Real>
    using Technique = nusselt::PolygonSolidAngle<Real, N>;
    static constexpr const char* kName = "PolygonSolidAngle";
    static constexpr Measure kMeasure = Measure::kSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
template <int N>
struct PolygonClippedSolidAngleKindOf : PolygonKind<N> {
    template <class Real>
    using Technique = nusselt::PolygonClippedSolidAngle<Real, N>;
    static constexpr const char* kName = "PolygonClippedSolidAngle";
    static constexpr Measure kMeasure = Measure::kSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};
template <int N>
struct PolygonProjectedSolidAngleKindOf : PolygonKind<N> {
    template <class Real>
    using Technique = nusselt::PolygonProjectedSolidAngle<Real, N>;
    static constexpr const char* kName = "PolygonProjectedSolidAngle";
    static constexpr Measure kMeasure = Measure::kProjectedSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};
template <int N>
struct PolygonBiasedKindOf : PolygonKind<N> {
    template <class Real>
    using Technique = nusselt::PolygonProjectedSolidAngleBiased<Real, N>;
    static constexpr const char* kName = "PolygonProjectedSolidAngleBiased";
    static constexpr Measure kMeasure = Measure::kProjectedSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};
using PolygonAreaKind = PolygonAreaKindOf<4>;
using PolygonSolidAngleKind = PolygonSolidAngleKindOf<4>;
using PolygonClippedSolidAngleKind = PolygonClippedSolidAngleKindOf<4>;
using PolygonProjectedSolidAngleKind = PolygonProjectedSolidAngleKindOf<4>;
using PolygonBiasedKind = PolygonBiasedKindOf<4>;

struct LineAreaKind : LineKind {
    template <class Real>
    using Technique = nusselt::LineArea<Real>;
    static constexpr const char* kName = "LineArea";
    static constexpr Measure kMeasure = Measure::kArea;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
struct LineSolidAngleKind : LineKind {
    template <class Real>
    using Technique = nusselt::LineSolidAngle<Real>;
    static constexpr const char* kName = "LineSolidAngle";
    static constexpr Measure kMeasure = Measure::kSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kIgnored;
};
struct LineClippedSolidAngleKind : LineKind {
    template <class Real>
    using Technique = nusselt::LineClippedSolidAngle<Real>;
    static constexpr const char* kName = "LineClippedSolidAngle";
    static constexpr Measure kMeasure = Measure::kSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};
struct LineProjectedSolidAngleKind : LineKind {
    template <class Real>
    using Technique = nusselt::LineProjectedSolidAngle<Real>;
    static constexpr const char* kName = "LineProjectedSolidAngle";
    static constexpr Measure kMeasure = Measure::kProjectedSolidAngle;
    static constexpr Horizon kHorizon = Horizon::kClipped;
};

/// A technique and the number type that it is instantiated with: the parameter of typed tests.
template <class KindType, class RealType>
struct Instance {
    using Kind = KindType;
    using Real = RealType;
    using Scalar = nusselt::scalar_t<Real>;
    using Technique = typename Kind::template Technique<Real>;
    using ScalarTechnique = typename Kind::template Technique<Scalar>;
    using Light = typename Kind::template Light<Real>;
    using ScalarLight = typename Kind::template Light<Scalar>;
    using Random = typename Kind::template Random<Real>;
    using ScalarRandom = typename Kind::template Random<Scalar>;
    static constexpr int kLanes = nusselt::RealTraits<Real>::kLanes;
};

/// Writes one lane of a struct of packs of T, or of a pack. A pack lies in memory as an array of its lanes.
template <class T, class Packed, class Single>
void set_lane(Packed& packed, int lane, const Single& single) {
    static_assert(std::is_trivially_copyable_v<Packed> && std::is_trivially_copyable_v<Single>);
    constexpr std::size_t kLanes = sizeof(Packed) / sizeof(Single);
    static_assert(sizeof(Packed) == kLanes * sizeof(Single) && sizeof(Single) % sizeof(T) == 0);
    auto* target = reinterpret_cast<unsigned char*>(&packed) + static_cast<std::size_t>(lane) * sizeof(T);
    const auto* source = reinterpret_cast<const unsigned char*>(&single);
    for (std::size_t i = 0; i < sizeof(Single); i += sizeof(T)) {
        std::memcpy(target + i * kLanes, source + i, sizeof(T));
    }
}

/// Reads one lane of a struct of packs of T, or of a pack.
template <class T, class Single, class Packed>
Single get_lane(const Packed& packed, int lane) {
    static_assert(std::is_trivially_copyable_v<Packed> && std::is_trivially_copyable_v<Single>);
    constexpr std::size_t kLanes = sizeof(Packed) / sizeof(Single);
    static_assert(sizeof(Packed) == kLanes * sizeof(Single) && sizeof(Single) % sizeof(T) == 0);
    Single single;
    auto* target = reinterpret_cast<unsigned char*>(&single);
    const auto* source =
        reinterpret_cast<const unsigned char*>(&packed) + static_cast<std::size_t>(lane) * sizeof(T);
    for (std::size_t i = 0; i < sizeof(Single); i += sizeof(T)) {
        std::memcpy(target + i, source + i * kLanes, sizeof(T));
    }
    return single;
}

} // namespace nusselt_test
