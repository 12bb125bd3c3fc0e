#include "lab/fuzzing/convergence.h"
#include "lab/statements/iteration_drawings.h"
#include "lab/statements/measurements.h"
#include "lab/statements/sector_iterations.h"

#include <nusselt/core/trig.h>
#include <nusselt/random/pcg.h>
#include <nusselt/random/unit_interval.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace nusselt::lab {

namespace {

using Real = long double;

/// Random sectors of at least 1e-2, as those of polygons: the inner circle is anywhere above the outer one.
class RandomSectors {
public:
    explicit RandomSectors(std::uint64_t seed) : random_(seed) {}

    TwoEllipses<Real> next() {
        for (;;) {
            const Real sweep = kPi<Real> * Real(0.999L) * uniform();
            const Vec2<Real> inner{elevation(), elevation()};
            const auto sector =
                TwoEllipses<Real>::between(sweep, inner, {inner.x * uniform(), inner.y * uniform()});
            if (sector.area() >= 1e-2L) return sector;
        }
    }
    Real uniform() { return to_unit<double>(random_()); }

private:
    Real elevation() { return std::exp(6 * uniform() - 3); }
    Pcg32 random_;
};

/// Largest error of the random number of a start.
/// \param start called with the random number.
template <class Start>
double largest_error(const TwoEllipses<Real>& sector, int samples, const Start& start) {
    Real largest = 0;
    for (int k = 0; k < samples; ++k) {
        const Real share = (k + Real(0.5)) / samples;
        largest = std::max(largest, std::fabs(sector.share_to(start(share)) - share));
    }
    return static_cast<double>(largest);
}

void append_quads(Effort effort, Findings& findings) {
    const char* const kItem = "polygons-fig-5";
    const int sectors = effort == Effort::quick ? 200 : 5000;
    double one = 0, two = 0;
    RandomSectors random(1);
    for (int i = 0; i < sectors; ++i) {
        const auto sector = random.next();
        const auto with_quads = [&](int quads) {
            return largest_error(sector, 8,
                                 [&](Real share) { return sector.start_with_quads(quads, share); });
        };
        one = std::max(one, with_quads(1));
        two = std::max(two, with_quads(2));
    }
    const std::string of = fmt::format(", {} random sectors", sectors);
    findings.all.push_back(at_most(kItem, "two quads, largest error of the random number" + of, two, 0.27));
    findings.all.push_back(
        at_least(kItem, "a single quad, largest error of the random number" + of, one, 0.4));
    findings.drawings.push_back({"starts with two quads and with one", "quads", draw_quads()});
}

/// How Newton's method, with the start of Arvo, treats equal steps of the random number.
struct ArvoSamples {
    int out_of_order = 0; ///< starts that do not follow the one before
    int in_cycle = 0;     ///< samples that return to where they were after more than one step
    double largest_start_error = 0;
    double largest_error_of_tangents =
        0; ///< after two steps of the published iteration instead, from its start
};

/// Whether Newton's method comes back after 2 to 16 steps, and does not converge.
bool is_in_cycle(const TwoEllipses<double>& sector, double share) {
    constexpr int kWarmUp = 200;
    constexpr double kSame = 1e-9;
    double azimuth = sector.start_with_cubic(share);
    for (int i = 0; i < kWarmUp; ++i) azimuth = sector.newton_step(azimuth, share);
    double next = azimuth;
    for (int period = 1; period <= 16; ++period) {
        next = sector.newton_step(next, share);
        if (std::fabs(next - azimuth) < kSame) return period > 1;
    }
    return false;
}

ArvoSamples arvo_samples(const TwoEllipses<double>& sector) {
    ArvoSamples result;
    double previous = 0;
    for (int k = 0; k < kArvoSamples; ++k) {
        const double share = share_of_sample(k);
        const double start = sector.start_with_cubic(share);
        result.out_of_order += start < previous;
        previous = start;
        const double inside = std::clamp(start, 0.0, sector.sweep);
        result.largest_start_error =
            std::max(result.largest_start_error, std::fabs(sector.share_to(inside) - share));
        result.in_cycle += is_in_cycle(sector, share);
        double azimuth = sector.start_with_quads(2, share);
        for (int i = 0; i < 2; ++i) azimuth = sector.tangent_step(azimuth, share);
        result.largest_error_of_tangents =
            std::max(result.largest_error_of_tangents, std::fabs(sector.share_to(azimuth) - share));
    }
    return result;
}

void append_arvo(Findings& findings) {
    const char* const kItem = "polygons-fig-8";
    const ArvoSamples uneven = arvo_samples(uneven_sector());
    const ArvoSamples cyclic = arvo_samples(cyclic_sector());
    const std::string of = fmt::format(", {} samples", kArvoSamples);
    Finding cycle = at_least(kItem, "(b): samples that enter a cycle" + of, cyclic.in_cycle, 1);
    cycle.published = "samples that enter a cycle";
    findings.all.push_back(at_least(kItem, "(a): starts that lie before the one of the sample before" + of,
                                    uneven.out_of_order, 1));
    findings.all.push_back(at_least(kItem, "(a): largest error of the random number of a start" + of,
                                    uneven.largest_start_error, 0.2));
    findings.all.push_back(cycle);
    findings.all.push_back(
        at_most(kItem, "both: the same samples, after two steps between tangents" + of,
                std::max(uneven.largest_error_of_tangents, cyclic.largest_error_of_tangents), 1e-4));
    findings.drawings.push_back({"Arvo's method: an uneven start and a cycle", "arvo", draw_arvo()});
}

/// Errors after each step from the start with two quads.
template <class Step>
ErrorSequence errors_after_steps(const TwoEllipses<Real>& sector, Real share, const Step& step) {
    ErrorSequence errors;
    Real azimuth = sector.start_with_quads(2, share);
    for (Real& error : errors) {
        error = std::fabs(sector.share_to(azimuth) - share);
        azimuth = step(azimuth);
    }
    return errors;
}

/// The order at the end of a sector where both ellipses meet: the density is zero.
double newton_order_at_end() {
    const auto sector =
        TwoEllipses<Real>::between(Real(1.5L), {Real(1.5L), Real(0.8L)}, {Real(0.4L), Real(0.8L)});
    Real azimuth = Real(0.9L) * sector.sweep;
    Real errors[3];
    for (Real& error : errors) {
        error = std::fabs(sector.share_to(azimuth) - 1);
        azimuth = sector.newton_step(azimuth, 1);
    }
    return static_cast<double>(std::log(errors[2] / errors[1]) / std::log(errors[1] / errors[0]));
}

/// A line at distance 1 in the half-plane of the normal: Sec. 3.3 of the paper on lines.
struct LineIteration {
    Real n_s, n_t, begin, end; ///< components of the normal; angles of the ends from the closest point

    Real integral(Real alpha) const {
        return n_s * std::sin(alpha) * std::sin(alpha) + n_t * (std::cos(alpha) * std::sin(alpha) + alpha);
    }
    Real share_to(Real alpha) const {
        return (integral(alpha) - integral(begin)) / (integral(end) - integral(begin));
    }
    Real start(Real share) const {
        return std::asin(std::sin(begin) + share * (std::sin(end) - std::sin(begin)));
    }
    /// The root next to 0 of the quadratic Taylor polynomial.
    Real step(Real alpha, Real share) const {
        const Real s = std::sin(alpha), c = std::cos(alpha);
        const Real missing = (share_to(alpha) - share) * (integral(end) - integral(begin));
        const Real slope = 2 * (n_s * s + n_t * c) * c;
        const Real bend = 2 * (n_s * c - n_t * s) * c - 2 * (n_s * s + n_t * c) * s;
        const Real root = std::sqrt(std::max(slope * slope - 2 * bend * missing, Real(0)));
        return std::clamp(alpha - 2 * missing / (slope + root), -kPi<Real> / 2, kPi<Real> / 2);
    }
};

std::vector<ErrorSequence> line_iteration_errors(int count) {
    Pcg32 random(3);
    const auto uniform = [&] { return static_cast<Real>(to_unit<double>(random())); };
    std::vector<ErrorSequence> all;
    while (all.size() < static_cast<std::size_t>(count)) {
        const Real tilt = kPi<Real> * uniform();
        const Real low = std::max(tilt - kPi<Real> / 2, -kPi<Real> / 2);
        const Real a = low + (kPi<Real> / 2 - low) * uniform();
        const Real b = low + (kPi<Real> / 2 - low) * uniform();
        const LineIteration line{std::sin(tilt), std::cos(tilt), std::min(a, b), std::max(a, b)};
        const Real share = uniform();
        if (!(line.integral(line.end) - line.integral(line.begin) >= 1e-2L)) continue;
        ErrorSequence errors;
        Real alpha = line.start(share);
        for (Real& error : errors) {
            error = std::fabs(line.share_to(alpha) - share);
            alpha = line.step(alpha, share);
        }
        all.push_back(errors);
    }
    return all;
}

/// Orders are those of the last step that is not yet at rounding.
void append_order(const char* item, const std::string& iteration, const std::vector<ErrorSequence>& errors,
                  std::size_t step, double expected, std::optional<std::string> published, Findings& findings,
                  Table& table) {
    const std::vector<ConvergenceRow> rows = convergence_of(errors);
    table.push_back({iteration});
    for (const ConvergenceRow& row : rows) table.back().push_back(fmt::format("{:.1e}", row.median_error));
    const ConvergenceRow& row = rows[step];
    Finding order = between(item,
                            fmt::format("{}, order of convergence after {} steps, {} cases", iteration,
                                        row.steps, row.order_cases),
                            row.order, expected - 0.15, expected + 0.15);
    if (published) order.published = *published;
    findings.all.push_back(order);
    findings.all.push_back(
        at_least(item, iteration + ", cases that tell the order", static_cast<double>(row.order_cases), 30));
}

void append_orders(Effort effort, Findings& findings) {
    const int count = effort == Effort::quick ? 500 : 20'000;
    std::vector<ErrorSequence> newton, tangents;
    RandomSectors random(2);
    for (int i = 0; i < count; ++i) {
        const auto sector = random.next();
        const Real share = random.uniform();
        newton.push_back(
            errors_after_steps(sector, share, [&](Real a) { return sector.newton_step(a, share); }));
        tangents.push_back(
            errors_after_steps(sector, share, [&](Real a) { return sector.tangent_step(a, share); }));
    }
    Table table = {{"median error of the random number", "start", "1 step", "2 steps", "3 steps", "4 steps"}};
    append_order("polygons-sec-3.8-newton-order", "Newton's method, sectors", newton, 3, 2,
                 "order of convergence", findings, table);
    findings.all.push_back(between("polygons-sec-3.8-newton-order",
                                   "Newton's method, order where the density is zero", newton_order_at_end(),
                                   0.8, 1.2));
    append_order("polygons-sec-3.5-cubic-convergence", "the published iteration, sectors", tangents, 2, 3, {},
                 findings, table);
    append_order("lines-sec-3.3-rapid-convergence", "the published iteration, lines",
                 line_iteration_errors(10 * count), 2, 3, {}, findings, table);
    findings.tables.push_back(std::move(table));
}

} // namespace

Findings measure_iterations(Effort effort) {
    Findings findings;
    append_quads(effort, findings);
    append_arvo(findings);
    append_orders(effort, findings);
    return findings;
}

} // namespace nusselt::lab
