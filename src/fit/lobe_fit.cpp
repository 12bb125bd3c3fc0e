#include "fit/lobe_fit.h"

#include <nusselt/bsdf/frostbite.h>

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>

namespace nusselt::fit {

namespace {

/// The exponent of the difference in the objective. 3 as in Heitz et al. 2016 favours the peak, 1 the tail; the
/// variance of sampling hardly depends on it.
constexpr int kExponent = 2;

constexpr double kLargestAngle = kPi<double> / 2 - 1e-6;
constexpr double kSmallestLogWidth = -25, kLargestLogWidth = 2;
/// Relative to the width for angles, absolute for logarithms of widths.
constexpr double kFirstStep = 0.1;
constexpr double kLastStep = 1e-3;
constexpr double kSmallestGain = 1e-7;
constexpr int kMostEvaluations = 400;

/// One slice with what the objective needs.
struct Problem {
    const Brdf& brdf;
    Slice slice;
    Moments moments;
    const Nodes& nodes;

    double error(const Lobe& lobe, int exponent) const {
        return brdf.error(slice, moments.albedo, nodes, lobe, exponent);
    }
};

/// The parameters of a lobe that are optimised. The optimum with fewer parameters is the start for more.
enum class Freedom {
    width,        ///< isotropic around the normal
    fixed_tilt,   ///< widths and peak; the horizon is perpendicular to the mean direction
    unconstrained ///< tilt too
};

std::vector<double> coordinates_of(const Lobe& lobe, Freedom freedom) {
    std::vector<double> x = {std::log(lobe.width_x)};
    if (freedom != Freedom::width) x.insert(x.end(), {std::log(lobe.width_y), lobe.peak});
    if (freedom == Freedom::unconstrained) x.push_back(lobe.tilt);
    return x;
}

Lobe lobe_at(const double* x, Freedom freedom, double fixed_tilt) {
    const double width = std::exp(x[0]);
    if (freedom == Freedom::width) return {0, 0, width, width};
    return {x[2], freedom == Freedom::unconstrained ? x[3] : fixed_tilt, width, std::exp(x[1])};
}

struct Optimum {
    Lobe lobe;
    double objective;
};

using Optimiser = std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)>;

Optimum optimise(const Problem& problem, const Lobe& start, Freedom freedom) {
    std::vector<double> x = coordinates_of(start, freedom);
    const auto dimensions = static_cast<unsigned>(x.size());
    // BOBYQA needs two dimensions.
    const Optimiser optimiser(
        nlopt_create(dimensions == 1 ? NLOPT_LN_NELDERMEAD : NLOPT_LN_BOBYQA, dimensions), nlopt_destroy);
    if (!optimiser) throw std::bad_alloc();

    const double angle_unit = std::min(start.width_x, 1.0);
    std::vector<double> lower, upper, first, last;
    for (unsigned i = 0; i < dimensions; ++i) {
        const bool is_angle = i >= 2;
        lower.push_back(is_angle ? 0 : kSmallestLogWidth);
        upper.push_back(is_angle ? kLargestAngle : kLargestLogWidth);
        first.push_back(is_angle ? kFirstStep * angle_unit : kFirstStep);
        last.push_back(is_angle ? kLastStep * angle_unit : kLastStep);
        x[i] = std::clamp(x[i], lower[i], upper[i]);
    }
    nlopt_set_lower_bounds(optimiser.get(), lower.data());
    nlopt_set_upper_bounds(optimiser.get(), upper.data());
    nlopt_set_initial_step(optimiser.get(), first.data());
    nlopt_set_xtol_abs(optimiser.get(), last.data());
    nlopt_set_ftol_rel(optimiser.get(), kSmallestGain);
    nlopt_set_maxeval(optimiser.get(), kMostEvaluations);

    struct Search {
        const Problem& problem;
        Freedom freedom;
        double fixed_tilt;
        Optimum best;
    } search{problem, freedom, start.tilt, {start, std::numeric_limits<double>::max()}};
    const nlopt_func evaluate = [](unsigned, const double* at, double*, void* data) {
        Search& s = *static_cast<Search*>(data);
        const Lobe lobe = lobe_at(at, s.freedom, s.fixed_tilt);
        const double objective = s.problem.error(lobe, kExponent);
        if (objective < s.best.objective) s.best = {lobe, objective};
        return std::isfinite(objective) ? objective : std::numeric_limits<double>::max();
    };
    nlopt_set_min_objective(optimiser.get(), evaluate, &search);
    // It may report that rounding stopped it: the best lobe is then as good as numbers allow.
    double objective = 0;
    nlopt_optimize(optimiser.get(), x.data(), &objective);
    return search.best;
}

/// The ratio by which lobes are narrower across the plane of incidence than in it: reflection about normals that vary
/// turns directions by an angle proportional to the cosine, which the roughness limits from below.
double foreshortening(const Slice& slice) {
    const double alpha = ggx_alpha(slice.roughness);
    return std::hypot(std::cos(slice.inclination), alpha);
}

/// The optimum for one inclination, moved to where the next one is expected.
Lobe moved(Lobe lobe, double turn, double narrowing) {
    lobe.peak += turn;
    lobe.tilt += turn;
    lobe.width_y *= narrowing;
    return lobe;
}

} // namespace

std::vector<FittedLobe> fit_column(const Brdf& brdf, double roughness, double f0, int inclinations) {
    const auto nodes = std::make_unique<Nodes>();
    std::vector<FittedLobe> column;
    const double alpha = ggx_alpha(roughness);
    // Half vectors of a narrow lobe turn by half as much as directions.
    Lobe fixed{0, 0, std::min(2 * alpha, 1.0), std::min(2 * alpha, 1.0)};
    Lobe best = fixed;
    double previous_tilt = 0;
    double previous_foreshortening = 1;
    for (int i = 0; i < inclinations; ++i) {
        const double inclination = kPi<double> / 2 * i / (inclinations - 1);
        const Slice slice{roughness, inclination, std::max(f0, kSmallestF0)};
        const Problem problem{brdf, slice, brdf.moments(slice), *nodes};
        brdf.place_nodes(slice, problem.moments.albedo, *nodes);

        const double turn = problem.moments.tilt - previous_tilt;
        const double narrowing = foreshortening(slice) / previous_foreshortening;
        previous_tilt = problem.moments.tilt;
        previous_foreshortening = foreshortening(slice);
        if (i == 0) {
            fixed = best = optimise(problem, fixed, Freedom::width).lobe;
        } else {
            // The tilt matters little for narrow lobes, and with all numbers free there may be two minima: one search
            // from the best lobe with a given tilt, one from the neighbour.
            Lobe start = moved(fixed, turn, narrowing);
            start.tilt = problem.moments.tilt;
            fixed = optimise(problem, start, Freedom::fixed_tilt).lobe;
            const Optimum anew = optimise(problem, fixed, Freedom::unconstrained);
            const Optimum next = optimise(problem, moved(best, turn, narrowing), Freedom::unconstrained);
            best = anew.objective < next.objective ? anew.lobe : next.lobe;
        }
        const double albedo = brdf.moments({roughness, inclination, f0}).albedo;
        column.push_back({best, albedo, problem.error(best, 1)});
    }
    return column;
}

} // namespace nusselt::fit
