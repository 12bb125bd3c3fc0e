#include "image/planes.h"

#include "image/metrics.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace nusselt::image {

Plane make_plane(int width, int height) {
    return {width, height, std::vector<double>(std::size_t(width) * std::size_t(height))};
}

void for_each_row(int height, const std::function<void(int)>& f) { tbb::parallel_for(0, height, f); }

Plane filtered(const Plane& plane, const std::vector<double>& row, const std::vector<double>& column) {
    const int row_radius = int(row.size() / 2);
    const int column_radius = int(column.size() / 2);
    Plane along_x = make_plane(plane.width, plane.height);
    for_each_row(plane.height, [&](int y) {
        const double* in = plane.row(y);
        double* out = along_x.row(y);
        std::vector<double> padded(std::size_t(plane.width + 2 * row_radius));
        for (int x = -row_radius; x < plane.width + row_radius; ++x)
            padded[std::size_t(x + row_radius)] = in[std::clamp(x, 0, plane.width - 1)];
        for (std::size_t i = 0; i < row.size(); ++i)
            for (int x = 0; x < plane.width; ++x) out[x] += row[i] * padded[std::size_t(x) + i];
    });
    Plane result = make_plane(plane.width, plane.height);
    for_each_row(plane.height, [&](int y) {
        double* out = result.row(y);
        for (int i = -column_radius; i <= column_radius; ++i) {
            const double weight = column[std::size_t(i + column_radius)];
            const double* in = along_x.row(std::clamp(y + i, 0, plane.height - 1));
            for (int x = 0; x < plane.width; ++x) out[x] += weight * in[x];
        }
    });
    return result;
}

std::vector<char> valid_in_both(const Image& a, const Image& b) {
    require_same_size(a, b);
    std::vector<char> valid(a.pixels.size() / 3);
    for (std::size_t i = 0; i < valid.size(); ++i)
        valid[i] = is_valid_pixel(&a.pixels[3 * i]) && is_valid_pixel(&b.pixels[3 * i]);
    return valid;
}

} // namespace nusselt::image
