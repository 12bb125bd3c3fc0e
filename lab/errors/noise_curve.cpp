#include "lab/errors/noise_curve.h"

#include "proof/median.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace nusselt::lab {

render::RenderSettings with_count(render::RenderSettings settings, int count) {
    (settings.light_samples == render::LightSamples::lines ? settings.lines.count : settings.samples) = count;
    return settings;
}

SeedStatistics render_seeds(const render_cpu::Renderer& renderer, base::Isa isa,
                            render::RenderSettings settings, int seeds) {
    std::vector<double> means, squares, seconds, variances;
    SeedStatistics result;
    for (int i = 0; i < seeds; ++i, ++settings.seed) {
        render::RenderResult frame = renderer.render(settings, isa);
        seconds.push_back(frame.statistics.render_seconds);
        const std::vector<float>& pixels = frame.image.pixels;
        means.resize(pixels.size());
        squares.resize(pixels.size());
        // Welford's updates: no difference of large sums.
        double growth = 0;
        for (std::size_t k = 0; k < pixels.size(); ++k) {
            const double deviation = static_cast<double>(pixels[k]) - means[k];
            means[k] += deviation / (i + 1);
            const double square = deviation * (static_cast<double>(pixels[k]) - means[k]);
            squares[k] += square;
            growth += square;
        }
        // By Helmert's transformation, what each frame but the first adds is an estimate of the variance, uncorrelated with
        // the others.
        if (i > 0) variances.push_back(growth / static_cast<double>(pixels.size()));
        result.mean = std::move(frame.image);
    }
    double sum = 0;
    for (std::size_t k = 0; k < means.size(); ++k) {
        result.mean.pixels[k] = static_cast<float>(means[k]);
        sum += squares[k] / (seeds - 1);
    }
    result.variance = sum / static_cast<double>(means.size());
    double deviations = 0;
    for (const double v : variances) deviations += (v - result.variance) * (v - result.variance);
    if (seeds > 2) result.variance_error = std::sqrt(deviations / (seeds - 1) / (seeds - 2));
    result.seconds = proof::median(std::move(seconds));
    return result;
}

PowerLaw fit_power_law(const std::vector<double>& x, const std::vector<double>& y) {
    double mean_x = 0, mean_y = 0;
    const auto count = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += std::log(x[i]) / count;
        mean_y += std::log(y[i]) / count;
    }
    double xx = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double d = std::log(x[i]) - mean_x;
        xx += d * d;
        xy += d * (std::log(y[i]) - mean_y);
    }
    if (!(xx > 0)) throw std::invalid_argument("a power law needs two different abscissae");
    return {xy / xx, std::exp(mean_y - xy / xx * mean_x)};
}

double fitted_order(const NoiseCurve& curve, int first, int last) {
    std::vector<double> counts, deviations;
    for (const CurvePoint& p : curve) {
        if (p.count < first || p.count > last) continue;
        if (!(p.variance > 0)) return -std::numeric_limits<double>::infinity();
        counts.push_back(p.count);
        deviations.push_back(std::sqrt(p.variance));
    }
    return fit_power_law(counts, deviations).exponent;
}

double seconds_to_variance(const NoiseCurve& curve, double variance) {
    if (curve.size() < 2) throw std::invalid_argument("a curve needs two points");
    std::size_t end = 1;
    while (end + 1 < curve.size() && curve[end].variance > variance) ++end;
    const CurvePoint& a = curve[end - 1];
    const CurvePoint& b = curve[end];
    const PowerLaw law = fit_power_law({a.variance, b.variance}, {a.seconds, b.seconds});
    return law.factor * std::pow(variance, law.exponent);
}

} // namespace nusselt::lab
