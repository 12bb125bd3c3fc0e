#pragma once
/// The kinds of lights that techniques take, as bases of the types by which tests and benches name techniques.

#include <string_view>
#include <type_traits>

#include <nusselt/cones/round_lights.h>
#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/cylinder.h>
#include <nusselt/geometry/line_segment.h>
#include <nusselt/ltc/ltc.h>

NUSSELT_NAMESPACE_BEGIN
namespace hostile {

enum class Measure { area, solid_angle, projected_solid_angle, lobe };
enum class Horizon { ignored, clipped };

/// Stands for something that a technique lacks.
struct Absent {};

/// A light and the lobe of the surface, which together determine a technique for LTCs.
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

/// \copydoc PolygonOnLobe
/// \tparam Shape Sphere, Disk, Ellipse or Ellipsoid.
template <class Real, template <class> class Shape>
struct RoundOnLobe : Shape<Real> {
    LtcCoefficients<Real> lobe;
};

/// A technique for LTCs, made from a light with its lobe.
template <class Technique>
struct WithLobe : Technique {
    template <class Light>
    NUSSELT_HD explicit WithLobe(const Light& light) noexcept : Technique(light, Ltc(light.lobe)) {}
    /// Broadcasts a technique for a single light to all lanes of a pack.
    template <class Single>
    NUSSELT_HD explicit WithLobe(const WithLobe<Single>& single) noexcept
        : Technique(static_cast<const Single&>(single)) {}
};

/// The defaults that rows of the registry override.
struct AnyKind {
    static constexpr bool kCyclic = false;    ///< u.x = 0 and u.x = 1 coincide if the pole is in the light
    static constexpr bool kBiased = false;    ///< samples deviate from their density by design
    static constexpr bool kIsRelated = false; ///< a published method, there to compare with
    static constexpr std::string_view kExemptions = ""; ///< suites of tests that leave the technique out

    /// Converts a light from a generator to one that the technique takes.
    template <class Light>
    static const Light& from(const Light& light) noexcept {
        return light;
    }
};

struct AnyPolygonKind : AnyKind {
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
/// \copydoc PolygonKind
template <int N>
struct PolygonOnLobeKind : AnyPolygonKind {
    static constexpr int kVertices = N;
    template <class Real>
    using Light = PolygonOnLobe<Real, N>;
};

/// Rectangles in the form of polygons.
struct RectangleKind : PolygonKind<4> {
    /// The rectangle with the first edge of a polygon and the polygon's extent perpendicular to it.
    template <class Real>
    NUSSELT_HD static ConvexPolygon<Real, 4> from(const ConvexPolygon<Real, 4>& polygon) noexcept {
        const Vec3<Real> a = polygon.edge[0];
        const Vec3<Real> along = normalize(a);
        const Vec3<Real> across = normalize(cross(polygon.normal, along));
        Real width = Real(0);
        for (int j = 2; j < 4; ++j) width = max(width, dot(polygon.vertex[j] - polygon.vertex[0], across));
        const Vec3<Real> b = width * across;
        const Vec3<Real>& corner = polygon.vertex[0];
        return {{corner, corner + a, corner + a + b, corner + b}, {a, b, -a, -b}, cross(along, across)};
    }
};

struct AnyLineKind : AnyKind {
    template <class Real>
    using Random = Real;
};
struct LineKind : AnyLineKind {
    template <class Real>
    using Light = LineSegment<Real>;
};
struct LineOnLobeKind : AnyLineKind {
    template <class Real>
    using Light = LineOnLobe<Real>;
};

struct AnyCylinderKind : AnyKind {
    template <class Real>
    using Random = Vec2<Real>;
};
struct CylinderKind : AnyCylinderKind {
    template <class Real>
    using Light = Cylinder<Real>;
};
struct CylinderOnLobeKind : AnyCylinderKind {
    template <class Real>
    using Light = CylinderOnLobe<Real>;
};

/// The base of all kinds of round lights.
struct RoundTag : AnyKind {};
/// Spheres, disks, ellipses and ellipsoids. Generators make ellipsoids.
template <template <class> class Shape>
struct AnyRoundKind : RoundTag {
    template <class Real>
    using Random = Vec2<Real>;
    using AnyKind::from;
    /// The sphere with the first semi-diameter of an ellipsoid, the disk with the first one across the third one, or the
    /// ellipse with the first two.
    template <class Real>
    NUSSELT_HD static Shape<Real> from(const Ellipsoid<Real>& e) noexcept {
        if constexpr (std::is_same_v<Shape<Real>, Sphere<Real>>) {
            return {e.center, length(e.axis[0])};
        } else if constexpr (std::is_same_v<Shape<Real>, Disk<Real>>) {
            const Vec3<Real> normal = normalize(e.axis[2]);
            const auto missing = dot(normal, normal) == Real(0);
            return {e.center, select(missing, Vec3<Real>{Real(0), Real(0), Real(1)}, normal),
                    length(e.axis[0])};
        } else if constexpr (std::is_same_v<Shape<Real>, Ellipse<Real>>) {
            return {e.center, e.axis[0], e.axis[1]};
        } else {
            return e;
        }
    }
};
template <template <class> class Shape>
struct RoundKind : AnyRoundKind<Shape> {
    template <class Real>
    using Light = Shape<Real>;
};
template <template <class> class Shape>
struct RoundOnLobeKind : AnyRoundKind<Shape> {
    template <class Real>
    using Light = RoundOnLobe<Real, Shape>;
};
using SphereKind = RoundKind<Sphere>;
using SphereOnLobeKind = RoundOnLobeKind<Sphere>;
using DiskKind = RoundKind<Disk>;
using DiskOnLobeKind = RoundOnLobeKind<Disk>;
using EllipseKind = RoundKind<Ellipse>;
using EllipseOnLobeKind = RoundOnLobeKind<Ellipse>;
using EllipsoidKind = RoundKind<Ellipsoid>;
using EllipsoidOnLobeKind = RoundOnLobeKind<Ellipsoid>;

template <class Kind>
inline constexpr bool kIsRound = std::is_base_of_v<RoundTag, Kind>;
template <class Kind>
inline constexpr bool kIsCylinder = std::is_base_of_v<AnyCylinderKind, Kind>;
template <class Kind>
inline constexpr bool kIsPolygon = std::is_base_of_v<AnyPolygonKind, Kind>;
/// Whether samples take two random numbers.
template <class Kind>
inline constexpr bool kTakesPairs = kIsPolygon<Kind> || kIsCylinder<Kind> || kIsRound<Kind>;
/// Whether the light comes with a lobe.
template <class Kind>
inline constexpr bool kHasLobe = Kind::kMeasure == Measure::lobe;

/// Whether techniques.json exempts the technique from a suite of tests.
/// \tparam Suite has kName, the name of the suite in techniques.json.
template <class Kind, class Suite>
inline constexpr bool kIsExempt = [] {
    std::string_view rest = Kind::kExemptions;
    for (auto end = rest.find(' '); end != std::string_view::npos; end = rest.find(' ')) {
        if (rest.substr(0, end) == Suite::kName) return true;
        rest.remove_prefix(end + 1);
    }
    return rest == Suite::kName;
}();

/// A list of techniques as types.
template <class... Kinds>
struct KindList {
    /// Calls visit.template operator()<Kind>() for each technique.
    template <class Visit>
    static constexpr void for_each(Visit visit) {
        (visit.template operator()<Kinds>(), ...);
    }
};

namespace detail {

template <class... Lists>
struct Joined;
template <>
struct Joined<> {
    using Type = KindList<>;
};
template <class... Kinds>
struct Joined<KindList<Kinds...>> {
    using Type = KindList<Kinds...>;
};
template <class... A, class... B, class... Rest>
struct Joined<KindList<A...>, KindList<B...>, Rest...> {
    using Type = typename Joined<KindList<A..., B...>, Rest...>::Type;
};

template <class Suite, class List>
struct Tested;
template <class Suite, class... Kinds>
struct Tested<Suite, KindList<Kinds...>> {
    using Type =
        typename Joined<std::conditional_t<kIsExempt<Kinds, Suite>, KindList<>, KindList<Kinds>>...>::Type;
};

} // namespace detail

template <class... Lists>
using Join = typename detail::Joined<Lists...>::Type;

/// The techniques of some lists that a suite tests: those that techniques.json does not exempt.
template <class Suite, class... Lists>
using TestedBy = typename detail::Tested<Suite, Join<Lists...>>::Type;

} // namespace hostile
NUSSELT_NAMESPACE_END
