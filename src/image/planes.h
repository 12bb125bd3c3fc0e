#pragma once
/// Planes of numbers and separable filters, for metrics that look at the neighbourhood of a pixel.

#include "image/image.h"

#include <functional>
#include <vector>

namespace nusselt::image {

/// One number for each pixel, row 0 on top.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<double> values;

    [[nodiscard]] const double* row(int y) const { return &values[std::size_t(y) * std::size_t(width)]; }
    [[nodiscard]] double* row(int y) { return &values[std::size_t(y) * std::size_t(width)]; }
};

/// A plane of the given size, all zero.
[[nodiscard]] Plane make_plane(int width, int height);

/// Calls f(y) for all rows, on all cores. f must not throw.
void for_each_row(int height, const std::function<void(int)>& f);

/// The convolution of a plane with column * row^T, where weights beyond the border see the pixel on it.
/// \param row     weights along x, of odd number; the middle one belongs to the pixel itself
/// \param column  likewise along y
[[nodiscard]] Plane filtered(const Plane& plane, const std::vector<double>& row,
                             const std::vector<double>& column);

/// Whether all channels of each pixel are finite in both images.
/// \throws std::runtime_error  if the sizes differ
[[nodiscard]] std::vector<char> valid_in_both(const Image& a, const Image& b);

} // namespace nusselt::image
