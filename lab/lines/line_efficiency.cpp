#include "lab/lines/line_efficiency.h"

#include "base/process_time.h"
#include "lab/errors/image_errors.h"
#include "proof/median.h"

#include <algorithm>

namespace nusselt::lab {

namespace {

/// A curve in the making.
struct Series {
    render::RenderSettings settings;
    std::vector<int> counts;
    std::vector<double> variances;            ///< for each count, sum over the rounds
    std::vector<std::vector<double>> seconds; ///< for each count, of all rounds
    std::vector<double> means;                ///< radiance, for each count, sum over the rounds

    Series(const render::RenderSettings& with, int first, int last) : settings(with) {
        for (int n = first; n <= last; n *= 2) counts.push_back(n);
        variances.resize(counts.size());
        seconds.resize(counts.size());
        means.resize(counts.size());
    }

    /// Does nothing if there is no such count.
    void render(const render_cpu::Renderer& renderer, base::Isa isa, int threads, int round, std::size_t i) {
        if (i >= counts.size()) return;
        settings.seed = static_cast<std::uint32_t>(round * kSeedsPerRound);
        const double begin = base::process_seconds();
        const SeedStatistics result =
            render_seeds(renderer, isa, with_count(settings, counts[i]), kSeedsPerRound);
        seconds[i].push_back((base::process_seconds() - begin) / (kSeedsPerRound * threads));
        variances[i] += result.variance;
        means[i] += mean_radiance(result.mean);
    }

    NoiseCurve curve() const {
        NoiseCurve result;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const std::size_t rounds = seconds[i].size();
            result.push_back({counts[i], variances[i] / static_cast<double>(rounds),
                              proof::median(seconds[i]), static_cast<int>(rounds) * kSeedsPerRound});
        }
        return result;
    }
};

double seconds_to(const NoiseCurve& curve, double variance) {
    if (variance >= curve.front().variance) return curve.front().seconds;
    return seconds_to_variance(curve, variance);
}

} // namespace

LineEfficiency measure_line_efficiency(const render_cpu::Renderer& renderer, base::Isa isa,
                                       const LineEfficiencySettings& settings,
                                       const std::function<void(int round)>& progress) {
    render::RenderSettings with_lines = settings.points;
    with_lines.light_samples = render::LightSamples::lines;
    with_lines.lines = settings.lines;
    with_lines.lines.many_occluders = render::ManyOccluders::lines;
    render::RenderSettings with_choice = with_lines;
    with_choice.lines.many_occluders = render::ManyOccluders::points;

    Series points(settings.points, kFewestPoints, settings.most_points);
    Series lines(with_lines, 1, settings.most_lines);
    Series choice(with_choice, 1, settings.most_lines);
    const std::size_t count = std::max(points.counts.size(), lines.counts.size());
    for (int round = 0; round < settings.rounds; ++round) {
        progress(round);
        for (std::size_t i = 0; i < count; ++i)
            for (Series* series : {&points, &lines, &choice})
                series->render(renderer, isa, settings.threads, round, i);
    }
    return {points.curve(), lines.curve(), choice.curve(), points.means.back() / settings.rounds};
}

std::vector<EqualErrorRow> equal_error_rows(const LineEfficiency& efficiency) {
    std::vector<EqualErrorRow> rows;
    for (const CurvePoint& point : efficiency.points)
        rows.push_back(
            {point.count, point.variance, point.seconds, seconds_to(efficiency.lines, point.variance),
             seconds_to(efficiency.choice, point.variance), point.variance < efficiency.lines.back().variance,
             point.variance < efficiency.choice.back().variance});
    return rows;
}

std::optional<int> crossover(const std::vector<EqualErrorRow>& rows) {
    std::optional<int> first;
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
        if (row->lines_are_extrapolated) continue;
        if (row->lines_over_points() >= 1) break;
        first = row->points;
    }
    return first;
}

double largest_loss(const std::vector<EqualErrorRow>& rows) {
    double largest = 0;
    for (const EqualErrorRow& row : rows)
        if (!row.lines_are_extrapolated && !row.choice_is_extrapolated)
            largest = std::max(largest, row.loss());
    return largest;
}

void make_glossy(scene::Scene& scene, float roughness) {
    for (scene::Material& material : scene.materials) {
        material.model = scene::BrdfModel::frostbite;
        material.f0 = {0.04f, 0.04f, 0.04f};
        material.f0_texture = {};
        material.roughness = roughness;
        material.roughness_texture = {};
    }
}

} // namespace nusselt::lab
