/// Tests that line samples have the mean that quadrature predicts, for all lights, surfaces and shadows, and that
/// they converge as in one dimension. Estimators with a mistake have the wrong mean.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/estimate/reflected_offsets.h>
#include <nusselt/line_samples/triangle_shadow.h>
#include <nusselt/random/light_random.h>

#include "least_squares.h"
#include "reflected_light.h"
#include "replicates.h"

namespace nusselt_test {
namespace {

using nusselt::BrdfComponents;
using nusselt::ConvexPolygon;
using nusselt::Interval;
using nusselt::LineChoice;
using nusselt::LineFamily;
using nusselt::LineLight;
using nusselt::ReflectedOffsets;
using nusselt::Sampler;
using nusselt::Vec2;
using nusselt::VisibleParts;
using Reflected = ReflectedLight<ConvexPolygon<double, 4>>;

constexpr double kAngle = 0.7;
constexpr int kCapacity = 4;

/// Relative slack of a mean. A shadow or another edge on a line puts a step into a one-dimensional net, and the rare
/// samples next to it cause an error that the replicates seldom show.
constexpr double kSlack = 5e-4;

double sum_of(const BrdfComponents<double>& c) { return sum_of_channels(c.diffuse + c.specular); }

double bound_on_coordinates(const ConvexPolygon<double, 4>& light) {
    double sum = 0;
    for (const auto& edge : light.edge) sum += length(edge);
    return sum;
}

/// Lines of one light over one surface.
struct Lines {
    explicit Lines(const Reflected& reflected)
        : surface(reflected.surface),
          family(reflected.light, kAngle),
          light(family.plane(), bound_on_coordinates(reflected.light), surface),
          reflected_offsets(family, light) {}
    Lines(const Lines&) = delete;
    Lines& operator=(const Lines&) = delete;

    Surface surface;
    LineFamily<double, 4> family;
    LineLight<double> light;
    ReflectedOffsets<double, 4> reflected_offsets;
};

/// The part of a line that half_shadow() leaves.
Interval<double> free_part(const Lines& lines, double offset) {
    const auto& plane = lines.family.plane();
    Interval<double> part = lines.family.chord(offset).extent;
    const double begin = dot(kFree, plane.origin + offset * plane.across);
    const double slope = dot(kFree, plane.along);
    (slope > 0 ? part.begin : part.end) = std::clamp(-begin / slope, part.begin, part.end);
    return part;
}

/// The mean of f(visible parts) in the half shadow, which only removes a share of the light.
template <class Estimate>
double in_half_shadow(const Lines& lines, double offset, const Estimate& estimate) {
    Interval<double> storage[kCapacity];
    VisibleParts<double> parts(storage, kCapacity);
    parts.reset(free_part(lines, offset));
    const double in_light = estimate(parts);
    parts.reset(lines.family.chord(offset).extent);
    return (1 - kTransmitted) * in_light + kTransmitted * estimate(parts);
}

/// p-values, one for each combination of light and surface.
/// \param choose   picks a line, given a random number.
/// \param estimate estimates the light of the parts of a line at an offset, given a random number.
template <class Choose, class Estimate>
std::vector<double> p_values_of(const std::vector<Reflected>& list, const Choose& choose,
                                const Estimate& estimate) {
    std::vector<double> p_values;
    for (const Reflected& reflected : list) {
        const Lines lines(reflected);
        const auto means = means_of([&](const auto& next) {
            const Vec2<double> u = next();
            const LineChoice<double> choice = choose(lines, u.x);
            if (!(choice.pdf > 0)) return 0.0;
            const auto light_of = [&](const VisibleParts<double>& parts) {
                return estimate(lines, choice.offset, parts, u.y);
            };
            return in_half_shadow(lines, choice.offset, light_of) / choice.pdf;
        });
        const double slack = kSlack * reflected.truth + 3 * static_cast<double>(kQuadratureTolerance);
        p_values.push_back(student_t_test(means, reflected.truth, slack));
    }
    return p_values;
}

const auto kByLength = [](const Lines& lines, double u) { return lines.family.sample_by_length(u); };
const auto kUniform = [](const Lines& lines, double u) { return lines.family.sample_uniform(u); };
const auto kByReflected = [](const Lines& lines, double u) { return lines.reflected_offsets.sample(u); };

const auto kUnbiased = [](const Lines& lines, double offset, const VisibleParts<double>& parts, double u) {
    return sum_of(lines.light.unbiased(offset, parts, u));
};
const auto kAnalytic = [](const Lines& lines, double offset, const VisibleParts<double>& parts,
                          double /*u*/) { return sum_of(lines.light.analytic(offset, parts)); };

template <class Choose>
testing::AssertionResult is_unbiased(const std::vector<Reflected>& list, const Choose& choose) {
    const auto p_values = p_values_of(list, choose, kUnbiased);
    if (!reject(p_values)) return testing::AssertionSuccess();
    const auto worst = std::min_element(p_values.begin(), p_values.end());
    return testing::AssertionFailure()
           << "p = " << *worst << ": " << list[static_cast<std::size_t>(worst - p_values.begin())].name;
}

TEST(LineLightMeans, AreUnbiased) {
    const auto rough = reflected_polygons(surfaces({0.5, 1}));
    EXPECT_TRUE(is_unbiased(rough, kUniform));
    EXPECT_TRUE(is_unbiased(rough, kByLength));
    EXPECT_TRUE(is_unbiased(rough, kByReflected));
    // Few lines sampled by length would meet these highlights.
    EXPECT_TRUE(is_unbiased(reflected_polygons(surfaces({0.2})), kByReflected));
}

TEST(LineLightMeans, MistakesAreFound) {
    const auto list = reflected_polygons(surfaces({0.5}));
    EXPECT_TRUE(reject(p_values_of(list, kByLength, kAnalytic)))
        << "analytic shading alone, without a sample of the BRDF";
    const auto without_albedo = [](const Lines& lines, double offset, const VisibleParts<double>& parts,
                                   double u) {
        Surface white = lines.surface;
        white.specular_albedo = {1, 1, 1};
        const LineLight<double> light(lines.family.plane(), lines.family.reach(), white);
        return kUnbiased(lines, offset, parts, u) - kAnalytic(lines, offset, parts, u) +
               sum_of(light.analytic(offset, parts));
    };
    EXPECT_TRUE(reject(p_values_of(list, kByLength, without_albedo))) << "integral without albedo";
    const auto wrong_density = [](const Lines& lines, double u) {
        const auto choice = lines.reflected_offsets.sample(u);
        return LineChoice<double>{choice.offset,
                                  0.5 * (choice.pdf + lines.family.pdf_by_length(choice.offset))};
    };
    EXPECT_TRUE(reject(p_values_of(list, wrong_density, kUnbiased))) << "density mixed with that by length";
}

/// A tilted square, a triangle in front of a part of it, and a surface seen at 0.9 rad from its normal.
class Penumbra {
public:
    Penumbra(double roughness, bool is_metal, bool is_shadowed)
        : lines_({"", surface(roughness, is_metal), square(), nullptr, 0}), is_shadowed_(is_shadowed) {
        const auto frame = make_shadow_frame(lines_.family.plane(), {0, 0, 0});
        shadow_ = make_triangle_shadow(frame, {-0.9, -0.1, 0.6}, {-0.7, 0.6, 0.9}, {-0.3, 0.4, 0.5}).shadow;
        constexpr int kLines = 200'000;
        for (int i = 0; i < kLines; ++i) {
            const double golden = i * 0.6180339887498949;
            const auto choice = lines_.family.sample_by_length((i + 0.5) / kLines);
            analytic_ += analytic(choice) / kLines;
            unbiased_ += unbiased(choice, golden - std::floor(golden)) / kLines;
        }
    }

    double analytic(const LineChoice<double>& choice) const {
        return with_parts(choice,
                          [&](const auto& parts) { return kAnalytic(lines_, choice.offset, parts, 0); });
    }
    double unbiased(const LineChoice<double>& choice, double u) const {
        return with_parts(choice,
                          [&](const auto& parts) { return kUnbiased(lines_, choice.offset, parts, u); });
    }

    const Lines& lines() const { return lines_; }
    double mean_analytic() const { return analytic_; }
    double mean_unbiased() const { return unbiased_; }

private:
    static ConvexPolygon<double, 4> square() {
        const Direction centre{-1.4, 0.1, 1.1};
        const Direction across = normalize(Direction{1, 0.2, 0.35});
        const Direction up = normalize(cross(Direction{0.45, 0, -1}, across));
        const Direction vertices[] = {centre - 0.8 * across - 0.8 * up, centre + 0.8 * across - 0.8 * up,
                                      centre + 0.8 * across + 0.8 * up, centre - 0.8 * across + 0.8 * up};
        return nusselt::make_polygon<4>(vertices, 4);
    }
    static Surface surface(double roughness, bool is_metal) {
        static const ShippedTable table("ltc-frostbite.bin");
        const Direction albedo = is_metal ? Direction{0, 0, 0} : Direction{0.5, 0.5, 0.5};
        const Direction f0 = is_metal ? Direction{1, 1, 1} : Direction{0.04, 0.04, 0.04};
        return nusselt::make_glossy_surface<double>(std::cos(0.9), albedo, f0, roughness, table.view());
    }

    template <class Estimate>
    double with_parts(const LineChoice<double>& choice, const Estimate& estimate) const {
        Interval<double> storage[kCapacity];
        VisibleParts<double> parts(storage, kCapacity);
        parts.reset(lines_.family.chord(choice.offset).extent);
        if (is_shadowed_) parts.cut(hidden_interval(shadow_, choice.offset));
        return estimate(parts) / choice.pdf;
    }

    Lines lines_;
    bool is_shadowed_;
    nusselt::TriangleShadow<double> shadow_;
    double analytic_ = 0;
    double unbiased_ = 0;
};

struct Convergence {
    double order; ///< exponent of the number of lines in the standard deviation, for 16 to 1024 lines
    double error; ///< relative standard deviation for 16 lines
};

/// \param line computes a value of an estimator from two random numbers.
template <class Line>
Convergence convergence(const std::string& name, double truth, Sampler sampler, const Line& line) {
    constexpr std::uint32_t kTrials = 200;
    std::vector<double> x, y;
    for (std::uint32_t count = 16; count <= 1024; count *= 4) {
        double squares = 0;
        for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
            double sum = 0;
            for (std::uint32_t k = 0; k < count; ++k)
                sum += line(nusselt::light_random<double>(sampler, 3, trial, 5, k, count, 0));
            squares += (sum / count - truth) * (sum / count - truth) / kTrials;
        }
        x.push_back(std::log(count));
        y.push_back(0.5 * std::log(squares));
    }
    const Convergence result{slope_of(x, y), std::exp(y[0]) / truth};
    std::printf("%-50s order %.2f, error of 16 lines %.5f\n", name.c_str(), result.order, result.error);
    return result;
}

TEST(LineLightConvergence, HasTheOrderOfOneDimension) {
    for (const bool is_shadowed : {false, true}) {
        for (const double roughness : {0.3, 0.5}) {
            const Penumbra light(roughness, true, is_shadowed);
            const auto& family = light.lines().family;
            const std::string name =
                "roughness " + std::to_string(roughness).substr(0, 3) + (is_shadowed ? ", shadow, " : ", ");
            const auto analytic = [&](const Vec2<double>& u) {
                return light.analytic(family.sample_by_length(u.x));
            };
            const auto unbiased = [&](const Vec2<double>& u) {
                return light.unbiased(family.sample_by_length(u.x), u.y);
            };
            const auto by_reflected = [&](const Vec2<double>& u) {
                return light.unbiased(light.lines().reflected_offsets.sample(u.x), u.y);
            };
            // In theory, the order for stratified lines is -1.5 if the integrand is smooth and -1 if it jumps. The
            // points on lines of the unbiased estimate add noise as in two dimensions, but little of it.
            EXPECT_LT(convergence(name + "analytic", light.mean_analytic(), Sampler::sobol, analytic).order,
                      is_shadowed ? -1.1 : -1.3);
            const Convergence of_unbiased =
                convergence(name + "unbiased", light.mean_unbiased(), Sampler::sobol, unbiased);
            EXPECT_LT(of_unbiased.order, -0.9);
            // The lines cause less noise, so the points make up more of the remaining noise.
            const Convergence of_reflected = convergence(name + "unbiased, by reflected light",
                                                         light.mean_unbiased(), Sampler::sobol, by_reflected);
            EXPECT_LT(of_reflected.order, -0.75);
            EXPECT_LT(of_reflected.error, 0.7 * of_unbiased.error);
            EXPECT_NEAR(convergence(name + "analytic, independent", light.mean_analytic(),
                                    Sampler::independent, analytic)
                            .order,
                        -0.5, 0.1);
        }
    }
}

/// The relative noise of the unbiased estimate for given lines.
double conditional_noise(const Penumbra& light) {
    constexpr std::uint32_t kLines = 200;
    constexpr std::uint32_t kPointsPerLine = 64;
    double variance = 0;
    for (std::uint32_t i = 0; i < kLines; ++i) {
        const auto choice = light.lines().family.sample_by_length((i + 0.5) / kLines);
        double sum = 0;
        double squares = 0;
        for (std::uint32_t k = 0; k < kPointsPerLine; ++k) {
            const double value = light.unbiased(choice, (k + 0.5) / kPointsPerLine);
            sum += value / kPointsPerLine;
            squares += value * value / kPointsPerLine;
        }
        variance += (squares - sum * sum) / kLines;
    }
    return std::sqrt(variance) / light.mean_unbiased();
}

TEST(LineLightNoise, OfPointsOnLinesIsSmall) {
    for (const double roughness : {0.1, 0.2, 0.3, 0.5, 0.8}) {
        for (const bool is_metal : {false, true}) {
            const Penumbra light(roughness, is_metal, true);
            const double noise = conditional_noise(light);
            std::printf("roughness %.1f, %s: %.4f, bias of analytic %+.2f %%\n", roughness,
                        is_metal ? "metal" : "plastic", noise,
                        100 * (light.mean_analytic() / light.mean_unbiased() - 1));
            EXPECT_LT(noise, 0.045);
            EXPECT_GT(noise, 1e-4);
        }
    }
}

} // namespace
} // namespace nusselt_test
