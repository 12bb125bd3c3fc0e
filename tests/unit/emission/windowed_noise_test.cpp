/// The noise of one sample without shadows, for lights whose radiance depends on the direction.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/emission/spread.h>

#include "emission/windowed_lights.h"

namespace nusselt_test {
namespace {

using nusselt::Frame;
using nusselt::Vec2;
using nusselt::WindowedPolygon;
using Vector = nusselt::Vec3<double>;
using Cells8 = WindowedPolygon<float, 8>;
using Cells4 = WindowedPolygon<float, 4>;

double sky(const Vector& w) {
    const double alpha = std::atan2(w.x, w.z), beta = std::atan2(w.y, w.z);
    return 0.4 + 0.6 * std::max(dot(w, normalize(Vector{0.1, 1, 0.3})), 0.0) +
           (std::sin(9 * alpha) * std::sin(7 * beta) > 0.5 ? 0.2 : 0);
}
double sky_and_sun(const Vector& w) {
    const bool is_sun = dot(w, normalize(Vector{0.35, 0.45, 1})) > std::cos(nusselt::kPi<double> / 180);
    return sky(w) + (is_sun ? 3000 : 0);
}

/// Sampling of a rectangle that knows nothing of its radiance.
class CosineOnly {
public:
    CosineOnly(const nusselt::WindowPlane<float>& plane, const nusselt::WindowedLight<float>& light)
        : frame_(plane.frame),
          technique_(
              nusselt::rectangle_in<float>({plane.corner, frame_.t, frame_.b, cross(frame_.t, frame_.b)},
                                           light.outline.vertex[0], light.outline.vertex[2])) {}

    nusselt::WindowSample<float> sample(const Vec2<float>& u) const {
        const auto s = technique_.sample(u);
        const auto w = frame_.to_local(s.wi);
        const auto at = [&](float x) { return std::atan(x / w.z) / nusselt::kPi<float> + 0.5f; };
        return {s, {at(w.x), at(w.y)}};
    }

private:
    Frame<float> frame_;
    nusselt::PolygonProjectedSolidAngle<float, 4> technique_;
};

/// Root mean square over views of the relative standard deviation.
struct Noise {
    double squares = 0;
    int views = 0;

    void add(const Estimates& estimates) {
        squares += std::max(estimates.relative_variance(), 0.0);
        ++views;
    }
    double value() const { return std::sqrt(squares / views); }
};

/// Estimates of radiance(sample, direction in the world) times cosine.
template <class Technique, class Radiance>
Estimates estimates_of(const Technique& technique, const Frame<float>& frame, int samples,
                       const Radiance& radiance) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 0.9999999f);
    Estimates estimates;
    for (int k = 0; k < samples; ++k) {
        const float x = uniform(random);
        const auto s = technique.sample({x, uniform(random)});
        estimates.add(s.pdf > 0 ? radiance(s, frame.to_world(s.wi)) *
                                      static_cast<double>(std::max(s.wi.z, 0.0f)) / s.pdf
                                : 0);
    }
    return estimates;
}

void report(const std::string& what, double noise) { std::printf("%s: noise %.4f\n", what.c_str(), noise); }

/// A portal of 2 x 2, from points 0.5 to 3 behind it that see all of it above their horizon.
template <class Technique, class Radiance>
double portal_noise(const nusselt::RectifiedTable<float>& table, const Radiance& radiance) {
    const auto vertices = rectangle_at<float>(0, -1, 1, -1, 1);
    const auto light = portal_of(vertices, table);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::normal_distribution<float> normal;
    Noise noise;
    while (noise.views < 24) {
        const float x = 3 * uniform(random) - 1.5f, y = 3 * uniform(random) - 1.5f;
        const nusselt::Vec3<float> point{x, y, -0.5f - 2.5f * uniform(random)};
        const float across = normal(random), along = normal(random);
        const auto frame = Frame<float>::from_normal(
            normalize(nusselt::Vec3<float>{across, along, std::fabs(normal(random)) + 0.3f}));
        bool is_above = true;
        for (const auto& v : vertices) is_above = is_above && dot(frame.n, v - point) > 0;
        if (!is_above) continue;
        const Technique technique(to_shading_space(light.plane, point, frame), light);
        noise.add(estimates_of(technique, frame, 400, radiance));
    }
    return noise.value();
}

TEST(WindowedNoise, OfPortals) {
    for (const bool has_sun : {false, true}) {
        const TexelMap map(512, [&](const Vector& w) { return has_sun ? sky_and_sun(w) : sky(w); });
        const auto texels = table_of<float>(map);
        const auto at_texel = [&](const auto& s, const auto&) { return map.at_position(s.at); };
        const auto interpolated = [&](const auto&, const auto& w) { return map.interpolated(w); };
        const RefinedTable<float> refined([&](const auto& w) { return grey<float>(map.interpolated(w)); },
                                          map.size);
        auto plain = refined.table;
        plain.refined.count = 0;
        const double of_texels = portal_noise<Cells8>(texels.table, at_texel);
        const double of_means = portal_noise<Cells8>(plain, interpolated);
        const std::string name = has_sun ? "sky and sun" : "sky";
        const double of_cosine = portal_noise<CosineOnly>(texels.table, at_texel);
        report(name + ", projected solid angle", of_cosine);
        EXPECT_GT(of_cosine, 3 * of_texels);
        report(name + ", texels, 8 x 8", of_texels);
        report(name + ", texels, 4 x 4", portal_noise<Cells4>(texels.table, at_texel));
        report(name + ", bilinear, 8 x 8", of_means);
        const double of_refined = portal_noise<Cells8>(refined.table, interpolated);
        report(name + ", bilinear, refined, 8 x 8", of_refined);
        EXPECT_LE(of_refined, has_sun ? 0.065 : 0.06);
        EXPECT_EQ(refined.table.refined.count > 0, has_sun);
        EXPECT_LE(of_texels, has_sun ? 0.05 : 0.06);
        EXPECT_LE(of_means, has_sun ? 0.3 : 0.06);
    }
}

/// What the light of 1 x 1 in the plane z = 0 gives to a point, by the midpoint rule.
/// \param reach slope beyond which the light is black, \param radiance function of the direction away from the light
template <class Radiance>
double irradiance(const Vector& point, const Vector& normal, double reach, const Radiance& radiance) {
    constexpr int kSteps = 200;
    const auto low = [&](double x) { return std::clamp(x - reach * point.z, 0.0, 1.0); };
    const auto high = [&](double x) { return std::clamp(x + reach * point.z, 0.0, 1.0); };
    const Vector begin{low(point.x), low(point.y), 0};
    const Vector step = (1.0 / kSteps) * (Vector{high(point.x), high(point.y), 0} - begin);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const Vector way = point - begin - Vector{(i + 0.5) * step.x, (j + 0.5) * step.y, 0};
            const Vector away = normalize(way);
            sum += radiance(away) * away.z * std::max(-dot(away, normal), 0.0) / dot(way, way);
        }
    }
    return sum * step.x * step.y;
}

/// A light of 1 x 1 from points around its axis. Those in the dark do not count.
/// \param expected irradiance, function of point and normal
template <class Technique, class Radiance, class Expected>
double profile_noise(const nusselt::RectifiedTable<float>& table, double distance,
                     const std::vector<Vector>& directions, const Radiance& radiance,
                     const Expected& expected) {
    const auto vertices = rectangle_at<float>(0, 0, 1, 0, 1);
    const auto light = nusselt::make_profiled_light(upright<float>(), vertices.data(), 4, table);
    Noise noise;
    for (const Vector& d : directions) {
        const Vector point = Vector{0.5, 0.5, 0} + distance * normalize(d);
        const auto frame = Frame<float>::from_normal(
            nusselt::broadcast<float>(-normalize(Vector{0.3 * d.x, 0.3 * d.y, d.z})));
        const Technique technique(to_shading_space(light.plane, nusselt::broadcast<float>(point), frame),
                                  light);
        const Estimates estimates = estimates_of(technique, frame, 1500, radiance);
        const double mean = expected(point, nusselt::broadcast<double>(frame.n));
        if (mean == 0) {
            EXPECT_EQ(estimates.mean(), 0);
            continue;
        }
        EXPECT_TRUE(estimates.agrees_with(mean, 0.01)) << estimates.mean() << ' ' << mean;
        noise.add(estimates);
    }
    EXPECT_GT(noise.views, 0);
    return noise.value();
}

TEST(WindowedNoise, OfProfiles) {
    const auto beam = [](const Vector& w) {
        const double spill = w.z > 0.2 ? 0.02 : 0;
        return (w.z > std::cos(12 * nusselt::kPi<double> / 180) ? 1 : spill) / std::max(w.z, 0.02);
    };
    const auto batwing = [](const Vector& w) {
        const double angle = std::acos(std::min(w.z, 1.0)) * 180 / nusselt::kPi<double> - 50;
        return w.z > 0.05 ? (0.3 + std::exp(-angle * angle / 144)) / w.z : 0;
    };
    const auto honeycomb = [](const Vector& w) { return nusselt::Honeycomb<double>{{0.2, 0.2}}.share(w); };
    const std::vector<Vector> directions = {{0.02, 0.01, 1}, {0.15, 0.1, 1}, {0.3, 0.1, 1}, {0.6, 0.3, 1}};
    struct Row {
        const char* name;
        TexelMap map;
        std::vector<double> distances, budgets;
        std::vector<Vector> directions;
    };
    const std::vector<Row> rows = {
        {"beam", {512, beam}, {0.5, 1, 10}, {0.03, 0.01, 0.005}, directions},
        {"batwing", {256, batwing}, {0.5, 1, 10}, {0.08, 0.05, 0.01}, directions},
        {"honeycomb", {512, honeycomb}, {1, 3}, {0.06, 0.02}, {directions[0], directions[1]}},
    };
    for (const Row& row : rows) {
        const auto stored = table_of<float>(row.map);
        const auto at_texel = [&](const auto& s, const auto&) { return row.map.at_position(s.at); };
        const auto expected = [&](const Vector& point, const Vector& normal) {
            return irradiance(point, normal, 1e9, row.map);
        };
        for (std::size_t k = 0; k < row.distances.size(); ++k) {
            const double distance = row.distances[k];
            const double noise =
                profile_noise<Cells8>(stored.table, distance, row.directions, at_texel, expected);
            const double coarse =
                profile_noise<Cells4>(stored.table, distance, row.directions, at_texel, expected);
            const double of_cosine =
                profile_noise<CosineOnly>(stored.table, distance, row.directions, at_texel, expected);
            report(row.name + std::string(" at ") + std::to_string(row.distances[k]) +
                       ", projected solid angle",
                   of_cosine);
            EXPECT_GT(of_cosine, 3 * noise);
            report(row.name + std::string(" at ") + std::to_string(row.distances[k]) + ", 8 x 8", noise);
            report(row.name + std::string(" at ") + std::to_string(row.distances[k]) + ", 4 x 4", coarse);
            EXPECT_LE(noise, row.budgets[k]) << row.name;
        }
    }
}

/// Down to one degree, a grid in front of a light adds hardly any noise to that of a constant light, which is zero.
TEST(WindowedNoise, OfSpread) {
    const std::vector<Vector> directions = {{0.005, 0.002, 1}, {0.1, 0.05, 1}, {0.2, -0.3, 1}};
    for (const double degrees : {1.0, 5.0, 20.0, 60.0}) {
        const auto slope = static_cast<float>(std::tan(degrees * nusselt::kPi<double> / 180));
        const nusselt::Honeycomb<float> honeycomb{{slope, slope}};
        const nusselt::RadialSpread<float> radial{slope};
        const auto measure = [&](const char* name, const auto& spread) {
            const StoredTable<float> stored([&](const auto& w) { return grey<float>(spread.share(w)); },
                                            spread.domain(), 128, 128, 2);
            const auto of_sample = [&](const auto&, const nusselt::Vec3<float>& w) {
                return static_cast<double>(spread.share(-w));
            };
            const auto expected = [&](const Vector& point, const Vector& normal) {
                return irradiance(point, normal, double{slope}, [&](const Vector& away) {
                    return static_cast<double>(spread.share(nusselt::broadcast<float>(away)));
                });
            };
            for (const double distance : {0.5, 1.0, 3.0}) {
                const double noise =
                    profile_noise<Cells8>(stored.table, distance, directions, of_sample, expected);
                report(std::string(name) + " " + std::to_string(degrees) + " at " + std::to_string(distance),
                       noise);
                // The wider the grid, the more of the noise is that of 8 x 8 cells close to the light.
                EXPECT_LE(noise, degrees < 45 ? 0.06 : 0.1) << name;
            }
        };
        measure("honeycomb", honeycomb);
        measure("radial", radial);
    }
}

} // namespace
} // namespace nusselt_test
