/// Densities of spheres, disks, ellipses and ellipsoids integrate to one over the exact light, and are those of the samples. At full
/// effort, each class has 1e4 lights.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/cones/cone_clipped_solid_angle.h>
#include <nusselt/cones/rim_distribution.h>
#include <nusselt/cones/rim_map.h>

#include "common/effort.h"
#include "cones/direction_integral.h"
#include "cones/lobe_image.h"
#include "cones/round_cases.h"
#include "ltc/reference.h"

namespace nusselt_test {
namespace {

using nusselt::ConeClippedSolidAngle;
using nusselt::ConeLtc;
using nusselt::ConeProjectedSolidAngle;
using nusselt::ConeSolidAngle;
using nusselt::Ltc;
using nusselt::LtcCoefficients;
using nusselt::Vec2;
using nusselt::Vec3;
using nusselt::hostile::exact_light;

constexpr LtcCoefficients<double> kLobe{0.375, -0.125, 0.5, 0.0625, 0.875, 1}; // exact in float

template <class T>
LtcCoefficients<T> lobe_in() {
    const auto entry = [](double x) { return static_cast<T>(x); };
    return {entry(kLobe.m00), entry(kLobe.m02), entry(kLobe.m11), entry(kLobe.m20), entry(kLobe.m22), 1};
}

/// The density of the turn around the pole at the nodes of an interpolant.
template <class T, class Density>
struct AtNodes {
    const nusselt::RimMap<T>& map;
    const Density& density;

    template <class Nodes>
    void operator()(T (&value)[Nodes::kNodes]) const {
        for (int i = 0; i < Nodes::kNodes; ++i) value[i] = density(map, Nodes::node(i));
    }
};

/// By which share an interpolant that is taken as 0 where it dips below zero exceeds its integral, by which it is divided.
/// \param density of (RimMap, z), which is interpolated.
template <int Places, class T, class Density>
double dip_of(const nusselt::EllipticCone<T>& cone, const Density& density) {
    const nusselt::RimMap<T> map(cone);
    if (!map.is_lit(cone)) return 0;
    const nusselt::RimDistribution<T, Places> rim(AtNodes<T, Density>{map, density});
    if (rim.is_exact()) return 0;
    const auto value = [&](long double z) {
        return static_cast<long double>(rim.value(static_cast<T>(z))) / rim.integral();
    };
    // Dips are next to the ends.
    constexpr int kPanels = 400;
    const auto edge = [](int i) { return -std::cos(kPi * i / kPanels); };
    long double sum = 0;
    for (int i = 0; i < kPanels; ++i) sum += adaptive_integral(value, edge(i), edge(i + 1), 1e-13L, 20);
    return static_cast<double>(sum - 1);
}

/// \name Techniques: how they are made, over which directions their densities integrate to one, and dips of interpolants.
/// @{
struct BySolidAngle {
    static constexpr const char* kName = "solid angle";
    static constexpr bool kHasFewPlaces = false;

    template <class T, template <class> class Light>
    static auto make(const Light<T>& light) {
        return ConeSolidAngle<T, Light>(light);
    }
    template <class Light>
    static DirectionRegion region(const Light& exact) {
        return DirectionRegion(exact, DirectionRegion::Part::all);
    }
    /// The density of pdf(wi) in the space of the region.
    template <class Pdf>
    static long double density(const Pdf& pdf, const Point& wi) {
        return pdf(wi);
    }
    template <class Light>
    static double dip(const Light&) {
        return 0; // linear between places
    }
};

constexpr auto kCosineDensity = [](const auto& map, auto z) { return map.density(map.turned(z)); };

template <int Places>
struct ByProjectedSolidAngle : BySolidAngle {
    static constexpr const char* kName =
        Places == nusselt::kConePlaces ? "projected solid angle" : "projected solid angle, many places";
    static constexpr bool kHasFewPlaces = Places == nusselt::kConePlaces;

    template <class T, template <class> class Light>
    static auto make(const Light<T>& light) {
        return ConeProjectedSolidAngle<T, Light, nusselt::kConeSteps<T>, Places>(light);
    }
    template <class Light>
    static DirectionRegion region(const Light& exact) {
        return DirectionRegion(exact, DirectionRegion::Part::above_horizon);
    }
    template <class Light>
    static double dip(const Light& light) {
        return dip_of<Places>(view_of(light, nusselt::detail::SameSpace()).cone, kCosineDensity);
    }
};

template <int Places>
struct ByClippedSolidAngle : ByProjectedSolidAngle<Places> {
    static constexpr const char* kName =
        Places == nusselt::kConePlaces ? "clipped solid angle" : "clipped solid angle, many places";

    template <class T, template <class> class Light>
    static auto make(const Light<T>& light) {
        return ConeClippedSolidAngle<T, Light, Places>(light);
    }
    template <class Light>
    static double dip(const Light& light) {
        // As in solid_sweep.h.
        const auto density = [](const auto& map, auto w) {
            return (1 - w) * (1 + w) * map.solid_density(map.turned(w * (3 - w * w) / 2));
        };
        return dip_of<Places>(view_of(light, nusselt::detail::SameSpace()).cone, density);
    }
};

struct ByLobe {
    static constexpr const char* kName = "lobe, many places";
    static constexpr bool kHasFewPlaces = false;

    template <class T, template <class> class Light>
    static auto make(const Light<T>& light) {
        return ConeLtc<T, Light, nusselt::kConeSteps<T>, nusselt::kFineConePlaces>(light,
                                                                                   Ltc<T>(lobe_in<T>()));
    }
    template <class Light>
    static DirectionRegion region(const Light& exact) {
        return DirectionRegion(image_of(exact, ReferenceLobe(kLobe)), DirectionRegion::Part::above_horizon);
    }
    template <class Pdf>
    static long double density(const Pdf& pdf, const Point& cosine) {
        // The inverse of the rows by cross products.
        const ReferenceLobe lobe(kLobe);
        const auto row = [&](const Point& axis) { return lobe.image(axis); };
        const Point x = row({1, 0, 0}), y = row({0, 1, 0}), z = row({0, 0, 1});
        const long double determinant = lobe.determinant();
        const Point back = (1 / determinant) * Point{dot(cross(y, z), cosine), dot(cross(z, x), cosine),
                                                     dot(cross(x, y), cosine)};
        const long double r = length(back);
        return pdf((1 / r) * back) / (determinant * r * r * r);
    }
    template <template <class> class Light, class T>
    static double dip(const Light<T>& light) {
        const Ltc<T> ltc(lobe_in<T>());
        const auto cone = view_of(light, [&](const auto& v) { return ltc.to_cosine(v); }).cone;
        return dip_of<nusselt::kFineConePlaces>(cone, kCosineDensity);
    }
};
/// @}

/// Calls f(light) with the light that rounded numbers describe after each of them has changed by a share of itself.
template <class Light, class Function>
void for_each_neighbour(const Light& light, double share, const Function& f) {
    using T = std::decay_t<decltype(light.center.x)>;
    constexpr std::size_t kNumbers = sizeof(Light) / sizeof(T);
    for (std::size_t i = 0; i < kNumbers; ++i) {
        T number[kNumbers];
        std::memcpy(number, &light, sizeof light);
        number[i] += number[i] * static_cast<T>(share);
        Light changed;
        std::memcpy(&changed, number, sizeof light);
        f(exact_light(changed));
    }
}

/// The light in double.
inline nusselt::Sphere<double> in_double(const nusselt::Sphere<float>& l) {
    return {nusselt::broadcast<double>(l.center), l.radius};
}
inline nusselt::Disk<double> in_double(const nusselt::Disk<float>& l) {
    return {nusselt::broadcast<double>(l.center), normalize(nusselt::broadcast<double>(l.normal)), l.radius};
}
inline nusselt::Ellipse<double> in_double(const nusselt::Ellipse<float>& l) {
    return {nusselt::broadcast<double>(l.center), nusselt::broadcast<double>(l.u),
            nusselt::broadcast<double>(l.v)};
}
inline nusselt::Ellipsoid<double> in_double(const nusselt::Ellipsoid<float>& l) {
    return {nusselt::broadcast<double>(l.center),
            {nusselt::broadcast<double>(l.axis[0]), nusselt::broadcast<double>(l.axis[1]),
             nusselt::broadcast<double>(l.axis[2])}};
}
template <template <class> class Light>
const Light<double>& in_double(const Light<double>& light) {
    return light;
}

/// How far rounding of the numbers of a light may move the integral.
template <class T, class Technique, class Light>
double explained_error(const Light& light) {
    // Few for float: of slivers at the horizon, one rounding moves the rim by a large part of what is left.
    constexpr double kRoundings = std::is_same_v<T, float> ? 1 : 64;
    const double share = kRoundings * static_cast<double>(std::numeric_limits<T>::epsilon());
    // In double: the noise of float exceeds the differences.
    const auto wide = in_double(light);
    const auto technique = Technique::make(wide);
    const auto integral = [&](const auto& exact) {
        const auto pdf = [&](const Point& wi) {
            return static_cast<long double>(technique.pdf(nusselt::broadcast<double>(wi)));
        };
        return Technique::region(exact).integral([&](const Point& wi) { return Technique::density(pdf, wi); },
                                                 1e-10L);
    };
    const long double here = integral(exact_light(wide));
    double sum = 0;
    for_each_neighbour(wide, share, [&](const auto& neighbour) {
        sum += std::fabs(static_cast<double>(integral(neighbour) - here)) / (2 * kRoundings);
    });
    return sum;
}

/// The error of an integral that needs no explanation.
template <class T>
constexpr double kSmallError = std::is_same_v<T, float> ? 1e-5 : 1e-10;
/// The same for a technique. With few places, some lights take linear interpolants, of which quadrature over directions misses
/// corners.
template <class T, class Technique>
constexpr double small_error() {
    return !std::is_same_v<T, float> && Technique::kHasFewPlaces ? 1e-6 : kSmallError<T>;
}
/// Of quadrature. Corners of linear interpolants mislead its estimate of the error; in float, more would integrate noise.
template <class T>
constexpr double kTolerance = kSmallError<T> / (std::is_same_v<T, float> ? 30 : 300);

struct Errors {
    std::vector<double> error; ///< of the integral
    double excess = 0;         ///< the largest error over its bound
    double dip = 0;            ///< the largest one where an error needs it as an explanation
};

/// Larger errors are due to a dip of the interpolant, or to the rounding of the light.
/// \param scale of densities, which should be 1.
template <class T, class Technique>
Errors errors_of(Place place, int lights, double scale) {
    Errors errors;
    RandomLights random(29);
    const double base = small_error<T, Technique>();
    for (int i = 0; i < lights; ++i) {
        with_light<T>(random(kShapes[i % 4], place), [&](const auto& light) {
            const auto technique = Technique::make(light);
            const auto region = Technique::region(exact_light(light));
            // Of less, the number type has no digits.
            if (region.is_empty() || !(technique.measure() > std::numeric_limits<T>::min() * 1000)) return;
            const auto pdf = [&](const Point& wi) {
                return static_cast<long double>(technique.pdf(nusselt::broadcast<T>(wi)));
            };
            const auto error_with = [&](double tolerance) {
                const auto integral = static_cast<double>(
                    region.integral([&](const Point& wi) { return Technique::density(pdf, wi); }, tolerance));
                return std::fabs(integral * scale - 1);
            };
            double error = error_with(kTolerance<T>);
            // Quadrature may have missed a corner.
            if (error > base) error = error_with(kTolerance<T> / 10);
            errors.error.push_back(error);
            double bound = base;
            if (error > bound) {
                const double dip = Technique::dip(light);
                errors.dip = std::max(errors.dip, dip);
                bound += dip;
            }
            if (error > bound) bound = std::max(bound, 10 * explained_error<T, Technique>(light));
            errors.excess = std::max(errors.excess, error / bound);
        });
    }
    std::sort(errors.error.begin(), errors.error.end());
    return errors;
}

struct Class {
    const char* name;
    Place place;
};
constexpr Class kClasses[] = {{"ordinary", Place::ordinary}, {"at the horizon", Place::at_horizon},
                              {"far", Place::tiny},          {"near", Place::near},
                              {"edge-on", Place::edge_on},   {"elongated", Place::elongated}};

template <class T, class Technique>
void expect_unit_integrals(int lights) {
    for (const Class& c : kClasses) {
        const Errors errors = errors_of<T, Technique>(c.place, lights, 1);
        ASSERT_FALSE(errors.error.empty()) << c.name;
        EXPECT_LE(errors.excess, 1) << Technique::kName << ", " << c.name;
        const auto at = [&](double share) {
            const auto i = static_cast<std::size_t>(share * static_cast<double>(errors.error.size()));
            return errors.error[std::min(i, errors.error.size() - 1)];
        };
        if (at_effort(false, true))
            std::printf("| %s | %s | %zu | %.0e / %.0e / %.0e | %.0e | %.2f |\n", Technique::kName, c.name,
                        errors.error.size(), at(0.5), at(0.99), at(1), errors.dip, errors.excess);
    }
}

template <class T>
void expect_unit_integrals() {
    const int lights = at_effort(16, 10'000);
    expect_unit_integrals<T, BySolidAngle>(lights);
    expect_unit_integrals<T, ByProjectedSolidAngle<nusselt::kConePlaces>>(lights);
    expect_unit_integrals<T, ByProjectedSolidAngle<nusselt::kFineConePlaces>>(lights);
    expect_unit_integrals<T, ByClippedSolidAngle<nusselt::kConePlaces>>(lights);
    expect_unit_integrals<T, ByClippedSolidAngle<nusselt::kFineConePlaces>>(lights);
    expect_unit_integrals<T, ByLobe>(lights);
}

TEST(ConeDensityTest, FloatIntegratesToOne) { expect_unit_integrals<float>(); }

TEST(ConeDensityTest, DoubleIntegratesToOne) { expect_unit_integrals<double>(); }

TEST(ConeDensityTest, DensitiesThatAreOffByTwiceTheBoundAreRejected) {
    using Technique = ByProjectedSolidAngle<nusselt::kFineConePlaces>;
    EXPECT_GT((errors_of<float, Technique>(Place::ordinary, 8, 1 + 2e-5).excess), 1);
    EXPECT_GT((errors_of<double, Technique>(Place::ordinary, 8, 1 + 2e-10).excess), 1);
}

/// The largest difference from 1 of the density times the area that a sample has per area of random numbers.
/// \tparam Other the technique whose density is taken.
template <class Technique, class Other>
std::vector<double> jacobian_errors(int lights) {
    std::vector<double> errors;
    RandomLights random(31);
    for (const Class& c : kClasses) {
        if (c.place == Place::tiny) continue; // differences of unit vectors lose all digits
        for (int i = 0; i < lights; ++i) {
            with_light<long double>(random(kShapes[i % 4], c.place), [&](const auto& light) {
                const auto technique = Technique::make(light);
                const auto other = Other::make(light);
                if (!(technique.measure() > 1e-4L)) return;
                constexpr long double kStep = 1e-4L;
                const Vec2<long double> u{random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)};
                const auto slope = [&](long double x, long double y) {
                    const auto difference = [&](long double steps) {
                        const long double step = steps * kStep;
                        return technique.sample({u.x + step * x, u.y + step * y}).wi -
                               technique.sample({u.x - step * x, u.y - step * y}).wi;
                    };
                    return 1 / (12 * kStep) * (8.0L * difference(1) - difference(2));
                };
                const long double area = length(cross(slope(1, 0), slope(0, 1)));
                errors.push_back(
                    std::fabs(static_cast<double>(area * other.pdf(technique.sample(u).wi) - 1)));
            });
        }
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

template <class Technique, class Other>
bool are_densities_of_samples(int lights) {
    const std::vector<double> errors = jacobian_errors<Technique, Other>(lights);
    // The others are next to corners of interpolants and to the axis, where differences are coarse.
    return errors[errors.size() / 2] <= 1e-9 && errors[errors.size() * 9 / 10] <= 1e-6;
}

TEST(ConeDensityTest, DensitiesAreThoseOfTheSamples) {
    using Few = ByProjectedSolidAngle<nusselt::kConePlaces>;
    using Many = ByProjectedSolidAngle<nusselt::kFineConePlaces>;
    const int lights = at_effort(16, 2000);
    EXPECT_TRUE((are_densities_of_samples<BySolidAngle, BySolidAngle>(lights)));
    EXPECT_TRUE((are_densities_of_samples<Few, Few>(lights)));
    EXPECT_TRUE((are_densities_of_samples<Many, Many>(lights)));
    using Clipped = ByClippedSolidAngle<nusselt::kConePlaces>;
    EXPECT_TRUE((are_densities_of_samples<Clipped, Clipped>(lights)));
    EXPECT_TRUE((are_densities_of_samples<ByLobe, ByLobe>(lights)));
}

/// They integrate to one as well.
TEST(ConeDensityTest, DensitiesOfOtherTechniquesAreRejected) {
    using Few = ByProjectedSolidAngle<nusselt::kConePlaces>;
    EXPECT_FALSE((are_densities_of_samples<Few, BySolidAngle>(4)));
    EXPECT_FALSE((are_densities_of_samples<BySolidAngle, Few>(4)));
}

} // namespace
} // namespace nusselt_test
