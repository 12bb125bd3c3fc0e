#include "fit/table_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace nusselt::fit {

LtcCoefficients<double> coefficients_of(const Lobe& lobe, double albedo) {
    return {std::cos(lobe.peak),
            std::sin(lobe.peak),
            lobe.width_x / lobe.width_y,
            -lobe.width_x * std::sin(lobe.tilt),
            lobe.width_x * std::cos(lobe.tilt),
            albedo};
}

Lobe lobe_of(const LtcCoefficients<double>& c) {
    const double length_z = std::hypot(c.m20, c.m22);
    return {std::atan2(c.m02, c.m00), std::atan2(-c.m20, c.m22), length_z / std::hypot(c.m00, c.m02),
            length_z / c.m11};
}

double fit_error(const Brdf& brdf, const Slice& slice, const Lobe& lobe) {
    const auto nodes = std::make_unique<Nodes>();
    const double albedo = brdf.moments(slice).albedo;
    brdf.place_nodes(slice, albedo, *nodes);
    return brdf.error(slice, albedo, *nodes, lobe, 1);
}

std::vector<double> fit_errors(const Brdf& brdf, const LtcTableView& table,
                               const std::vector<Slice>& slices) {
    std::vector<double> errors(slices.size());
    tbb::parallel_for(std::size_t{0}, slices.size(), [&](std::size_t i) {
        const Slice& slice = slices[i];
        errors[i] = fit_error(brdf, slice,
                              lobe_of(table.lookup(slice.roughness, std::cos(slice.inclination), slice.f0)));
    });
    return errors;
}

ErrorSummary summary_of(std::vector<double> errors) {
    std::sort(errors.begin(), errors.end());
    const auto percentile = [&](std::size_t percent) { return errors[(errors.size() - 1) * percent / 100]; };
    const double mean =
        std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
    return {mean, percentile(50), percentile(90), percentile(99), errors.back()};
}

} // namespace nusselt::fit
