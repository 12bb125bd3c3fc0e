#include "render/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nusselt::render {

namespace {

/// Distance from the centre of a Gaussian in standard deviations beyond which float cannot distinguish it from zero.
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
    const bool is_gaussian = filter.kind == scene::FilterKind::gaussian;
    const double reach = is_gaussian ? std::min<double>(radius, kGaussianReach * filter.sigma) : radius;
    constexpr int kStepsPerCell = 64;
    const double step = 2 * reach / (kFilterCells * kStepsPerCell);
    std::vector<double> integral(kFilterCells);
    std::vector<double> magnitude(kFilterCells);
    double total_integral = 0;
    double total_magnitude = 0;
    for (int cell = 0; cell < kFilterCells; ++cell) {
        const auto i = static_cast<std::size_t>(cell);
        for (int j = 0; j < kStepsPerCell; ++j) {
            const double value = value_at(filter, radius, (cell * kStepsPerCell + j + 0.5) * step - reach);
            integral[i] += value;
            magnitude[i] += std::fabs(value);
        }
        total_integral += integral[i];
        total_magnitude += magnitude[i];
    }
    if (!(total_integral > 0))
        throw std::runtime_error(
            "the integral of the pixel filter must be positive, but is not with a radius of " +
            std::to_string(radius));

    PixelFilterTable table;
    table.reach = static_cast<float>(reach);
    double below = 0;
    for (std::size_t i = 0; i < integral.size(); ++i) {
        table.cumulative.push_back(static_cast<float>(below / total_magnitude));
        below += magnitude[i];
        const double sign = magnitude[i] > 0 ? integral[i] / magnitude[i] : 0;
        table.weights.push_back(static_cast<float>(sign * (total_magnitude / total_integral)));
    }
    table.cumulative.push_back(1);
    return table;
}

} // namespace nusselt::render
