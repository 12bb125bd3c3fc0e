#include "lab/figures/picture.h"
#include "lab/statements/measurements.h"

#include <nusselt/sampling/line_projected_solid_angle.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nusselt::lab {

namespace {

using Point = Vec2<double>;

/// The angle of the normal from the direction t to the line, towards s: n_s is its sine, n_t its cosine.
constexpr double kTilts[] = {0, 45, 90, 120, 150}; // [degrees]
constexpr const char* kColours[] = {"#cc79a7", "#000000", "#009e73", "#d55e00", "#0072b2"};

/// The inverse of F of Eq. 3 as LineProjectedSolidAngle computes it: for a line of any length at a distance of 1.
class InverseDistribution {
public:
    /// \param tilt from 0 to 180 [degrees].
    explicit InverseDistribution(double tilt)
        : n_s_(std::sin(tilt * kRadian)),
          n_t_(std::cos(tilt * kRadian)),
          s_{n_t_, 0, n_s_},
          technique_(whole_line()),
          // The horizon, or the direction -s, if that is in it.
          low_(tilt > 0 ? -n_t_ : -1),
          begin_(integral(low_)),
          end_(integral(1)) {}

    double n_s() const { return n_s_; }
    double n_t() const { return n_t_; }
    /// The domain of F, and the values of F at its ends.
    double low() const { return low_; }
    double begin() const { return begin_; }
    double end() const { return end_; }

    double integral(double w_s) const {
        const double w_t = std::sqrt(std::max(1 - w_s * w_s, 0.0));
        return n_s_ * w_s * w_s + n_t_ * (w_t * w_s + std::asin(w_s));
    }
    double operator()(double value) const {
        return dot(technique_.sample((value - begin_) / (end_ - begin_)).wi, s_);
    }

private:
    static constexpr double kRadian = kPi<double> / 180;
    /// From the directions of the line to those of the ends of the light [rad].
    static constexpr double kReach = 1e-7;

    LineSegment<double> whole_line() const {
        const Vec3<double> t{-s_.z, 0, s_.x};
        const double half = 1 / std::tan(kReach);
        return {t - half * s_, s_, 2 * half};
    }

    double n_s_, n_t_;
    Vec3<double> s_;
    LineProjectedSolidAngle<double> technique_;
    double low_, begin_, end_;
};

std::string draw(const std::vector<InverseDistribution>& curves) {
    constexpr double kWidth = 560, kHeight = 340, kLeft = 50, kTop = 20;
    constexpr double kFirst = -2, kLast = 2; // of F
    Picture picture(kLeft + kWidth + 170, kTop + kHeight + 46);
    const auto at = [&](double f, double w) {
        return Point{kLeft + kWidth * (f - kFirst) / (kLast - kFirst), kTop + kHeight * (1 - (w + 1) / 2)};
    };
    const char* const kGrid = "fill=\"none\" stroke=\"#dddddd\" stroke-width=\"1\"";
    for (int i = -2; i <= 2; ++i) {
        picture.path({at(i, -1), at(i, 1)}, false, kGrid);
        picture.label({at(i, -1).x, kTop + kHeight + 18}, fmt::format("{}", i));
        picture.path({at(kFirst, 0.5 * i), at(kLast, 0.5 * i)}, false, kGrid);
        picture.label({kLeft - 20, at(0, 0.5 * i).y + 4}, fmt::format("{:g}", 0.5 * i));
    }
    picture.path({at(kFirst, -1), at(kLast, -1), at(kLast, 1), at(kFirst, 1)}, true, kOutline);
    picture.label({kLeft + kWidth / 2, kTop + kHeight + 38}, "value of F");
    for (std::size_t i = 0; i < curves.size(); ++i) {
        constexpr int kSteps = 400;
        const InverseDistribution& inverse = curves[i];
        std::vector<Point> points;
        for (int k = 0; k <= kSteps; ++k) {
            // Dense at the steep end.
            const double share = std::pow(below_one(static_cast<double>(k) / kSteps), 2);
            const double value = inverse.begin() + share * (inverse.end() - inverse.begin());
            points.push_back(at(value, std::clamp(inverse(value), -1.0, 1.0)));
        }
        const std::string style =
            fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"", kColours[i]);
        picture.path(points, false, style);
        const double y = kTop + 14 + 22 * static_cast<double>(i);
        picture.path({{kLeft + kWidth + 14, y}, {kLeft + kWidth + 40, y}}, false, style);
        picture.label({kLeft + kWidth + 102, y + 4},
                      fmt::format("n = ({:.2f}, {:.2f})", inverse.n_s(), inverse.n_t() + 0.0));
    }
    return picture.finished();
}

/// How the inverse leaves the left end of its domain: the power of the distance from it.
double power_at_begin(const InverseDistribution& inverse) {
    const double whole = inverse.end() - inverse.begin();
    const auto rise = [&](double share) { return inverse(inverse.begin() + share * whole) - inverse.low(); };
    return std::log(rise(1e-4) / rise(1e-6)) / std::log(100.0);
}

} // namespace

Findings measure_inverse_distribution(Effort /*it takes no time*/) {
    const char* const kItem = "lines-fig-3";
    std::vector<InverseDistribution> curves;
    for (const double tilt : kTilts) curves.emplace_back(tilt);
    double error = 0, power = 0, deviation_from_root = 0, rising = 0;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const InverseDistribution& inverse = curves[i];
        power = std::max(power, power_at_begin(inverse));
        double before = inverse.low();
        bool rises = true;
        for (int k = 1; k < 1000; ++k) {
            const double value = inverse.begin() + k / 1000.0 * (inverse.end() - inverse.begin());
            const double w_s = inverse(value);
            rises &= w_s > before;
            before = w_s;
            error = std::max(error, std::fabs(inverse.integral(w_s) - value));
            if (kTilts[i] == 90)
                deviation_from_root = std::max(deviation_from_root, std::fabs(w_s - std::sqrt(value)));
        }
        rising += rises ? 1 : 0;
    }
    Finding count = at_least(kItem, "curves that rise everywhere", rising, 5);
    count.published = "curves";
    Findings findings = {
        {count, at_most(kItem, "largest difference between F of the inverse and its argument", error, 1e-6),
         at_most(kItem, "n = (1, 0): largest difference from the square root", deviation_from_root, 1e-6),
         at_most(kItem,
                 "largest power with which a curve rises at its left end; below 1, it is infinitely steep",
                 power, 0.7),
         at_most(kItem, "width of the range of F for the normal closest to -t over that for t",
                 (curves[4].end() - curves[4].begin()) / (curves[0].end() - curves[0].begin()), 0.1)}};
    findings.drawings.push_back({"inverse distribution of lines", "inverse-distribution", draw(curves)});
    return findings;
}

} // namespace nusselt::lab
