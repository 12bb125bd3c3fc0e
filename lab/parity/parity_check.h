#pragma once
/// Budgets of the twins: errors on the device may be at most three times those of C++ in float.

#include "proof/accuracy/cases.h"
#include "proof/hostile/contract.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::parity {

/// The quantities whose errors are measured against the technique in long double. "In the same direction" means the
/// direction that the method under test returned, so that no error counts twice.
enum class Quantity {
    first_random,   ///< backward error of the first random number
    second_random,  ///< of the second one; lines have none
    measure,        ///< relative error
    density,        ///< pdf() in the same direction, relative
    sample_density, ///< density of the sample in the same direction, relative
    unit_length,    ///< difference between the length of the direction and one
    aim,            ///< sine of the angle between the direction and the hit point
    hit_point, ///< distance from the intersection of the same direction with the light, relative to the light's size
    first_inverse,  ///< of the first random number that invert() finds for the same direction
    second_inverse, ///< of the second one
};
inline constexpr const char* kQuantityNames[] = {
    "first random number",   "second random number",    "measure", "density",
    "density of the sample", "length of the direction", "aim",     "hit point",
    "first inverse",         "second inverse"};
inline constexpr std::size_t kQuantities = std::size(kQuantityNames);

/// The errors of one method on one class of lights.
struct Errors {
    std::array<std::vector<double>, kQuantities> of;
    std::int64_t off_the_light = 0; ///< directions that miss the light by more than four roundings
    std::int64_t no_sample = 0;     ///< lights that have a measure, but no sample
    std::int64_t spurious = 0;      ///< dark lights with a sample or a measure
    std::int64_t invalid = 0;       ///< results that are NaN, infinite or negative

    void add(Quantity quantity, long double error) {
        of[static_cast<std::size_t>(quantity)].push_back(static_cast<double>(error));
    }
    void append(const Errors& other);
    /// How many samples were judged.
    std::size_t samples() const { return of[static_cast<std::size_t>(Quantity::first_random)].size(); }
};

/// One comparison of errors.
struct Compared {
    std::string lights = {}; ///< the class of lights; empty for functions
    std::string quantity;
    std::string quantile;
    double device, cpp; ///< errors

    std::string where() const; ///< all three names in a text
};

/// The result of comparing a device with C++.
struct Verdict {
    std::int64_t lights = 0;           ///< how many were judged, or calls of functions
    std::vector<Compared> compared;    ///< all errors whose budget can be exceeded
    std::vector<std::string> excesses; ///< messages that name each exceeded budget and the error
    std::vector<std::string>
        vacuous; ///< quantities and quantiles whose budget no error can exceed, or with too few errors
    double largest_ratio = 0; ///< of an error on the device to that of C++ or to the floor; the budget is 3
    std::string where;        ///< the quantity and quantile with the largest ratio

    /// Adds what was found on a class of lights; its name may be empty.
    void add(const std::string& lights_of_other, const Verdict& other);
};

/// The errors that are compared: the median, the 99 % quantile and the tail, which is the 99.9 % quantile. A quantile with
/// fewer than 30 errors above it depends on chance. The tail of fewer than 30 000 errors is therefore a lower quantile, below
/// 3000 it stands for the 99 % quantile, too, and fewer than 60 errors are vacuous.
enum class Tail {
    quantiles,
    nearly_largest, ///< also the 99.99 % quantile, if a class has many lights
    /// Also the largest error, if a class has many lights. Where single lights are ill-conditioned (say, for the
    /// second random number at the tip of a sector), the largest error of one method may be three times that of
    /// another by chance alone.
    largest,
};

/// How methods represent a light.
enum class Images {
    same,
    /// Each method rounds the image of the light in cosine space differently. This rounding dominates the error if
    /// the light is seen almost edge-on or is almost entirely outside the lobe. Chance then decides about the largest
    /// error of a quantity like 1 / x, and about the side of a limit on which a light is.
    rounded,
};

struct Budget {
    Tail tail = Tail::quantiles;
    double bound =
        std::numeric_limits<double>::infinity(); ///< no error is larger: a budget above it is vacuous
};

/// Compares errors of one quantity.
/// \param floor errors of the exact results rounded to float, below which no method can get.
Verdict compare(const std::string& quantity, std::vector<double> device, std::vector<double> cpp,
                std::vector<double> floor, const Budget& budget);

/// Compares all quantities, and the counts. With rounded images, it compares errors up to the 99.99 % quantile, and
/// counts may exceed those of C++ by three standard deviations, which is 0 if C++ has none.
Verdict compare(const Errors& device, const Errors& cpp, const Errors& floor, Images images = Images::same);

/// Whether a sample takes two random numbers, as for polygons.
template <class Traits>
inline constexpr bool kIsPolygonal = !std::is_same_v<typename Traits::template Random<float>, float>;

/// Where a ray from the origin meets the plane of a light.
template <int N>
Vec3<proof::Exact> hit_point(const ConvexPolygon<proof::Exact, N>& light, const Vec3<proof::Exact>& wi) {
    return dot(light.normal, light.vertex[0]) / dot(light.normal, wi) * wi;
}
/// Where a ray from the origin comes closest to a light, seen from the origin.
inline Vec3<proof::Exact> hit_point(const LineSegment<proof::Exact>& light, const Vec3<proof::Exact>& wi) {
    const auto across = cross(wi, light.s);
    return light.p0 - dot(cross(wi, light.p0), across) / dot(across, across) * light.s;
}

/// Where a ray from the origin meets a cylinder, or would meet it but for rounding.
inline Vec3<proof::Exact> hit_point(const Cylinder<proof::Exact>& light, const Vec3<proof::Exact>& wi) {
    return intersect(light, wi).distance * wi;
}

using hostile::hit_point;
using hostile::size_of;

template <int N>
proof::Exact size_of(const ConvexPolygon<proof::Exact, N>& light) {
    proof::Exact size = 0;
    for (const auto& v : light.vertex) size = std::max(size, length(v - light.vertex[0]));
    return size;
}
inline proof::Exact size_of(const LineSegment<proof::Exact>& light) { return light.length; }
inline proof::Exact size_of(const Cylinder<proof::Exact>& light) { return light.axis.length + light.radius; }

/// Judges the measure and the sample of a method. Published methods return nothing else.
/// \tparam Traits of proof/accuracy/references.h.
/// \return the random numbers that explain the sample; none without a sample or a visible light.
template <class Traits>
std::optional<typename Traits::template Random<proof::Exact>>
judge_sample(const proof::Case<Traits, float>& c, bool dark, const LightSample<float>& sample, float measure,
             Errors& errors) {
    using proof::Exact;
    if (!hostile::all_finite(sample.wi) || !is_finite(sample.pdf) || !is_finite(measure) || sample.pdf < 0 ||
        measure < 0) {
        ++errors.invalid;
        return std::nullopt;
    }
    if (dark) {
        errors.spurious += sample.pdf > 0 || (Traits::kMeasuresVisible && measure > 0);
        return std::nullopt;
    }
    errors.add(Quantity::measure, std::fabs(measure / c.exact.measure() - 1));
    if (sample.pdf == 0) {
        ++errors.no_sample;
        return std::nullopt;
    }
    const auto direction = broadcast<Exact>(sample.wi);
    errors.add(Quantity::unit_length, std::fabs(length(direction) - 1));
    const Vec3<Exact> wi = normalize(direction);
    errors.off_the_light += c.missed_by(wi) > proof::kTolerance<float>;
    const auto explained = c.exact.invert(wi);
    errors.add(Quantity::first_random, c.difference(Traits::first(explained), Traits::first(c.u)));
    if constexpr (kIsPolygonal<Traits>) errors.add(Quantity::second_random, std::fabs(explained.y - c.u.y));
    errors.add(Quantity::sample_density, std::fabs(sample.pdf / c.exact.pdf(wi) - 1));
    const auto p = broadcast<Exact>(sample.p);
    errors.add(Quantity::aim, length(cross(wi, normalize(p))));
    errors.add(Quantity::hit_point, length(p - hit_point(c.exact_light, wi)) / size_of(c.exact_light));
    return explained;
}

/// Judges all that a method returns for a light.
template <class Traits, class Outputs>
void judge(const proof::Case<Traits, float>& c, bool dark, const Outputs& out, Errors& errors) {
    using proof::Exact;
    if (!is_finite(out.pdf) || out.pdf < 0 || !hostile::in_unit_interval(out.inverse)) {
        ++errors.invalid;
        return;
    }
    const auto explained = judge_sample(c, dark, out.sample, out.measure, errors);
    if (!explained) return;
    const Vec3<Exact> wi = normalize(broadcast<Exact>(out.sample.wi));
    errors.add(Quantity::density, std::fabs(out.pdf / c.exact.pdf(wi) - 1));
    errors.add(Quantity::first_inverse, c.difference(Traits::first(*explained), Traits::first(out.inverse)));
    if constexpr (kIsPolygonal<Traits>)
        errors.add(Quantity::second_inverse, std::fabs(explained->y - out.inverse.y));
}

/// Exact results, each rounded to float. Density and inverse are those of the rounded direction.
template <class Traits>
hostile::Outputs<float, typename Traits::template Random<float>>
rounded_outputs(const proof::Case<Traits, float>& c) {
    using proof::Exact;
    const auto s = c.exact.sample(Traits::template widened<Exact>(c.u));
    const auto direction = broadcast<float>(s.wi);
    const Vec3<Exact> wi = normalize(broadcast<Exact>(direction));
    const auto pdf = static_cast<float>(c.exact.pdf(wi));
    const auto inverse = c.exact.invert(wi);
    typename Traits::template Random<float> rounded_inverse;
    if constexpr (kIsPolygonal<Traits>)
        rounded_inverse = {below_one(static_cast<float>(inverse.x)),
                           below_one(static_cast<float>(inverse.y))};
    else
        rounded_inverse = below_one(static_cast<float>(inverse));
    return {
        {direction, pdf, broadcast<float>(s.p)}, pdf, rounded_inverse, static_cast<float>(c.exact.measure())};
}

} // namespace nusselt::parity
