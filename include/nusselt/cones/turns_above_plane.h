#pragma once
/// The part of a map of the unit square to a cone above one more plane through the origin.
///
/// Derived here. All maps of cones have lines of constant u.x on great circles, with less than half a turn. A plane cuts such a line
/// at most once, at the crossing of the line from its begin to its end: what is left is an interval of u.y, whose length is the
/// density of u.x that remains. It is smooth between the places where the plane cuts the rim of the cone, and interpolated there.

#include <nusselt/cones/elliptic_cone.h>
#include <nusselt/sampling/piecewise_linear.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack.
/// \tparam Map  of the unit square: sample(u).wi, unit, and invert(wi).
template <class Real>
class TurnsAbovePlane {
    using Scalar = scalar_t<Real>;
    static constexpr int kNodes = 16;
    static constexpr int kParts = 3;
    using Part = PiecewiseLinear<Real, kNodes>;

public:
    /// A choice of u.x with the interval of u.y above the plane.
    struct Turn {
        Real x, begin, end;
        Real density; ///< of x

        NUSSELT_HD Real length() const noexcept { return end - begin; }
    };

    TurnsAbovePlane() = default;

    /// \param normal of the plane, unit.
    template <class Map>
    NUSSELT_HD TurnsAbovePlane(const Map& map, const EllipticCone<Real>& cone,
                               const Vec3<Real>& normal) noexcept
        : normal_(normal) {
        // Where the plane cuts the rim, n_1 a cos(theta) + n_2 b sin(theta) + n_3 c = 0.
        const Real na = dot(normal, cone.e1) * cone.a, nb = dot(normal, cone.e2) * cone.b;
        const Real nc = dot(normal, cone.e3) * cone.c;
        const Real k = detail::hypotenuse(na, nb);
        const auto cuts = abs(nc) < k;
        const Real inverse = Real(1) / select(cuts, k, Real(1));
        const Vec2<Real> up{na * inverse, nb * inverse};
        const Real height = nc * inverse;
        const Real half_arc = sqrt(max((Real(1) - height) * (Real(1) + height), Real(0)));
        const auto place = [&](const Real& side) {
            const Vec2<Real> disk{-height * up.x - side * up.y, -height * up.y + side * up.x};
            return select(cuts, map.invert(normalize(cone.direction(disk))).x, Real(0));
        };
        const Real first = place(half_arc), second = place(-half_arc);
        edge_[0] = Real(0);
        edge_[1] = min(first, second);
        edge_[2] = max(first, second);
        edge_[3] = Real(1);
        total_[0] = Real(0);
        for (int i = 0; i < kParts; ++i) {
            Real value[kNodes];
            const Real width = edge_[i + 1] - edge_[i];
            for (int j = 0; j < kNodes; ++j) {
                // Most lights are on one side of the plane, and cost nothing here.
                if (!any(cuts)) {
                    value[j] = select(nc > Real(0), Real(1), Real(0));
                    continue;
                }
                const Real x = below_one(multiply_add(width, Real(Part::node(j)), edge_[i]));
                value[j] = interval(map, x).length();
            }
            part_[i] = Part(value);
            total_[i + 1] = total_[i] + width * part_[i].integral();
        }
    }

    template <class Single>
    NUSSELT_HD explicit TurnsAbovePlane(const TurnsAbovePlane<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// The share of the map's measure above the plane.
    NUSSELT_HD const Real& share() const noexcept { return total_[kParts]; }

    /// \param u in [0, 1)
    template <class Map>
    NUSSELT_HD Turn sample(const Map& map, const Real& u) const noexcept {
        const Real goal = u * total_[kParts];
        Real x = Real(0);
        for (int i = 0; i < kParts; ++i) {
            const Real width = edge_[i + 1] - edge_[i];
            const Real share = detail::over_positive(goal - total_[i], total_[i + 1] - total_[i]);
            const Real here = multiply_add(width, part_[i].invert(below_one(share)), edge_[i]);
            const auto chosen = (goal >= total_[i]) & (total_[i + 1] > total_[i]);
            x = select(chosen, here, x);
        }
        return at(map, below_one(x));
    }

    /// \param x in [0, 1)
    template <class Map>
    NUSSELT_HD Turn at(const Map& map, const Real& x) const noexcept {
        Turn turn = interval(map, x);
        Real value = Real(0);
        for (int i = 0; i < kParts; ++i)
            value = select(x >= edge_[i], part_[i].value(share_of_part(i, x)), value);
        turn.density = detail::over_positive(value, total_[kParts]);
        return turn;
    }

    /// The random number of which sample() makes x.
    NUSSELT_HD Real invert(const Real& x) const noexcept {
        Real below = Real(0);
        for (int i = 0; i < kParts; ++i) {
            const Real width = edge_[i + 1] - edge_[i];
            below = select(x >= edge_[i], total_[i] + width * part_[i].below(share_of_part(i, x)), below);
        }
        return below_one(detail::over_positive(below, total_[kParts]));
    }

private:
    NUSSELT_HD Real share_of_part(int i, const Real& x) const noexcept {
        return min(max(detail::over_positive(x - edge_[i], edge_[i + 1] - edge_[i]), Real(0)), Real(1));
    }

    template <class Map>
    NUSSELT_HD Turn interval(const Map& map, const Real& x) const noexcept {
        const Vec3<Real> begin = map.sample({x, Real(0)}).wi, end = map.sample({x, below_one(Real(1))}).wi;
        const Real from = dot(normal_, begin), to = dot(normal_, end);
        const Vec3<Real> crossing = abs(to) * begin + abs(from) * end;
        const Real y = map.invert(normalize(crossing)).y;
        const auto starts = from >= Real(0), ends = to >= Real(0);
        const Real none = Real(0);
        return {x, select(starts, none, select(ends, y, none)),
                select(ends, Real(1), select(starts, y, none)), none};
    }

    Vec3<Real> normal_;
    Real edge_[kParts + 1];  ///< of parts, in u.x
    Real total_[kParts + 1]; ///< integrals of the length up to there
    Part part_[kParts];

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.normal_, self.edge_, self.total_, self.part_);
    }
};

NUSSELT_NAMESPACE_END
