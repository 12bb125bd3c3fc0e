#include "render_cpu/pixel_filter.h"

#include "render_cpu/kernel.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nusselt::render_cpu {

namespace {

/// Distance from the centre of a Gaussian in standard deviations beyond which float cannot tell it from zero.
constexpr double kGaussianReach = 8;

/// exp(-x^2 / (2 sigma^2)) minus its value at the radius, without cancellation where both are close.
double gaussian(double x, double radius, double sigma) {
    const double here = x * x / (2 * sigma * sigma);
    const double at_radius = radius * radius / (2 * sigma * sigma);
    return -std::exp(-here) * std::expm1(here - at_radius);
}

/// D. Mitchell, A. Netravali 1988, Reconstruction Filters in Computer Graphics, Eq. (8). \param x from -2 to 2
double mitchell(double x, double b, double c) {
    x = std::fabs(x);
    if (x < 1) return ((12 - 9 * b - 6 * c) * x + (-18 + 12 * b + 6 * c)) * x * x + (6 - 2 * b);
    return (((-b - 6 * c) * x + (6 * b + 30 * c)) * x + (-12 * b - 48 * c)) * x + (8 * b + 24 * c);
}

double value_at(const scene::PixelFilter& filter, double radius, double x) {
    switch (filter.kind) {
    case scene::FilterKind::box:
        return 1;
    case scene::FilterKind::triangle:
        return radius - std::fabs(x);
    case scene::FilterKind::gaussian:
        return gaussian(x, radius, filter.sigma);
    case scene::FilterKind::mitchell:
        return mitchell(2 * x / radius, filter.b, filter.c);
    }
    return 0;
}

} // namespace

PixelFilterTable make_filter_table(const scene::PixelFilter& filter, float radius) {
    if (filter.kind == scene::FilterKind::box) return {};
    constexpr std::size_t kSteps = 64 * kFilterCells;
    const bool is_gaussian = filter.kind == scene::FilterKind::gaussian;
    const double reach = is_gaussian ? std::min<double>(radius, kGaussianReach * filter.sigma) : radius;
    const double step = 2 * reach / kSteps;
    // Integrals from -reach to the ends of steps.
    std::vector<double> integral(kSteps + 1);
    std::vector<double> magnitude(kSteps + 1);
    for (std::size_t i = 0; i < kSteps; ++i) {
        const double value = value_at(filter, radius, -reach + (static_cast<double>(i) + 0.5) * step);
        integral[i + 1] = integral[i] + value;
        magnitude[i + 1] = magnitude[i] + std::fabs(value);
    }
    if (!(integral.back() > 0))
        throw std::runtime_error("the integral of the pixel filter is not positive with a radius of " +
                                 std::to_string(radius));

    PixelFilterTable table;
    table.offsets.push_back(static_cast<float>(-reach));
    double integral_before = 0;
    std::size_t i = 0;
    for (int cell = 1; cell <= kFilterCells; ++cell) {
        const double target = magnitude.back() * cell / kFilterCells;
        while (i + 1 < kSteps && magnitude[i + 1] < target) ++i;
        const double part = std::min((target - magnitude[i]) / (magnitude[i + 1] - magnitude[i]), 1.0);
        const double integral_here = std::lerp(integral[i], integral[i + 1], part);
        table.offsets.push_back(static_cast<float>(-reach + (static_cast<double>(i) + part) * step));
        table.weights.push_back(
            static_cast<float>((integral_here - integral_before) * kFilterCells / integral.back()));
        integral_before = integral_here;
    }
    return table;
}

} // namespace nusselt::render_cpu
