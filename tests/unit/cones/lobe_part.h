#pragma once
/// Random lobes, and what the horizon of a lobe and that of the surface leave of a light, by geometry and formulas that
/// the library does not use.

#include <algorithm>
#include <cmath>
#include <vector>

#include <nusselt/ltc/ltc.h>

#include "cones/round_cases.h"
#include "ltc/lobes.h"

namespace nusselt_test {

/// Of any inclination, 0.1 to 1 wide. Arguments of a call may be evaluated in any order, and so may not be random.
inline nusselt::LtcCoefficients<long double> random_lobe(RandomLights& random) {
    const double width = random.logarithmic(0.1, 1), tilt = random.uniform(0, 1.5);
    const double aspect = random.logarithmic(0.4, 1.3);
    return tilted_lobe(tilt, width, aspect, random.uniform(-0.3, 0.3));
}

template <class T>
nusselt::Ltc<T> lobe_of(const nusselt::LtcCoefficients<long double>& c) {
    return nusselt::Ltc<T>({static_cast<T>(c.m00), static_cast<T>(c.m02), static_cast<T>(c.m11),
                            static_cast<T>(c.m20), static_cast<T>(c.m22), T(1)});
}

/// The ellipse center + x u + y v, with x^2 + y^2 at most 1, in the cosine space of a lobe and at the surface.
class LobePart {
public:
    /// A plane and the ellipse.
    enum class Side { below, cut, above };
    /// How much of what the lobe's horizon leaves is above the surface.
    enum class Part { dark, cut, whole };

    LobePart(const Silhouette& s, const nusselt::Ltc<long double>& ltc)
        : image_{ltc.to_cosine(s.center), ltc.to_cosine(s.u), ltc.to_cosine(s.v)},
          lobe_{image_.u.z, image_.v.z, image_.center.z},
          surface_{s.u.z, s.v.z, s.center.z} {}

    Side lobe_side() const { return lobe_.side(); }
    Side surface_side() const { return surface_.side(); }

    Part part() const {
        if (lobe_.side() == Side::below || surface_.side() == Side::below) return Part::dark;
        if (surface_.side() == Side::above) return Part::whole;
        if (std::max(lobe_(surface_.chord(1)), lobe_(surface_.chord(-1))) > 0) return Part::cut;
        return surface_(lobe_.top()) > 0 ? Part::whole : Part::dark;
    }

    /// The integral of the lobe over the light, whatever is below the surface.
    long double whole() const { return projected_solid_angle_of(image_) / kPi; }

    /// The integral of the lobe over the part above the surface: Stokes's theorem in cosine space, along the arcs of the rim
    /// and the chords that both horizons leave.
    long double integral() const {
        std::vector<long double> breaks{0, 2 * kPi};
        long double sum = chord_integral(lobe_, surface_, breaks) + chord_integral(surface_, lobe_, breaks);
        std::sort(breaks.begin(), breaks.end());
        static const QuadratureRule rule = gauss_legendre(16);
        constexpr int kPanels = 64;
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            const long double width = breaks[i + 1] - breaks[i], middle = breaks[i] + width / 2;
            const Vec2 inside{std::cos(middle), std::sin(middle)};
            if (lobe_(inside) < 0 || surface_(inside) < 0) continue;
            for (int panel = 0; panel < kPanels; ++panel) {
                for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
                    const long double share = (static_cast<long double>(panel) + rule.nodes[k]) / kPanels;
                    const long double angle = breaks[i] + width * share;
                    const Point q = at({std::cos(angle), std::sin(angle)});
                    const Point slope = std::cos(angle) * image_.v - std::sin(angle) * image_.u;
                    sum += width * rule.weights[k] / kPanels * cross(q, slope).z / dot(q, q);
                }
            }
        }
        return std::fabs(sum) / (2 * kPi);
    }

private:
    using Vec2 = nusselt::Vec2<long double>;

    /// Heights above a horizon: x * cosine + y * sine + w.
    struct Heights {
        long double x, y, w;

        long double operator()(const Vec2& p) const { return x * p.x + y * p.y + w; }
        long double share() const { return w / std::hypot(x, y); }
        Side side() const {
            if (share() >= 1) return Side::above;
            return share() <= -1 ? Side::below : Side::cut;
        }
        Vec2 top() const { return {x / std::hypot(x, y), y / std::hypot(x, y)}; }
        /// The angle of an end of the chord.
        long double chord_angle(int sign) const {
            return std::atan2(y, x) + static_cast<long double>(sign) * std::acos(-share());
        }
        Vec2 chord(int sign) const { return {std::cos(chord_angle(sign)), std::sin(chord_angle(sign))}; }
    };

    Point at(const Vec2& p) const { return image_.center + p.x * image_.u + p.y * image_.v; }

    /// Along the chord of a horizon, with the part above at its left, as far as it is above the other one.
    long double chord_integral(const Heights& line, const Heights& other,
                               std::vector<long double>& breaks) const {
        if (line.side() != Side::cut) return 0;
        for (const int sign : {-1, 1}) breaks.push_back(std::fmod(line.chord_angle(sign) + 4 * kPi, 2 * kPi));
        const Vec2 begin = line.chord(1), end = line.chord(-1);
        const long double f0 = other(begin), f1 = other(end);
        if (f0 < 0 && f1 < 0) return 0;
        const long double cut = f0 / (f0 - f1);
        const long double t0 = f0 < 0 ? cut : 0, t1 = f1 < 0 ? cut : 1;
        const Point q0 = at(begin + t0 * (end - begin)), q1 = at(begin + t1 * (end - begin));
        const Point normal = cross(q0, q1);
        if (!(length(normal) > 0)) return 0;
        return std::atan2(length(normal), dot(q0, q1)) * normal.z / length(normal);
    }

    Silhouette image_;
    Heights lobe_, surface_;
};

} // namespace nusselt_test
