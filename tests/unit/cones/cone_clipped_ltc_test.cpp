/// Tests of clipped linearly transformed cosines for spheres, disks, ellipses and ellipsoids: measures, densities and
/// weights where the surface's horizon cuts them, and what must not change where it does not.

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/cones/cone_clipped_ltc.h>

#include "cones/round_cases.h"
#include "ltc/lobes.h"

namespace nusselt_test {
namespace {

using nusselt::abs;
using nusselt::Disk;
using nusselt::Ellipsoid;
using nusselt::LtcCoefficients;
using nusselt::Sphere;
using nusselt::Vec2;

template <class T>
nusselt::Ltc<T> lobe_of(const LtcCoefficients<long double>& c) {
    return nusselt::Ltc<T>({static_cast<T>(c.m00), static_cast<T>(c.m02), static_cast<T>(c.m11),
                            static_cast<T>(c.m20), static_cast<T>(c.m22), T(1)});
}

template <class T, template <class> class Light>
nusselt::ConeClippedLtc<T, Light> clipped(const Light<T>& light, const nusselt::Ltc<T>& ltc) {
    return {light, ltc};
}

template <class T, template <class> class Light>
nusselt::ConeClippedLtc<T, Light, nusselt::kConeSteps<T>, nusselt::kFineConePlaces>
clipped_finely(const Light<T>& light, const nusselt::Ltc<T>& ltc) {
    return {light, ltc};
}

template <class T, template <class> class Light>
nusselt::ConeLtc<T, Light> unclipped(const Light<T>& light, const nusselt::Ltc<T>& ltc) {
    return {light, ltc};
}

/// The middle of cell i of a grid.
template <class T>
Vec2<T> grid(int i, int side) {
    const T size = static_cast<T>(side);
    return {(static_cast<T>(i % side) + T(0.5)) / size, (static_cast<T>(i / side) + T(0.5)) / size};
}

/// Lights and lobes of any inclination.
template <class Function>
void for_each_light(Place place, int count, const Function& f) {
    RandomLights lights(17);
    for (int i = 0; i < count; ++i) {
        for (const Shape shape : kShapes) {
            const RoundLight light = lights(shape, place);
            const auto width = lights.logarithmic(0.1, 1);
            const auto tilt = lights.uniform(0, 1.5), aspect = lights.logarithmic(0.4, 1.3);
            f(light, tilted_lobe(tilt, width, aspect, lights.uniform(-0.3, 0.3)));
        }
    }
}

/// Whether the technique has a map of its own for a light, since the surface's horizon cuts it.
template <class Technique, class Unclipped>
bool is_cut(const Technique& technique, const Unclipped& unclipped) {
    if (!(technique.measure() > 0)) return false;
    const auto a = technique.sample({0.3f, 0.4f}).wi, b = unclipped.sample({0.3f, 0.4f}).wi;
    return a.x != b.x || a.y != b.y || a.z != b.z;
}

/// The integral of a lobe over the part of an ellipse above the surface: Stokes's theorem in cosine space, along the
/// arcs of the rim and the chords that both horizons leave.
long double lobe_integral_above(const Silhouette& s, const nusselt::Ltc<long double>& ltc) {
    struct Linear { ///< x * cosine + y * sine + w
        long double x, y, w;
        long double operator()(const Vec2<long double>& p) const { return x * p.x + y * p.y + w; }
    };
    const Point u = ltc.to_cosine(s.u), v = ltc.to_cosine(s.v), center = ltc.to_cosine(s.center);
    const Linear horizons[] = {{u.z, v.z, center.z}, {s.u.z, s.v.z, s.center.z}};
    const auto at = [&](const Vec2<long double>& p) { return center + p.x * u + p.y * v; };

    std::vector<long double> breaks{0, 2 * kPi};
    long double sum = 0;
    for (int i = 0; i < 2; ++i) {
        const Linear& line = horizons[i];
        const long double steep = std::hypot(line.x, line.y), height = line.w / steep;
        if (!(std::fabs(height) < 1)) continue;
        const long double up = std::atan2(line.y, line.x), half = std::acos(-height);
        for (const long double sign : {-1.0L, 1.0L})
            breaks.push_back(std::fmod(up + sign * half + 4 * kPi, 2 * kPi));
        // The chord, with the part above at its left, clipped by the other horizon.
        const Vec2<long double> begin{std::cos(up + half), std::sin(up + half)};
        const Vec2<long double> end{std::cos(up - half), std::sin(up - half)};
        const long double f0 = horizons[1 - i](begin), f1 = horizons[1 - i](end);
        if (f0 < 0 && f1 < 0) continue;
        const long double cut = f0 / (f0 - f1);
        const long double t0 = f0 < 0 ? cut : 0, t1 = f1 < 0 ? cut : 1;
        const Point q0 = at(begin + t0 * (end - begin)), q1 = at(begin + t1 * (end - begin));
        const Point normal = cross(q0, q1);
        if (length(normal) > 0) sum += std::atan2(length(normal), dot(q0, q1)) * normal.z / length(normal);
    }
    std::sort(breaks.begin(), breaks.end());
    static const QuadratureRule rule = gauss_legendre(16);
    constexpr int kPanels = 64;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const long double width = breaks[i + 1] - breaks[i], middle = breaks[i] + width / 2;
        const Vec2<long double> inside{std::cos(middle), std::sin(middle)};
        if (horizons[0](inside) < 0 || horizons[1](inside) < 0) continue;
        for (int panel = 0; panel < kPanels; ++panel) {
            for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
                const long double share = (static_cast<long double>(panel) + rule.nodes[k]) / kPanels;
                const long double angle = breaks[i] + width * share;
                const Point q = at({std::cos(angle), std::sin(angle)});
                const Point slope = std::cos(angle) * v - std::sin(angle) * u;
                sum += width * rule.weights[k] / kPanels * cross(q, slope).z / dot(q, q);
            }
        }
    }
    return std::fabs(sum) / (2 * kPi);
}

struct Case {
    const char* name;
    Place place;
    double spread;  ///< of weights around 1
    double measure; ///< relative error
};
// The interpolant is a polynomial but for wide cones, where it is linear between places. Of tiny lights, both horizons
// leave slivers whose heights are a few thousand roundings of the direction of the light.
constexpr Case kCases[] = {
    {"ordinary", Place::ordinary, 0.15, 1e-2},   {"at horizon", Place::at_horizon, 0.15, 1e-2},
    {"tiny", Place::tiny, 1e-3, 2e-4},           {"near", Place::near, 0.3, 2e-2},
    {"elongated", Place::elongated, 0.15, 2e-2}, {"edge-on", Place::edge_on, 5e-3, 1e-4}};

TEST(ConeClippedLtcTest, WeightsAreNearlyConstantAndMeasuresThoseOfContours) {
    for (const Case& c : kCases) {
        double least = 1, most = 1, worst = 0;
        int cut = 0;
        for_each_light(c.place, 30, [&](const RoundLight& light, const auto& coefficients) {
            const auto exact = static_cast<double>(
                lobe_integral_above(silhouette_of(light), lobe_of<long double>(coefficients)));
            const auto ltc = lobe_of<double>(coefficients);
            with_light<double>(light, [&](const auto& l) {
                const auto technique = clipped(l, ltc);
                if (!is_cut(technique, unclipped(l, ltc))) return;
                ++cut;
                worst = std::max(worst, std::fabs(technique.measure() / exact - 1));
                for (int i = 0; i < 256; ++i) {
                    const auto s = technique.sample(grid<double>(i, 16));
                    ASSERT_GT(s.pdf, 0);
                    ASSERT_GE(s.wi.z, 0);
                    const double weight = ltc.density(s.wi) / (s.pdf * exact);
                    least = std::min(least, weight);
                    most = std::max(most, weight);
                }
            });
        });
        EXPECT_GE(cut, 5) << c.name;
        EXPECT_LE(most - 1, c.spread) << c.name;
        EXPECT_GE(least - 1, -c.spread) << c.name;
        EXPECT_LE(worst, c.measure) << c.name;
    }
}

TEST(ConeClippedLtcTest, WeightsOfWideConesAreNearlyConstantWithMorePlaces) {
    double coarse = 0, fine = 0;
    for (const Place place : {Place::near, Place::needle}) {
        for_each_light(place, 30, [&](const RoundLight& light, const auto& coefficients) {
            const auto ltc = lobe_of<double>(coefficients);
            const auto spread = [&](const auto& technique) {
                double largest = 0;
                for (int i = 0; i < 256 && technique.measure() > 0; ++i) {
                    const auto s = technique.sample(grid<double>(i, 16));
                    largest =
                        std::max(largest, std::fabs(ltc.density(s.wi) / (s.pdf * technique.measure()) - 1));
                }
                return largest;
            };
            with_light<double>(light, [&](const auto& l) {
                if (!is_cut(clipped(l, ltc), unclipped(l, ltc))) return;
                coarse = std::max(coarse, spread(clipped(l, ltc)));
                fine = std::max(fine, spread(clipped_finely(l, ltc)));
            });
        });
    }
    constexpr double kTarget = 0.02;
    EXPECT_LE(fine, kTarget);
    EXPECT_GT(coarse, kTarget);
}

/// The largest relative difference of densities and the Jacobian of the map from random numbers to directions.
/// \param change of the density.
double jacobian_error(double change) {
    double worst = 0;
    for (const Place place :
         {Place::ordinary, Place::at_horizon, Place::near, Place::elongated, Place::touching}) {
        for_each_light(place, 10, [&](const RoundLight& light, const auto& coefficients) {
            const auto ltc = lobe_of<double>(coefficients);
            with_light<double>(light, [&](const auto& l) {
                const auto technique = clipped(l, ltc);
                if (!is_cut(technique, unclipped(l, ltc))) return;
                for (int i = 0; i < 16; ++i) {
                    constexpr double kStep = 1e-5;
                    const auto u = grid<double>(i, 4);
                    const auto across =
                        technique.sample({u.x + kStep, u.y}).wi - technique.sample({u.x - kStep, u.y}).wi;
                    const auto away =
                        technique.sample({u.x, u.y + kStep}).wi - technique.sample({u.x, u.y - kStep}).wi;
                    const double area = length(cross(across, away)) / (4 * kStep * kStep);
                    worst = std::max(worst, std::fabs(change * area * technique.sample(u).pdf - 1));
                }
            });
        });
    }
    return worst;
}

TEST(ConeClippedLtcTest, DensitiesAreThoseOfTheMap) {
    constexpr double kDifferences = 3e-5; // of differences over 2e-5
    EXPECT_LE(jacobian_error(1), kDifferences);
    EXPECT_GT(jacobian_error(1.0001), kDifferences);
}

/// No sample is below the surface, its point is on its ray and its light, and it leads back to its random numbers.
template <class T>
void expect_valid(const RoundLight& light, const LtcCoefficients<long double>& coefficients, T tolerance) {
    const auto ltc = lobe_of<T>(coefficients);
    with_light<T>(light, [&](const auto& l) {
        const auto technique = clipped(l, ltc);
        if (!(technique.measure() > 0)) return;
        for (int i = 0; i < 64; ++i) {
            const auto u = grid<T>(i, 8);
            const auto s = technique.sample(u);
            ASSERT_GE(s.wi.z, 0);
            ASSERT_GE(s.p.z, 0);
            ASSERT_GT(s.pdf, 0);
            ASSERT_EQ(technique.pdf(s.wi), s.pdf);
            const auto back = technique.invert(s.wi);
            ASSERT_LE(abs(back.x - u.x), tolerance);
            ASSERT_LE(abs(back.y - u.y), tolerance);
        }
    });
}

TEST(ConeClippedLtcTest, SamplesAreAboveTheSurfaceInEveryPrecision) {
    for (const Place place : {Place::ordinary, Place::at_horizon, Place::near}) {
        for_each_light(place, 20, [](const RoundLight& light, const auto& coefficients) {
            expect_valid<float>(light, coefficients, 5e-3f);
            expect_valid<double>(light, coefficients, 1e-9);
            expect_valid<long double>(light, coefficients, 1e-9L);
        });
    }
}

TEST(ConeClippedLtcTest, LightsThatTheSurfaceDoesNotCutHaveTheSamplesOfConeLtc) {
    int whole = 0;
    for_each_light(Place::ordinary, 30, [&](const RoundLight& light, const auto& coefficients) {
        const auto ltc = lobe_of<float>(coefficients);
        if (silhouette_of(light).center.z < 2) return;
        with_light<float>(light, [&](const auto& l) {
            const auto technique = clipped(l, ltc);
            const auto other = unclipped(l, ltc);
            if (!(other.measure() > 0)) return;
            ++whole;
            EXPECT_EQ(technique.measure(), other.measure());
            for (int i = 0; i < 16; ++i) {
                const auto a = technique.sample(grid<float>(i, 4)), b = other.sample(grid<float>(i, 4));
                EXPECT_EQ(a.wi.x, b.wi.x);
                EXPECT_EQ(a.wi.y, b.wi.y);
                EXPECT_EQ(a.wi.z, b.wi.z);
                EXPECT_EQ(a.pdf, b.pdf);
            }
        });
    });
    EXPECT_GE(whole, 10);
}

/// The largest change of samples and densities of a sphere that rises by small steps until the y-axis, the line of both
/// horizons, leaves it at a height of 0.958.
/// \param slant of its way.
double largest_change(double slant) {
    const auto ltc = lobe_of<double>(tilted_lobe(0.7L, 0.5L, 0.9L, 0.1L));
    constexpr int kSteps = 300;
    double worst = 0;
    for (int k = 0; k < kSteps; ++k) {
        const auto at = [&](int step) {
            const double z = 0.9 + 0.09 * step / kSteps;
            return clipped_finely(Sphere<double>{{slant * z, 2, z}, 1}, ltc);
        };
        const auto a = at(k), b = at(k + 1);
        for (int i = 0; i < 64; ++i) {
            const auto u = grid<double>(i, 8);
            const auto s = a.sample(u), t = b.sample(u);
            worst = std::max({worst, length(s.wi - t.wi), std::fabs(s.pdf / t.pdf - 1)});
        }
    }
    return worst;
}

TEST(ConeClippedLtcTest, MapsAreContinuousWhereTheLineOfBothHorizonsLeavesTheLight) {
    constexpr double kBetweenInterpolants = 0.03; // one step from a polynomial to linear interpolation
    EXPECT_LE(largest_change(-0.3), kBetweenInterpolants);
    // On the other side the surface does not cut the rest of the light any more: samples jump to those of ConeLtc.
    EXPECT_GT(largest_change(0.3), 0.5);
}

/// The lobe's part above the surface is a lune between both horizons.
TEST(ConeClippedLtcTest, FromInsideThePartOfTheLobeAboveTheSurfaceLeadsToTheLight) {
    for (const NamedLobe& named : wide_lobes()) {
        const auto ltc = lobe_of<float>(named.coefficients);
        const auto normal = ltc.normal_to_cosine({0, 0, 1});
        const float mass = 0.5f * (1 + normal.z / length(normal));
        for (const Sphere<float>& light :
             {Sphere<float>{{0, 0, 0}, 1}, Sphere<float>{{0.2f, -0.3f, 0.6f}, 1}}) {
            const auto technique = clipped(light, ltc);
            EXPECT_NEAR(technique.measure(), mass, 1e-4) << named.name;
            for (int i = 0; i < 64; ++i) {
                const auto s = technique.sample(grid<float>(i, 8));
                EXPECT_GE(s.wi.z, 0) << named.name;
                EXPECT_NEAR(ltc.density(s.wi) / s.pdf, mass, 2e-3) << named.name;
                EXPECT_NEAR(length(s.p - light.center), 1, 1e-4) << named.name;
            }
        }
    }
}

template <class Technique>
void expect_dark(const Technique& technique) {
    EXPECT_EQ(technique.measure(), 0);
    for (int i = 0; i < 16; ++i) {
        const auto s = technique.sample(grid<float>(i, 4));
        EXPECT_EQ(s.pdf, 0);
        EXPECT_EQ(s.wi.z, 1);
    }
}

TEST(ConeClippedLtcTest, LightsBelowTheSurfaceAreDark) {
    // The lobe reaches below the surface, so that ConeLtc sees the first of them.
    const auto ltc = lobe_of<float>(tilted_lobe(1.2L, 0.8L, 1.1L, 0));
    const Sphere<float> below{{-2, 0, -1.2f}, 1};
    EXPECT_GT(unclipped(below, ltc).measure(), 0);
    expect_dark(clipped(below, ltc));
    expect_dark(clipped(Sphere<float>{{0, 0, -1}, 1}, ltc));
    expect_dark(clipped(Disk<float>{{0.5f, 1, -2}, {0, 0, 1}, 1}, ltc));
    expect_dark(clipped(Disk<float>{{0.5f, 1, 2}, {0, 0, 1}, 0}, ltc));
}

} // namespace
} // namespace nusselt_test
