/// Phong lobes along parts of lines, against quadrature in long double.

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/line_samples/phong.h>
#include <nusselt/related/phong_line_billen.h>
#include <nusselt/simd/pack.h>

#include "line_samples/parts.h"

namespace nusselt_test {
namespace {

using nusselt::Interval;
using nusselt::phong_integral;
using nusselt::phong_part;
using nusselt::Vec3;

long double exact_phong(ExactPart part, const Point& mirror, long double exponent) {
    part.split_at(mirror);
    part.split_at_peak(mirror, 1 / std::sqrt(exponent));
    return part.integral([&](const Point& wi) {
        const Point across = cross(mirror, wi);
        const long double squared = dot(across, across);
        if (dot(mirror, wi) <= 0 || squared >= 1 || wi.z <= 0) return 0.0L;
        return (exponent + 2) / (2 * kPi) * std::exp(exponent / 2 * std::log1p(-squared)) * wi.z;
    });
}

/// A mirrored direction whose lobe hits the line: it misses by no more than about the width of the lobe.
template <class T>
Vec3<T> random_mirror(RandomSource& random, const RandomPart<T>& part, double exponent) {
    const Vec3<double> target = nusselt::broadcast<double>(part.point(random.uniform()));
    Vec3<double> mirror =
        normalize(normalize(target) + (2 / std::sqrt(exponent) * random.uniform()) * random.direction());
    mirror.z = std::fabs(mirror.z);
    return normalize(nusselt::broadcast<T>(mirror));
}

/// Errors of a function of a line, an interval, a mirrored direction and an exponent.
struct Errors {
    std::vector<double> to_part, to_line; ///< over the integrals of part and line

    double largest_to_part() const { return *std::max_element(to_part.begin(), to_part.end()); }
    double largest_to_line() const { return *std::max_element(to_line.begin(), to_line.end()); }
    double quantile_to_line(double share) {
        std::sort(to_line.begin(), to_line.end());
        return to_line[static_cast<std::size_t>(share * static_cast<double>(to_line.size() - 1))];
    }
};

template <class T, class Function>
Errors errors_of(const Function& f, double exponent, int cases) {
    RandomSource random(5, static_cast<std::uint64_t>(exponent * 1000));
    Errors errors;
    for (int k = 0; k < cases; ++k) {
        const RandomPart<T> part(random, 3 + k % 6, random.log_between(1, 10), random.log_between(0.1, 8));
        const Vec3<T> mirror = random_mirror(random, part, exponent);
        const auto exact = [&](const Interval<T>& interval) {
            return static_cast<double>(exact_phong(part.exact(interval), to_point(mirror), exponent));
        };
        const double of_line = exact(part.whole);
        const double of_part = exact(part.part);
        if (!(of_line > 1e-30)) continue;
        const double error = std::fabs(static_cast<double>(f(part, part.part, mirror)) - of_part);
        errors.to_line.push_back(error / of_line);
        if (of_part > 1e-30) errors.to_part.push_back(error / of_part);
    }
    // Half of the lights face away.
    EXPECT_GT(static_cast<int>(errors.to_part.size()), cases / 8);
    return errors;
}

constexpr double kExponents[] = {1, 1.5, 2, 3, 4.7, 10, 33.3, 100, 1000, 1e4, 1e5, 1e6};

template <class T>
auto with_exponent(double exponent) {
    return [=](const RandomPart<T>& line, const Interval<T>& part, const Vec3<T>& mirror) {
        return phong_part(line.cosine(), part, mirror, static_cast<T>(exponent));
    };
}

TEST(PhongPart, EqualsQuadratureInDouble) {
    for (const double exponent : kExponents) {
        const Errors errors = errors_of<double>(with_exponent<double>(exponent), exponent, 600);
        EXPECT_LT(errors.largest_to_part(), 1e-7) << exponent;
        // Lobes end smoothly unless the exponent is small and not an integer.
        if (exponent != 1.5) {
            EXPECT_LT(errors.largest_to_part(), 1e-9) << exponent;
        }
    }
}

TEST(PhongPart, TestRejectsAnotherExponent) {
    for (const double exponent : kExponents)
        EXPECT_GT(
            errors_of<double>(with_exponent<double>(exponent * (1 + 1e-5)), exponent, 600).largest_to_part(),
            1e-7)
            << exponent;
}

// Rounding turns directions by 1e-7, which matters more for narrower lobes. It also moves lights that are seen
// edge-on.
TEST(PhongPart, EqualsQuadratureInFloat) {
    for (const double exponent : kExponents) {
        Errors errors = errors_of<float>(with_exponent<float>(exponent), exponent, 600);
        EXPECT_LT(errors.quantile_to_line(0.5), 3e-7) << exponent;
        EXPECT_LT(errors.quantile_to_line(0.9), 4e-8 * std::sqrt(exponent) + 2e-6) << exponent;
        EXPECT_LT(errors.largest_to_line(), 5e-4) << exponent;
    }
}

TEST(PhongPart, LambertianForExponentZero) {
    RandomSource random(8);
    for (int k = 0; k < 100; ++k) {
        const RandomPart<double> part(random, 4, 2, 1);
        const Vec3<double> mirror{0, 0, 1};
        const double lambertian = nusselt::diffuse_part(part.cosine(), part.part);
        EXPECT_NEAR(phong_part(part.cosine(), part.part, mirror, 0.0), lambertian, 1e-13 * lambertian);
    }
}

TEST(PhongPart, PacksEqualScalars) {
    using Pack = nusselt::Pack<float, 8>;
    RandomSource random(9);
    for (int k = 0; k < 200; ++k) {
        nusselt::LineSegment<Pack> lines{};
        Vec3<Pack> mirrors{};
        Pack exponents{};
        float expected[8];
        for (int i = 0; i < 8; ++i) {
            const RandomPart<float> part(random, 5, random.log_between(1, 10), 2);
            const float exponent = static_cast<float>(random.log_between(1, 1e5));
            const Vec3<float> mirror = random_mirror(random, part, 10);
            const auto line = nusselt::segment_of(part.family.plane(), part.offset, part.part);
            expected[i] = phong_integral(line, mirror, exponent);
            lines.p0.x.set_lane(i, line.p0.x), lines.p0.y.set_lane(i, line.p0.y),
                lines.p0.z.set_lane(i, line.p0.z);
            lines.s.x.set_lane(i, line.s.x), lines.s.y.set_lane(i, line.s.y), lines.s.z.set_lane(i, line.s.z);
            lines.length.set_lane(i, line.length);
            mirrors.x.set_lane(i, mirror.x), mirrors.y.set_lane(i, mirror.y), mirrors.z.set_lane(i, mirror.z);
            exponents.set_lane(i, exponent);
        }
        const Pack integral = phong_integral(lines, mirrors, exponents);
        for (int i = 0; i < 8; ++i) EXPECT_EQ(integral.lane(i), expected[i]);
    }
}

TEST(Phong, AlbedoIsReachedAtNormalIncidence) {
    const QuadratureRule rule = gauss_legendre(100);
    for (const double exponent : {0.0, 1.0, 2.5, 20.0, 300.0}) {
        const nusselt::Phong<double> phong({0, 0, 1}, {0.5, 1, 0}, exponent);
        double red = 0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double z = static_cast<double>(rule.nodes[i]);
            const Vec3<double> wi{std::sqrt(1 - z * z), 0, z};
            red += 2 * static_cast<double>(kPi * rule.weights[i]) * z * phong.eval(wi).x;
        }
        EXPECT_NEAR(red, 0.5, 1e-6) << exponent;
    }
}

TEST(Phong, IsAPowerOfTheCosineWithTheMirroredDirection) {
    RandomSource random(3);
    for (int k = 0; k < 1000; ++k) {
        const Vec3<double> wo = random.direction();
        const Vec3<double> wi = random.direction();
        const double exponent = random.log_between(1, 100);
        const double cosine = -wo.x * wi.x - wo.y * wi.y + wo.z * wi.z;
        const double value = nusselt::Phong<double>(wo, {1, 1, 1}, exponent).eval(wi).y;
        if (cosine <= 0 || wi.z <= 0 || wo.z <= 0) {
            EXPECT_EQ(value, 0);
        } else {
            const double expected = (exponent + 2) / 6.283185307179586 * std::pow(cosine, exponent);
            EXPECT_NEAR(value, expected, 1e-12 * expected + 1e-300);
        }
    }
}

// The published method only takes integer exponents and loses digits by cancellation.
TEST(PhongLineBillen, RecursionEqualsQuadrature) {
    for (const int exponent : {1, 2, 3, 10, 100, 1001}) {
        const nusselt::CosinePowerRecursion<double> power(exponent + 2);
        const auto f = [&](const RandomPart<double>& line, const Interval<double>& part,
                           const Vec3<double>& mirror) {
            const auto seen = line.cosine();
            const double cosine = 2 * static_cast<double>(kPi) * seen.factor * (seen.distance / seen.stretch);
            return 0.5 * cosine *
                   nusselt::phong_integral_billen(nusselt::segment_of(line.family.plane(), line.offset, part),
                                                  mirror, exponent, power);
        };
        EXPECT_LT(errors_of<double>(f, exponent, 600).quantile_to_line(0.9), 1e-11) << exponent;
    }
}

TEST(PhongLineBillen, TableConvergesToTheRecursion) {
    for (const int exponent : {1, 20, 999, 10000}) {
        const nusselt::CosinePowerRecursion<double> exact(exponent);
        const nusselt::CosinePowerTable<double, 256> coarse(exponent);
        const nusselt::CosinePowerTable<double, 1024> fine(exponent);
        double coarse_error = 0;
        double fine_error = 0;
        const double total = exact(1.5707963267948966);
        for (int i = -1000; i <= 1000; ++i) {
            const double u = 1.5707963 * i / 1000;
            coarse_error = std::max(coarse_error, std::fabs(coarse(u) - exact(u)) / total);
            fine_error = std::max(fine_error, std::fabs(fine(u) - exact(u)) / total);
        }
        EXPECT_LT(fine_error, coarse_error / 4) << exponent;
        EXPECT_LT(fine_error, 1e-4) << exponent;
    }
}

} // namespace
} // namespace nusselt_test
