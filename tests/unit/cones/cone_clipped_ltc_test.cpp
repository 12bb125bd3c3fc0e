/// Tests of clipped linearly transformed cosines for spheres, disks, ellipses and ellipsoids: measures, densities and
/// weights where the surface's horizon cuts them, and what must not change where it does not.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/cones/cone_clipped_ltc.h>

#include "cones/lobe_part.h"
#include "cones/round_cases.h"
#include "cones/round_samples.h"
#include "ltc/lobes.h"

namespace nusselt_test {
namespace {

using nusselt::abs;
using nusselt::Disk;
using nusselt::Ellipse;
using nusselt::Ellipsoid;
using nusselt::LtcCoefficients;
using nusselt::Sphere;
using Part = LobePart::Part;
using Side = LobePart::Side;
using nusselt::Vec2;

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

/// Lights and lobes of any inclination.
template <class Function>
void for_each_light(Place place, int count, const Function& f) {
    RandomLights lights(17);
    for (int i = 0; i < count; ++i) {
        for (const Shape shape : kShapes) {
            const RoundLight light = lights(shape, place);
            f(light, random_lobe(lights));
        }
    }
}

LobePart part_of(const RoundLight& light, const LtcCoefficients<long double>& c) {
    return {silhouette_of(light), lobe_of<long double>(c)};
}

/// Calls f(light, lobe, integral of the lobe above the surface) with those of the lights of for_each_light of which the
/// surface leaves something, and cuts off something. Slivers of a millionth are left out, which may vanish by rounding.
/// \return the number of these lights.
template <class Function>
int for_each_cut_light(Place place, int count, const Function& f) {
    int cut = 0;
    for_each_light(place, count, [&](const RoundLight& light, const auto& coefficients) {
        const LobePart part = part_of(light, coefficients);
        if (part.part() != Part::cut || !(part.integral() > 1e-6L * part.whole())) return;
        ++cut;
        f(light, coefficients, static_cast<double>(part.integral()));
    });
    return cut;
}

struct Case {
    const char* name;
    Place place;
    int cut;        ///< lights, at least
    double spread;  ///< of weights around 1
    double measure; ///< relative error
};
// The interpolant is a polynomial but for wide cones, where it is linear between places. Of tiny lights, both horizons
// leave slivers whose heights are a few thousand roundings of the direction of the light.
constexpr Case kCases[] = {
    {"ordinary", Place::ordinary, 10, 0.15, 1e-2},  {"at horizon", Place::at_horizon, 25, 0.15, 1e-2},
    {"tiny", Place::tiny, 15, 1e-3, 2e-4},          {"near", Place::near, 70, 0.3, 2e-2},
    {"elongated", Place::elongated, 8, 0.15, 2e-2}, {"edge-on", Place::edge_on, 6, 5e-3, 1e-4}};

TEST(ConeClippedLtcTest, WeightsAreNearlyConstantAndMeasuresThoseOfContours) {
    for (const Case& c : kCases) {
        double least = 1, most = 1, worst = 0;
        const int cut =
            for_each_cut_light(c.place, 30, [&](const RoundLight& light, const auto& lobe, double exact) {
                const auto ltc = lobe_of<double>(lobe);
                with_light<double>(light, [&](const auto& l) {
                    const auto technique = clipped(l, ltc);
                    ASSERT_GT(technique.measure(), 0) << c.name;
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
        EXPECT_GE(cut, c.cut) << c.name;
        EXPECT_LE(most - 1, c.spread) << c.name;
        EXPECT_GE(least - 1, -c.spread) << c.name;
        EXPECT_LE(worst, c.measure) << c.name;
    }
}

TEST(ConeClippedLtcTest, WeightsOfWideConesAreNearlyConstantWithMorePlaces) {
    double coarse = 0, fine = 0;
    int cut = 0;
    for (const Place place : {Place::near, Place::needle}) {
        cut += for_each_cut_light(place, 30, [&](const RoundLight& light, const auto& lobe, double) {
            const auto ltc = lobe_of<double>(lobe);
            const auto spread = [&](const auto& technique) {
                EXPECT_GT(technique.measure(), 0);
                double largest = 0;
                for (int i = 0; i < 256; ++i) {
                    const auto s = technique.sample(grid<double>(i, 16));
                    largest =
                        std::max(largest, std::fabs(ltc.density(s.wi) / (s.pdf * technique.measure()) - 1));
                }
                return largest;
            };
            with_light<double>(light, [&](const auto& l) {
                coarse = std::max(coarse, spread(clipped(l, ltc)));
                fine = std::max(fine, spread(clipped_finely(l, ltc)));
            });
        });
    }
    EXPECT_GE(cut, 100);
    constexpr double kTarget = 0.02;
    EXPECT_LE(fine, kTarget);
    EXPECT_GT(coarse, kTarget);
}

/// Each horizon alone decides for many lights: it leaves all or nothing of what the other one leaves.
TEST(ConeClippedLtcTest, LightsThatOneHorizonLeavesOrDarkensAreThoseOfTheOtherOne) {
    int count[3][3][3] = {}; // by sides of the lobe's horizon, sides of the surface and parts
    for (const Place place : {Place::ordinary, Place::at_horizon, Place::near, Place::elongated}) {
        for_each_light(place, 60, [&](const RoundLight& light, const auto& coefficients) {
            const LobePart exact = part_of(light, coefficients);
            const Part part = exact.part();
            ++count[static_cast<int>(exact.lobe_side())][static_cast<int>(exact.surface_side())]
                   [static_cast<int>(part)];
            const auto ltc = lobe_of<double>(coefficients);
            with_light<double>(light, [&](const auto& l) {
                const auto technique = clipped(l, ltc);
                const auto other = unclipped(l, ltc);
                if (part == Part::dark) {
                    EXPECT_EQ(technique.measure(), 0);
                    EXPECT_EQ(technique.sample({0.3, 0.6}).pdf, 0);
                    return;
                }
                ASSERT_GT(technique.measure(), 0);
                for (int i = 0; i < 16; ++i) {
                    const auto a = technique.sample(grid<double>(i, 4)), b = other.sample(grid<double>(i, 4));
                    ASSERT_GT(a.pdf, 0);
                    ASSERT_GE(a.wi.z, 0);
                    const bool is_same = a.wi.x == b.wi.x && a.wi.y == b.wi.y && a.wi.z == b.wi.z;
                    ASSERT_EQ(is_same, part == Part::whole);
                }
            });
        });
    }
    const auto of = [&](Side lobe, Side surface, Part part) {
        return count[static_cast<int>(lobe)][static_cast<int>(surface)][static_cast<int>(part)];
    };
    EXPECT_GE(of(Side::above, Side::above, Part::whole), 20);
    EXPECT_GE(of(Side::above, Side::cut, Part::cut), 20);
    EXPECT_GE(of(Side::above, Side::below, Part::dark), 5);
    EXPECT_GE(of(Side::cut, Side::above, Part::whole), 20);
    EXPECT_GE(of(Side::cut, Side::below, Part::dark), 20);
    EXPECT_GE(of(Side::below, Side::above, Part::dark), 5);
    EXPECT_GE(of(Side::below, Side::cut, Part::dark), 20);
    EXPECT_GE(of(Side::cut, Side::cut, Part::cut), 20);
    EXPECT_GE(of(Side::cut, Side::cut, Part::whole), 5);
    EXPECT_GE(of(Side::cut, Side::cut, Part::dark), 2);
}

/// The largest relative difference of densities and the Jacobian of the map from random numbers to directions.
/// \param change of the density.
double jacobian_error(double change) {
    double worst = 0;
    int cut = 0;
    for (const Place place :
         {Place::ordinary, Place::at_horizon, Place::near, Place::elongated, Place::touching}) {
        cut += for_each_cut_light(place, 10, [&](const RoundLight& light, const auto& lobe, double) {
            const auto ltc = lobe_of<double>(lobe);
            with_light<double>(light, [&](const auto& l) {
                const auto technique = clipped(l, ltc);
                ASSERT_GT(technique.measure(), 0);
                for (int i = 0; i < 16; ++i) {
                    const auto u = grid<double>(i, 4);
                    const double found = change * jacobian_at(technique, u) * technique.sample(u).pdf;
                    worst = std::max(worst, std::fabs(found - 1));
                }
            });
        });
    }
    EXPECT_GE(cut, 60);
    return worst;
}

TEST(ConeClippedLtcTest, DensitiesAreThoseOfTheMap) {
    constexpr double kDifferences = 3e-5; // of differences over 2e-5
    EXPECT_LE(jacobian_error(1), kDifferences);
    EXPECT_GT(jacobian_error(1.0001), kDifferences);
}

struct Tolerance {
    double random, ray, light; ///< of random numbers, angles, and distances in units of a light's size
};

/// No sample is below the surface, its point is on its ray and its light, and it leads back to its random numbers.
template <class T>
void expect_valid(const RoundLight& light, const LtcCoefficients<long double>& coefficients,
                  const Tolerance& tolerance) {
    const auto ltc = lobe_of<T>(coefficients);
    with_light<T>(light, [&](const auto& l) {
        const auto technique = clipped(l, ltc);
        ASSERT_GT(technique.measure(), 0);
        for (int i = 0; i < 64; ++i) {
            const auto u = grid<T>(i, 8);
            const auto s = technique.sample(u);
            ASSERT_GE(s.wi.z, 0);
            ASSERT_GE(s.p.z, 0);
            ASSERT_GT(s.pdf, 0);
            ASSERT_EQ(technique.pdf(s.wi), s.pdf);
            ASSERT_GT(dot(s.p, s.wi), 0);
            ASSERT_LE(length(cross(s.p, s.wi)) / length(s.p), tolerance.ray);
            ASSERT_LE(distance_from(light, nusselt::broadcast<double>(s.p)), tolerance.light);
            const auto back = technique.invert(s.wi);
            ASSERT_LE(abs(back.x - u.x), tolerance.random);
            ASSERT_LE(abs(back.y - u.y), tolerance.random);
        }
    });
}

TEST(ConeClippedLtcTest, SamplesAreAboveTheSurfaceAndOnTheLightInEveryPrecision) {
    constexpr Tolerance kFloat{5e-3, 1e-6, 1e-4}, kDouble{1e-9, 1e-15, 1e-12};
    int lit = 0;
    for (const Place place : {Place::ordinary, Place::at_horizon, Place::near}) {
        for_each_light(place, 20, [&](const RoundLight& light, const auto& coefficients) {
            const LobePart part = part_of(light, coefficients);
            if (!(part.integral() > 1e-6L * part.whole())) return;
            ++lit;
            expect_valid<float>(light, coefficients, kFloat);
            expect_valid<double>(light, coefficients, kDouble);
            expect_valid<long double>(light, coefficients, kDouble);
        });
    }
    EXPECT_GE(lit, 120);
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
/// \param distance function of a point to its distance from the light, in units of the light's size.
template <class T, template <class> class Light, class Distance>
void expect_lune(const Light<T>& light, T tolerance, const Distance& distance) {
    for (const NamedLobe& named : wide_lobes()) {
        const auto ltc = lobe_of<T>(named.coefficients);
        const auto normal = ltc.normal_to_cosine({0, 0, 1});
        const T mass = T(0.5) * (1 + normal.z / length(normal));
        const auto technique = clipped(light, ltc);
        EXPECT_NEAR(technique.measure(), mass, 1e-4) << named.name;
        for (int i = 0; i < 64; ++i) {
            const auto s = technique.sample(grid<T>(i, 8));
            EXPECT_GE(s.wi.z, 0) << named.name;
            EXPECT_NEAR(ltc.density(s.wi) / s.pdf, mass, 2e-3) << named.name;
            EXPECT_LE(distance(s.p), tolerance) << named.name;
            EXPECT_LE(length(cross(s.p, s.wi)), tolerance * length(s.p)) << named.name;
        }
    }
}

template <class T>
void expect_lunes(T tolerance) {
    for (const Sphere<T>& light : {Sphere<T>{{0, 0, 0}, 1}, Sphere<T>{{T(0.2), T(-0.3), T(0.6)}, 1},
                                   Sphere<T>{{T(0.2), T(-0.3), T(-0.6)}, 1}})
        expect_lune(light, tolerance, [&](const auto& p) { return abs(length(p - light.center) - 1); });
    for (const T height : {T(0.2), T(-0.3)}) {
        const Ellipsoid<T> light{{T(0.1), 0, height}, {{1, 0, 0}, {0, T(0.5), T(0.1)}, {0, 0, 2}}};
        expect_lune(light, tolerance, [&](const auto& p) {
            const auto offset = p - light.center;
            const T y = offset.y / T(0.5), z = (offset.z - T(0.1) * y) / 2;
            return abs(std::sqrt(offset.x * offset.x + y * y + z * z) - 1);
        });
    }
}

TEST(ConeClippedLtcTest, FromInsideThePartOfTheLobeAboveTheSurfaceLeadsToTheLight) {
    expect_lunes<float>(1e-4f);
    expect_lunes<double>(1e-12);
}

/// A light whose lanes are these lights. A pack lies in memory as an array of its lanes.
template <class T, int Lanes, template <class> class Light>
Light<nusselt::Pack<T, Lanes>> packed(const Light<T> (&lanes)[Lanes]) {
    constexpr std::size_t kNumbers = sizeof(Light<T>) / sizeof(T);
    static_assert(sizeof(Light<nusselt::Pack<T, Lanes>>) == sizeof lanes);
    T numbers[kNumbers * Lanes];
    for (std::size_t lane = 0; lane < Lanes; ++lane) {
        T single[kNumbers];
        std::memcpy(single, &lanes[lane], sizeof single);
        for (std::size_t i = 0; i < kNumbers; ++i) numbers[i * Lanes + lane] = single[i];
    }
    Light<nusselt::Pack<T, Lanes>> result;
    std::memcpy(&result, numbers, sizeof result);
    return result;
}

/// Compares packs in which lanes that the surface cuts, leaves whole and darkens follow each other with scalars.
/// \return the number of packs.
template <class T, template <class> class Light>
int expect_bits_of_scalars(const std::vector<Light<T>> (&lights)[3], const nusselt::Ltc<T>& ltc) {
    constexpr int kLanes = 8;
    using Real = nusselt::Pack<T, kLanes>;
    const std::size_t packs = std::min({lights[0].size(), lights[1].size(), lights[2].size()});
    for (std::size_t k = 0; k < packs; ++k) {
        Light<T> lanes[kLanes];
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const auto& part = lights[(k + lane) % 3];
            lanes[lane] = part[(k + lane / 3) % part.size()];
        }
        const auto technique = clipped(packed(lanes), nusselt::Ltc<Real>(ltc));
        const Vec2<T> u{T(0.3), T(0.8)};
        const auto sample = technique.sample({Real(u.x), Real(u.y)});
        const auto pdf = technique.pdf(sample.wi);
        const auto back = technique.invert(sample.wi);
        for (int lane = 0; lane < kLanes; ++lane) {
            const auto single = clipped(lanes[lane], ltc);
            const auto s = single.sample(u);
            EXPECT_EQ(technique.measure().lane(lane), single.measure());
            EXPECT_EQ(sample.pdf.lane(lane), s.pdf);
            EXPECT_EQ(pdf.lane(lane), single.pdf(s.wi));
            EXPECT_EQ(sample.wi.x.lane(lane), s.wi.x);
            EXPECT_EQ(sample.wi.y.lane(lane), s.wi.y);
            EXPECT_EQ(sample.wi.z.lane(lane), s.wi.z);
            if (!(s.pdf > 0)) continue; // nothing that random numbers or a point could belong to
            EXPECT_EQ(sample.p.x.lane(lane), s.p.x);
            EXPECT_EQ(sample.p.y.lane(lane), s.p.y);
            EXPECT_EQ(sample.p.z.lane(lane), s.p.z);
            EXPECT_EQ(back.x.lane(lane), single.invert(s.wi).x);
            EXPECT_EQ(back.y.lane(lane), single.invert(s.wi).y);
        }
    }
    return static_cast<int>(packs);
}

template <class T, template <class> class Light>
int expect_bits_of_scalars(Shape shape) {
    const auto coefficients = tilted_lobe(0.7L, 0.6L, 0.9L, 0.1L);
    std::vector<Light<T>> lights[3];
    RandomLights random(19);
    for (int i = 0; i < 200; ++i) {
        const RoundLight light = random(shape, Place::at_horizon);
        const Part part = part_of(light, coefficients).part();
        with_light<T>(light, [&](const auto& l) {
            if constexpr (std::is_same_v<std::decay_t<decltype(l)>, Light<T>>)
                lights[static_cast<std::size_t>(part)].push_back(l);
        });
    }
    return expect_bits_of_scalars(lights, lobe_of<T>(coefficients));
}

TEST(ConeClippedLtcTest, PacksThatMixCutWholeAndDarkLightsHaveTheBitsOfScalars) {
    EXPECT_GE((expect_bits_of_scalars<float, Sphere>(Shape::sphere)), 10);
    EXPECT_GE((expect_bits_of_scalars<float, Disk>(Shape::disk)), 10);
    EXPECT_GE((expect_bits_of_scalars<float, Ellipsoid>(Shape::ellipsoid)), 10);
    EXPECT_GE((expect_bits_of_scalars<double, Ellipse>(Shape::ellipse)), 10);
    EXPECT_GE((expect_bits_of_scalars<double, Ellipsoid>(Shape::ellipsoid)), 10);
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

/// The sample of a wide ellipse, closer than a thousandth of its size, that a line of both horizons passes in the middle.
template <class T>
nusselt::LightSample<T> sample_of_wide_ellipse(const Vec2<T>& u) {
    // Both precisions have the numbers of float.
    const auto vector = [](float x, float y, float z) { return nusselt::Vec3<T>{T(x), T(y), T(z)}; };
    const Ellipse<T> light{vector(-7.2114e-4f, 1.60053e-3f, 2.284925e-3f),
                           vector(1.412022f, -0.490028f, -0.0749328f),
                           vector(-0.186836f, -0.368444f, -1.111248f)};
    const nusselt::Ltc<T> ltc({T(0.68521f), T(0.751082f), T(0.263783f), T(-0.848221f), T(0.529642f), T(1)});
    return clipped(light, ltc).sample(u);
}

TEST(ConeClippedLtcTest, FarEndsOfHalfPlanesKeepTheirDigitsInWideCones) {
    // A near end from a difference to the far end would be off by 5e-4 here.
    for (const float x : {0.1f, 0.5f, 0.9f, 0.9999999f})
        for (const float y : {0.5f, 0.9f, 0.9999999f}) {
            const auto single = sample_of_wide_ellipse<float>({x, y});
            const auto exact = sample_of_wide_ellipse<double>({x, y});
            const nusselt::Vec3<double> wi{single.wi.x, single.wi.y, single.wi.z};
            EXPECT_LT(length(wi - exact.wi), 1e-5) << x << " " << y;
        }
}

TEST(ConeClippedLtcTest, SpheresThatTouchTheSurfaceOnTheLineOfBothHorizonsHaveNoSamplesOffTheLight) {
    RandomLights random(23);
    int lit = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto ltc = lobe_of<float>(random_lobe(random));
        const float radius = static_cast<float>(random.logarithmic(0.01, 100));
        for (const float y : {-2.0f, 2.0f})
            for (const float z : {-1.0f, 1.0f}) {
                const Sphere<float> light{{0, y * radius, z * radius}, radius};
                const auto technique = clipped(light, ltc);
                for (int k = 0; k < 4; ++k) {
                    const auto s = technique.sample(grid<float>(k, 2));
                    if (!(s.pdf > 0)) continue;
                    ++lit;
                    ASSERT_LT(length(cross(light.center, s.wi)), 1.00001f * radius);
                }
            }
    }
    EXPECT_GT(lit, 16000);
}

TEST(ConeClippedLtcTest, HalfPlanesThatTouchTheLightLeadBackToWhereTheTurnBegins) {
    int samples = 0;
    for_each_cut_light(Place::ordinary, 100, [&](const RoundLight& light, const auto& lobe, double) {
        const auto ltc = lobe_of<float>(lobe);
        with_light<float>(light, [&](const auto& l) {
            const auto technique = clipped(l, ltc);
            for (const float y : {0.1f, 0.5f, 0.9f}) {
                const auto s = technique.sample({0, y});
                if (!(s.pdf > 0)) continue;
                ++samples;
                ASSERT_LT(technique.invert(s.wi).x, 0.01f);
            }
        });
    });
    EXPECT_GT(samples, 50);
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
