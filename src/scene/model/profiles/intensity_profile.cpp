#include "scene/model/profiles/intensity_profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace nusselt::scene {

namespace {

constexpr double kPi = std::numbers::pi;

[[maybe_unused]] bool is_increasing(const std::vector<double>& angles) {
    return std::adjacent_find(angles.begin(), angles.end(), std::greater_equal<>()) == angles.end();
}

double lerp(double a, double b, double t) { return (1 - t) * a + t * b; }

/// A direction of a plane through the axis: its angle from the axis, negative in the second half-plane.
struct Reading {
    double angle, candelas;
};

/// Where the line through two readings reaches a level, which is above the first and not above the second.
double crossing(const Reading& below, const Reading& above, double level) {
    return lerp(below.angle, above.angle, (level - below.candelas) / (above.candelas - below.candelas));
}

} // namespace

IntensityProfile::IntensityProfile(IntensityTable table) : table_(std::move(table)) {
    assert(table_.vertical.size() >= 2 && is_increasing(table_.vertical));
    assert(!table_.horizontal.empty() && is_increasing(table_.horizontal));
    assert(table_.candelas.size() == table_.vertical.size() * table_.horizontal.size());
    for (std::size_t v = 0; v < table_.vertical.size(); ++v) {
        double sum = 0;
        for (std::size_t h = 0; h < table_.horizontal.size(); ++h)
            sum += width_of(h) * 0.5 * (at(h, v) + at((h + 1) % table_.horizontal.size(), v));
        ring_.push_back(sum);
    }
    if (table_.vertical.front() == 0) agree_at(0);
    if (table_.vertical.back() == kPi) agree_at(table_.vertical.size() - 1);
}

/// The angle from a half-plane to the next one.
double IntensityProfile::width_of(std::size_t half_plane) const {
    const bool is_last = half_plane + 1 == table_.horizontal.size();
    return (is_last ? table_.horizontal.front() + 2 * kPi : table_.horizontal[half_plane + 1]) -
           table_.horizontal[half_plane];
}

/// On the axis, all half-planes have the mean, which leaves the flux as it is.
void IntensityProfile::agree_at(std::size_t vertical) {
    const double mean = ring_[vertical] / (2 * kPi);
    for (std::size_t h = 0; h < table_.horizontal.size(); ++h)
        table_.candelas[h * table_.vertical.size() + vertical] = mean;
}

double IntensityProfile::intensity(const Double3& direction) const {
    const double vertical = std::atan2(std::hypot(direction.x, direction.y), direction.z);
    const double horizontal = std::atan2(-direction.y, direction.x);
    return intensity_at(vertical, horizontal < 0 ? horizontal + 2 * kPi : horizontal);
}

double IntensityProfile::intensity_at(double vertical, double horizontal) const {
    const std::vector<double>& v = table_.vertical;
    const std::vector<double>& h = table_.horizontal;
    if (!(vertical >= v.front() && vertical <= v.back())) return 0;
    const auto above = std::upper_bound(v.begin() + 1, v.end() - 1, vertical);
    const auto i = static_cast<std::size_t>(above - v.begin()) - 1;
    const double s = (vertical - v[i]) / (v[i + 1] - v[i]);

    // Angles before the first half-plane are behind the last one.
    const auto next = std::upper_bound(h.begin(), h.end(), horizontal);
    const auto j = (next == h.begin() ? h.size() : static_cast<std::size_t>(next - h.begin())) - 1;
    const double behind = horizontal - h[j] + (next == h.begin() ? 2 * kPi : 0);
    const double t = std::min(behind / width_of(j), 1.0);
    const std::size_t k = (j + 1) % h.size();
    return lerp(lerp(at(j, i), at(j, i + 1), s), lerp(at(k, i), at(k, i + 1), s), t);
}

/// The integral of J times a weight. `moment` returns the antiderivatives of the weight, and of the angle times the
/// weight.
template <class Moment>
double IntensityProfile::integral(double begin, double end, const Moment& moment) const {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < ring_.size(); ++i) {
        const double v = table_.vertical[i];
        const double a = std::max(v, begin);
        const double b = std::min(table_.vertical[i + 1], end);
        if (!(a < b)) continue;
        const double slope = (ring_[i + 1] - ring_[i]) / (table_.vertical[i + 1] - v);
        const auto [weight_a, angle_a] = moment(a);
        const auto [weight_b, angle_b] = moment(b);
        sum += (ring_[i] - slope * v) * (weight_b - weight_a) + slope * (angle_b - angle_a);
    }
    return sum;
}

double IntensityProfile::flux_between(double begin, double end) const {
    const auto moment = [](double v) { return std::pair(-std::cos(v), std::sin(v) - v * std::cos(v)); };
    return std::max(integral(begin, end, moment), 0.0); // rounding
}

double IntensityProfile::cosine_flux_between(double begin, double end) const {
    // sin v cos v = sin(2 v) / 2
    return integral(begin, end, [](double v) {
        const double cos2 = std::cos(2 * v);
        return std::pair(-cos2 / 4, std::sin(2 * v) / 8 - v * cos2 / 4);
    });
}

double IntensityProfile::flux() const { return flux_between(0, kPi); }
double IntensityProfile::lower_flux() const { return flux_between(0, kPi / 2); }
double IntensityProfile::upper_flux() const { return flux_between(kPi / 2, kPi); }

IntensityProfile::Peak IntensityProfile::peak() const {
    const auto largest = std::max_element(table_.candelas.begin(), table_.candelas.end());
    const auto index = static_cast<std::size_t>(largest - table_.candelas.begin());
    return {*largest, table_.vertical[index % table_.vertical.size()],
            table_.horizontal[index / table_.vertical.size()]};
}

double IntensityProfile::spread(double horizontal, double share) const {
    const double level = share * peak().candelas;
    if (!(level > 0)) return 0;
    const bool is_upward = upper_flux() > lower_flux();
    const auto from_axis = [&](double vertical) { return is_upward ? kPi - vertical : vertical; };
    std::vector<Reading> readings;
    const auto add_half = [&](double half_plane, double sign) {
        const double wrapped = std::fmod(half_plane, 2 * kPi);
        for (const double v : table_.vertical)
            readings.push_back({sign * from_axis(v), intensity_at(v, wrapped)});
        // Nothing shines between the axis and where the table begins.
        const double inner = is_upward ? table_.vertical.back() : table_.vertical.front();
        if (from_axis(inner) > 0) readings.push_back({sign * from_axis(inner), 0});
    };
    add_half(horizontal + kPi, -1);
    add_half(horizontal, 1);
    // Dark readings at an edge of the table are on the side of the axis.
    std::stable_sort(readings.begin(), readings.end(), [](const Reading& a, const Reading& b) {
        return a.angle < b.angle || (a.angle == b.angle && a.angle < 0 && a.candelas > b.candelas) ||
               (a.angle == b.angle && a.angle > 0 && a.candelas < b.candelas);
    });
    const auto reaches = [&](const Reading& reading) { return reading.candelas >= level; };
    const auto first = std::find_if(readings.begin(), readings.end(), reaches);
    if (first == readings.end()) return 0;
    const auto last = std::find_if(readings.rbegin(), readings.rend(), reaches);
    const double low = first == readings.begin() ? first->angle : crossing(*(first - 1), *first, level);
    const double high = last == readings.rbegin() ? last->angle : crossing(*(last - 1), *last, level);
    return high - low;
}

} // namespace nusselt::scene
