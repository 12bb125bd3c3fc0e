/// Tests of the accuracy of samples of cones that the horizon cuts: the random numbers that belong exactly to a sample, by
/// quadrature over the same cone in double, differ from those it was made of by the backward error. At full effort, the test prints
/// the table of docs/techniques/elliptic_cone.md.

#include <algorithm>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/cones/cone_clipped_ltc.h>

#include "common/effort.h"
#include "cones/lobe_part.h"
#include "cones/round_cases.h"

namespace nusselt_test {
namespace {

using nusselt::ConeSweep;
using nusselt::EllipticCone;
using nusselt::LuneMap;
using nusselt::LuneSweep;
using nusselt::RimMap;
using nusselt::Vec2;

/// x - sin(2x) / 2, whose terms cancel for small x.
double cycloid_volume(double x) {
    return x < 0.1
               ? x * x * x *
                     (2.0 / 3 -
                      x * x * (2.0 / 15 - x * x * (4.0 / 315 - x * x * (2.0 / 2835 - x * x * 4 / 155925))))
               : x - std::sin(2 * x) / 2;
}

/// The share of the measure of a half-plane that is nearer to the pole than a direction.
double way_of(const RimMap<double>& map, const nusselt::Vec3<double>& wi, double z) {
    const auto rim = map.angle_of(map.turned(z).rim);
    const double angle = std::atan2(std::hypot(dot(wi, map.h()), wi.z), dot(wi, map.p()));
    return cycloid_volume(angle) / cycloid_volume(rim.value);
}
double way_of(const LuneMap<double>& map, const nusselt::Vec3<double>& wi, double z) {
    const auto turn = map.turned(z);
    const double gamma = std::atan2(std::hypot(dot(wi, map.h()), wi.z), dot(wi, map.pole()));
    // The integral of the squared sine from the near end.
    const auto swept = [&](double angle) {
        const double lever = std::sin(turn.near_gamma + angle / 2);
        return cycloid_volume(angle / 2) + std::sin(angle) * lever * lever;
    };
    return swept(std::clamp(gamma - turn.near_gamma, 0.0, turn.angle)) / swept(turn.angle);
}

/// The share of the sweep's measure up to any place of the rim.
template <class Map>
class ExactSweep {
public:
    explicit ExactSweep(const Map& map) : map_(map), below_(kPanels + 1) {
        for (int i = 0; i < kPanels; ++i)
            below_[static_cast<std::size_t>(i) + 1] =
                below_[static_cast<std::size_t>(i)] + integral(edge(i), edge(i + 1));
    }

    double measure() const { return below_.back() * map_.scale(); }

    /// The random numbers to which a direction belongs.
    Vec2<double> invert(const nusselt::Vec3<double>& wi) const {
        const double z = map_.place_of(wi);
        const int panel =
            std::clamp(static_cast<int>(std::acos(-z) / static_cast<double>(kPi) * kPanels), 0, kPanels - 1);
        const double turn = below_[static_cast<std::size_t>(panel)] + integral(edge(panel), z);
        return {turn / below_.back(), way_of(map_, wi, z)};
    }

private:
    static constexpr int kPanels = 96;

    /// Panels become narrow at the ends, where densities of near lights change fast.
    static double edge(int i) { return -std::cos(static_cast<double>(kPi) * i / kPanels); }

    double integral(double begin, double end) const {
        static const QuadratureRule rule = gauss_legendre(16);
        double sum = 0;
        for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
            const double z = begin + (end - begin) * static_cast<double>(rule.nodes[k]);
            sum += static_cast<double>(rule.weights[k]) * map_.density(map_.turned(z));
        }
        return sum * (end - begin);
    }

    Map map_;
    std::vector<double> below_;
};

constexpr int kSamples = 16; ///< of each light

struct Errors {
    std::vector<double> turn, way, measure; ///< the largest of each light
    int exact = 0;                          ///< lights with constant weights
    int undecided = 0;                      ///< lights that touch the surface's horizon within rounding
};

double quantile(std::vector<double>& values, double share) {
    const auto at =
        std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

/// The errors of the random numbers of a sample. Unit vectors of float do not resolve tiny lights, points of the disk do not resolve
/// slivers at the horizon: this takes the point, the point with the height of the direction, and the direction, and the one with the
/// smallest error counts. What is left is not due to the rounding of results.
template <class Map, class T>
Vec2<double> error_of(const ExactSweep<Map>& exact, const EllipticCone<double>& cone,
                      const nusselt::ConeSample<T>& sample, const Vec2<T>& u) {
    const auto wi = nusselt::broadcast<double>(sample.wi);
    const auto of_disk = normalize(cone.direction(nusselt::broadcast<double>(sample.disk)));
    Vec2<double> least{1, 1};
    for (const auto& direction :
         {of_disk, normalize(nusselt::Vec3<double>{of_disk.x, of_disk.y, wi.z}), wi}) {
        const Vec2<double> found = exact.invert(direction);
        least.x = std::min(least.x, std::fabs(found.x - static_cast<double>(u.x)));
        least.y = std::min(least.y, std::fabs(found.y - static_cast<double>(u.y)));
    }
    return least;
}

/// Adds the errors of a cone.
/// \param broken makes wrong random numbers of right ones.
template <class T, class Sweep, class Map, class Broken>
void add_errors(Errors& errors, RandomLights& random, const EllipticCone<T>& cone, const Sweep& sweep,
                const ExactSweep<Map>& exact, const Broken& broken) {
    double turn = 0, way = 0;
    bool is_constant = true;
    for (int k = 0; k < kSamples; ++k) {
        const Vec2<T> u{static_cast<T>(random.uniform(0, 1)), static_cast<T>(random.uniform(0, 1))};
        const auto s = sweep.sample(broken(u));
        const Vec2<double> error = error_of(exact, nusselt::broadcast<double>(cone), s, u);
        turn = std::max(turn, error.x);
        way = std::max(way, error.y);
        const double weight = static_cast<double>(sweep.density_per_cosine(s.wi) * sweep.measure());
        is_constant = is_constant && std::fabs(weight - 1) < 1e-6;
    }
    errors.turn.push_back(turn);
    errors.way.push_back(way);
    errors.measure.push_back(std::fabs(static_cast<double>(sweep.measure()) / exact.measure() - 1));
    if (is_constant) ++errors.exact;
}

/// Of cones that the horizon cuts.
/// \tparam Places of the rim.
template <class Float, int Places>
struct CutByTheHorizon {
    using Scalar = Float;
    template <class Broken, class Light>
    static void add(Errors& errors, RandomLights& random, const Light& light, const Broken& broken) {
        const EllipticCone<Float> cone = view_of(light, nusselt::detail::SameSpace()).cone;
        const ConeSweep<Float, Places> sweep(cone);
        if (!(sweep.measure() > 0)) return;
        const ExactSweep exact(RimMap<double>(nusselt::broadcast<double>(cone)));
        add_errors(errors, random, cone, sweep, exact, broken);
    }
};

/// Of lights in the cosine space of a lobe that the horizon of the surface cuts.
template <class Float, int Places>
struct CutByTheSurface {
    using Scalar = Float;
    template <class Broken, class Light>
    static void add(Errors& errors, RandomLights& random, const Light& light, const Broken& broken) {
        const auto ltc = lobe_of<Float>(random_lobe(random));
        const nusselt::Vec3<Float> normal = normalize(ltc.normal_to_cosine({0, 0, 1}));
        const EllipticCone<Float> cone = view_of(light, [&](const auto& v) { return ltc.to_cosine(v); }).cone;
        const LuneMap<Float> map(cone, normal);
        if (!map.is_clipped()) return;
        const LuneSweep<Float, Places> sweep(map, cone.is_visible);
        const LuneMap<double> exact_map(nusselt::broadcast<double>(cone), nusselt::broadcast<double>(normal));
        // Within rounding, both precisions disagree on whether a plane touches a cone.
        if (!exact_map.is_clipped()) {
            ++errors.undecided;
            return;
        }
        ASSERT_GT(sweep.measure(), 0);
        add_errors(errors, random, cone, sweep, ExactSweep(exact_map), broken);
    }
};

template <class Sweep, class Broken>
Errors errors_of(Place place, int lights, const Broken& broken) {
    Errors errors;
    RandomLights random(17);
    for (const Shape shape : kShapes) {
        if (place == Place::needle && (shape == Shape::disk || shape == Shape::sphere)) continue;
        for (int i = 0; i < lights; ++i)
            with_light<typename Sweep::Scalar>(
                random(shape, place), [&](const auto& light) { Sweep::add(errors, random, light, broken); });
    }
    return errors;
}

/// Upper bounds at 50, 99 and 99.9 % of the lights: of the error in the turn around the pole, of that in the way from the pole, of the
/// relative error of the measure; and a lower bound of the share of lights with constant weights. Quick effort has too few lights
/// to tell the last two quantiles apart: 99 % of them are within three times the last bound.
struct Row {
    const char* name;
    Place place;
    double turn[3], way[3], measure[3];
    double constant;
};

constexpr double kShares[] = {0.5, 0.99, 0.999};

bool are_within(std::vector<double>& errors, const double (&bounds)[3], double (&found)[3]) {
    for (int i = 0; i < 3; ++i) found[i] = quantile(errors, kShares[i]);
    if (at_effort(true, false)) return found[0] <= bounds[0] && found[1] <= 3 * bounds[2];
    return found[0] <= bounds[0] && found[1] <= bounds[1] && found[2] <= bounds[2];
}

template <class Sweep, class Broken>
bool are_within(const Row& row, const Broken& broken) {
    Errors errors = errors_of<Sweep>(row.place, at_effort(80, 4000), broken);
    EXPECT_GE(errors.turn.size(), 20u) << row.name;
    EXPECT_LE(errors.undecided, 1 + static_cast<int>(errors.turn.size() / 100)) << row.name;
    double turn[3], way[3], measure[3];
    const bool turns = are_within(errors.turn, row.turn, turn), ways = are_within(errors.way, row.way, way),
               measures = are_within(errors.measure, row.measure, measure);
    const double constant = static_cast<double>(errors.exact) / static_cast<double>(errors.turn.size());
    if (at_effort(false, true))
        std::printf("| %s | %zu | %.0e / %.0e / %.0e | %.0e / %.0e / %.0e | %.0e / %.0e / "
                    "%.0e | %.0f %% |\n",
                    row.name, errors.turn.size(), turn[0], turn[1], turn[2], way[0], way[1], way[2],
                    measure[0], measure[1], measure[2], 100 * constant);
    return turns && ways && measures && constant >= row.constant;
}

using InFloat = CutByTheHorizon<float, nusselt::kFineConePlaces>;
using InDouble = CutByTheHorizon<double, nusselt::kFineConePlaces>;

const auto kRight = [](const auto& u) { return u; };

constexpr Row kOrdinary = {"ordinary",         Place::ordinary,    {3e-07, 1e-06, 1e-05},
                           {1e-6, 3e-6, 3e-5}, {4e-7, 1e-6, 2e-6}, 0.9};

TEST(ConeBackwardErrorTest, FloatIsWithinItsBounds) {
    constexpr Row kRows[] = {
        kOrdinary,
        {"at the horizon",
         Place::at_horizon,
         {3e-07, 1e-06, 1e-05},
         {1e-6, 3e-6, 3e-5},
         {4e-7, 1e-6, 2e-6},
         0.9},
        {"tiny, at the horizon",
         Place::tiny,
         {3e-07, 1e-06, 1e-05},
         {1e-6, 4e-6, 3e-5},
         {4e-7, 1e-6, 2e-6},
         0.9},
        {"seen edge-on", Place::edge_on, {3e-07, 4e-06, 1e-05}, {1e-6, 1e-5, 4e-5}, {4e-7, 1e-6, 2e-6}, 0.9},
        {"near", Place::near, {3e-07, 1e-06, 1e-05}, {1e-6, 2e-6, 1e-5}, {4e-7, 1e-6, 2e-6}, 0.8},
        {"elongated", Place::elongated, {3e-07, 1e-06, 1e-05}, {1e-6, 5e-6, 3e-5}, {4e-7, 1e-6, 2e-6}, 0.9},
        {"touching", Place::touching, {4e-07, 4e-06, 0.4}, {1e-6, 3e-6, 1e-5}, {4e-7, 3e-6, 0.4}, 0.8},
        {"needles", Place::needle, {4e-07, 2e-05, 2e-4}, {1e-6, 2e-5, 8e-5}, {4e-7, 8e-6, 2e-4}, 0.8}};
    for (const Row& row : kRows) EXPECT_TRUE(are_within<InFloat>(row, kRight)) << row.name;
}

TEST(ConeBackwardErrorTest, DoubleIsWithinItsBounds) {
    constexpr Row kRows[] = {
        {"ordinary",
         Place::ordinary,
         {1e-15, 3e-14, 2e-13},
         {6e-15, 8e-14, 4e-13},
         {1e-15, 4e-15, 8e-15},
         0.99},
        {"at the horizon",
         Place::at_horizon,
         {1e-15, 2e-14, 3e-13},
         {6e-15, 5e-14, 8e-13},
         {1e-15, 4e-15, 8e-15},
         0.99},
        {"tiny, at the horizon",
         Place::tiny,
         {2e-11, 8e-10, 8e-9},
         {4e-11, 2e-9, 1e-8},
         {1e-15, 4e-15, 8e-15},
         0.99},
        {"seen edge-on",
         Place::edge_on,
         {2e-15, 8e-12, 3e-11},
         {1e-14, 2e-11, 4e-11},
         {1e-15, 4e-15, 8e-15},
         0.99},
        {"near", Place::near, {1e-15, 4e-12, 1e-8}, {2e-15, 2e-14, 4e-14}, {1e-15, 4e-15, 4e-13}, 0.99},
        {"elongated",
         Place::elongated,
         {1e-15, 1e-13, 8e-13},
         {6e-15, 3e-13, 2e-12},
         {1e-15, 4e-15, 8e-15},
         0.99},
        {"touching", Place::touching, {1e-15, 1e-6, 0.4}, {1e-15, 2e-14, 4e-14}, {1e-15, 3e-8, 0.4}, 0.9},
        {"needles", Place::needle, {2e-14, 2e-5, 2e-4}, {2e-14, 1e-12, 1e-11}, {1e-15, 4e-6, 2e-4}, 0.85}};
    for (const Row& row : kRows) EXPECT_TRUE(are_within<InDouble>(row, kRight)) << row.name;
}

TEST(ConeBackwardErrorTest, TurnsThatAreOffByAMillionthAreRejected) {
    EXPECT_TRUE(are_within<InFloat>(kOrdinary, kRight));
    EXPECT_FALSE(are_within<InFloat>(kOrdinary, [](const auto& u) {
        return Vec2<float>{u.x + 1e-6f * (1 - u.x), u.y};
    }));
}

TEST(ConeBackwardErrorTest, WaysThatAreOffByFourMillionthsAreRejected) {
    EXPECT_FALSE(are_within<InFloat>(kOrdinary, [](const auto& u) {
        return Vec2<float>{u.x, u.y + 4e-6f * (1 - u.y)};
    }));
}

template <int Places, int Count>
void expect_within(const Row (&rows)[Count]) {
    for (const Row& row : rows)
        EXPECT_TRUE((are_within<CutByTheSurface<float, Places>>(row, kRight))) << row.name;
}

/// Three times what was measured.
constexpr Row kFineRowsAtSurface[] = {{"ordinary, 64 places",
                                       Place::ordinary,
                                       {6e-07, 2e-05, 3e-04},
                                       {9e-07, 2e-05, 1e-04},
                                       {9e-07, 9e-06, 2e-04},
                                       0.65},
                                      {"at the horizon, 64 places",
                                       Place::at_horizon,
                                       {6e-07, 1e-05, 9e-05},
                                       {9e-07, 1e-05, 9e-05},
                                       {9e-07, 9e-06, 3e-05},
                                       0.64},
                                      {"tiny, 64 places",
                                       Place::tiny,
                                       {9e-07, 3e-05, 2e-04},
                                       {1e-06, 2e-05, 6e-04},
                                       {1e-06, 1e-05, 6e-05},
                                       0.78},
                                      {"seen edge-on, 64 places",
                                       Place::edge_on,
                                       {6e-07, 2e-05, 1e-04},
                                       {9e-07, 1e-05, 3e-04},
                                       {9e-07, 1e-05, 6e-05},
                                       0.65},
                                      {"near, 64 places",
                                       Place::near,
                                       {6e-07, 2e-05, 3e-04},
                                       {6e-07, 6e-06, 2e-05},
                                       {6e-07, 2e-05, 3e-04},
                                       0.67},
                                      {"elongated, 64 places",
                                       Place::elongated,
                                       {6e-07, 2e-05, 2e-04},
                                       {9e-07, 2e-05, 6e-05},
                                       {9e-07, 1e-05, 6e-05},
                                       0.64},
                                      {"touching, 64 places",
                                       Place::touching,
                                       {9e-07, 3e-04, 3e-02},
                                       {9e-07, 3e-04, 1e-03},
                                       {9e-07, 9e-04, 2e-02},
                                       0.61},
                                      {"needles, 64 places",
                                       Place::needle,
                                       {6e-07, 1e-04, 2e-01},
                                       {9e-07, 1e-05, 3e-04},
                                       {9e-07, 3e-05, 2e-01},
                                       0.64}};
constexpr Row kRowsAtSurface[] = {{"ordinary, 16 places",
                                   Place::ordinary,
                                   {9e-07, 9e-05, 3e-02},
                                   {9e-07, 2e-05, 1e-04},
                                   {9e-07, 2e-05, 1e-02},
                                   0.40},
                                  {"at the horizon, 16 places",
                                   Place::at_horizon,
                                   {1e-06, 3e-04, 3e-02},
                                   {9e-07, 1e-05, 9e-05},
                                   {9e-07, 6e-05, 1e-02},
                                   0.30},
                                  {"tiny, 16 places",
                                   Place::tiny,
                                   {9e-07, 3e-05, 2e-04},
                                   {1e-06, 2e-05, 6e-04},
                                   {1e-06, 1e-05, 6e-05},
                                   0.77},
                                  {"seen edge-on, 16 places",
                                   Place::edge_on,
                                   {9e-07, 9e-05, 3e-02},
                                   {9e-07, 1e-05, 3e-04},
                                   {9e-07, 2e-05, 1e-02},
                                   0.46},
                                  {"near, 16 places",
                                   Place::near,
                                   {2e-05, 3e-02, 3e-02},
                                   {6e-07, 6e-06, 2e-05},
                                   {2e-06, 2e-02, 2e-02},
                                   0.00},
                                  {"elongated, 16 places",
                                   Place::elongated,
                                   {9e-07, 6e-04, 3e-02},
                                   {9e-07, 2e-05, 6e-05},
                                   {9e-07, 9e-05, 1e-02},
                                   0.34},
                                  {"touching, 16 places",
                                   Place::touching,
                                   {6e-05, 6e-02, 9e-02},
                                   {9e-07, 3e-04, 1e-03},
                                   {9e-06, 2e-02, 3e-02},
                                   0.00},
                                  {"needles, 16 places",
                                   Place::needle,
                                   {2e-06, 6e-02, 2e-01},
                                   {9e-07, 2e-05, 6e-04},
                                   {2e-06, 2e-02, 2e-01},
                                   0.22}};

TEST(ConeBackwardErrorTest, LightsThatTheSurfaceCutsAreWithinTheirBoundsInFloat) {
    expect_within<nusselt::kFineConePlaces>(kFineRowsAtSurface);
    expect_within<nusselt::kConePlaces>(kRowsAtSurface);
}

TEST(ConeBackwardErrorTest, RandomNumbersOfLightsThatTheSurfaceCutsThatAreOffByFourMillionthsAreRejected) {
    using Sweep = CutByTheSurface<float, nusselt::kFineConePlaces>;
    EXPECT_FALSE(are_within<Sweep>(kFineRowsAtSurface[0], [](const auto& u) {
        return Vec2<float>{u.x + 4e-6f * (1 - u.x), u.y};
    }));
    EXPECT_FALSE(are_within<Sweep>(kFineRowsAtSurface[0], [](const auto& u) {
        return Vec2<float>{u.x, u.y + 4e-6f * (1 - u.y)};
    }));
}

} // namespace
} // namespace nusselt_test
