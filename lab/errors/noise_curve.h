#pragma once
/// Noise and time of renderings over the number of samples.

#include "image/image.h"
#include "render_cpu/renderer.h"

#include <functional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// Noise and time of renderings with one number of samples.
struct CurvePoint {
    int count = 0;             ///< points or lines per shading point and light
    double variance = 0;       ///< mean square error due to noise: mean over pixels and channels [radiance^2]
    double seconds = 0;        ///< of the render phase, median over the seeds
    int seeds = 0;             ///< images that were rendered
    double variance_error = 0; ///< standard error of the variance
};

/// The points of a curve, from few to many samples.
using NoiseCurve = std::vector<CurvePoint>;

/// The settings with this many lines if there are line samples, else with this many point samples.
render::RenderSettings with_count(render::RenderSettings settings, int count);

/// Statistics of an image over several seeds.
struct SeedStatistics {
    image::Image mean;
    double variance = 0;       ///< of one image, mean over pixels and channels; unbiased
    double variance_error = 0; ///< its standard error; 0 for two seeds
    double seconds = 0;        ///< of the render phase, median
};

/// Renders with seeds that follow the one of the settings.
/// \param seeds at least 2
/// \throws std::invalid_argument, std::runtime_error see Renderer::render()
SeedStatistics render_seeds(const render_cpu::Renderer& renderer, base::Isa isa,
                            render::RenderSettings settings, int seeds);

/// y = factor x^exponent
struct PowerLaw {
    double exponent = 0;
    double factor = 0;
};

/// The least squares fit of logarithms. All numbers must be positive.
/// \throws std::invalid_argument if there are less than two different x
PowerLaw fit_power_law(const std::vector<double>& x, const std::vector<double>& y);

/// The order of convergence: the exponent of the standard deviation over the number of samples, fitted to the points of
/// the curve from `first` to `last` samples. -infinity if one of them has no noise at all.
double fitted_order(const NoiseCurve& curve, int first, int last);

/// Time until the variance is as low as this: interpolated between points of the curve, extrapolated from two at its ends,
/// along lines in logarithmic axes. The curve must fall.
/// \throws std::invalid_argument if the curve has less than two points
double seconds_to_variance(const NoiseCurve& curve, double variance);

} // namespace nusselt::lab
