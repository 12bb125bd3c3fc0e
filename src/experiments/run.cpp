#include "experiments/run.h"

#include "image/metrics.h"
#include "render_cpu/film.h"
#include "render_cpu/renderer.h"
#include "scene/load.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nusselt::experiments {

namespace {

/// Traces rays like that of a scene, but nothing blocks shadow rays.
visibility::RayTracer without_shadows(visibility::RayTracer tracer) {
    const auto nothing = []<int N>(const void*, std::uint32_t, const visibility::RayPacket<N>&) {
        return 0u;
    };
    tracer.visibility::PacketTracer<4>::occluded = nothing;
    tracer.visibility::PacketTracer<8>::occluded = nothing;
    tracer.visibility::PacketTracer<16>::occluded = nothing;
    return tracer;
}

/// Which pixels see each light entirely or not at all. Uniform samples of the area of the lights decide, with
/// and without shadows: outside of penumbrae both images agree to the bit, or that with shadows is black.
/// Independent of the techniques under test except area sampling.
std::vector<bool> outside_penumbrae(const render_cpu::Renderer& renderer, render_cpu::Isa isa,
                                    const render_cpu::RenderSettings& reference) {
    render_cpu::RenderSettings settings = reference;
    settings.technique = render_cpu::Technique::area;
    const image::Image traced = renderer.render(settings, isa).image;
    const auto open = without_shadows(renderer.visibility().tracer());
    const image::Image unshadowed = renderer.render(settings, isa, open).image;
    std::vector<bool> mask(traced.pixels.size() / 3);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        const float* a = &traced.pixels[3 * i];
        const float* b = &unshadowed.pixels[3 * i];
        mask[i] = std::equal(a, a + 3, b) || (a[0] == 0 && a[1] == 0 && a[2] == 0);
    }
    return mask;
}

double mean_radiance(const image::Image& image) {
    double sum = 0;
    for (const float value : image.pixels) sum += value;
    return sum / static_cast<double>(image.pixels.size());
}

/// Root mean square difference over the channels of the pixels in the mask.
double rmse_in(const std::vector<bool>& mask, const image::Image& a, const image::Image& reference) {
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (!mask[i]) continue;
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const double difference =
                static_cast<double>(a.pixels[c]) - static_cast<double>(reference.pixels[c]);
            sum += difference * difference;
        }
        count += 3;
    }
    return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

double measured(const ExperimentResult& result, const std::string& variant, Metric metric) {
    const auto found = std::find_if(result.variants.begin(), result.variants.end(),
                                    [&](const VariantResult& v) { return v.label == variant; });
    if (found == result.variants.end())
        throw std::logic_error("experiment " + result.experiment->name + " expects something of " + variant +
                               ", which it does not render");
    return metric == Metric::rmse ? found->rmse : found->rmse_outside_penumbrae;
}

bool holds(const ExperimentResult& result, const Expectation& expectation) {
    if (const auto* limit = std::get_if<AtMost>(&expectation))
        return measured(result, limit->variant, limit->metric) <= limit->limit;
    const auto& falling = std::get<Falling>(expectation);
    for (std::size_t i = 1; i < falling.variants.size(); ++i)
        if (!(measured(result, falling.variants[i], falling.metric) <
              measured(result, falling.variants[i - 1], falling.metric)))
            return false;
    return true;
}

} // namespace

ExperimentResult run_experiment(const Experiment& experiment, const RunSettings& settings,
                                const std::function<void(std::string_view)>& progress) {
    scene::Scene scene = scene::load_scene(settings.scenes / experiment.scene);
    if (settings.width > 0) {
        const double height = static_cast<double>(scene.film.height) * settings.width / scene.film.width;
        render_cpu::resize_film(scene, settings.width, std::max(1, static_cast<int>(std::lround(height))));
    }
    const int threads = settings.threads > 0 ? settings.threads : render_cpu::default_thread_count();
    const render_cpu::Renderer renderer(scene, threads);
    const render_cpu::Isa isa = render_cpu::choose_isa();

    ExperimentResult result;
    result.experiment = &experiment;
    result.reference_settings = experiment.reference;
    if (settings.reference_samples > 0) result.reference_settings.samples = settings.reference_samples;
    progress(fmt::format("reference, {} samples per pixel", result.reference_settings.samples));
    result.reference = renderer.render(result.reference_settings, isa).image;
    result.mean = mean_radiance(result.reference);
    progress("penumbrae");
    const std::vector<bool> mask = outside_penumbrae(renderer, isa, result.reference_settings);
    result.share_outside_penumbrae =
        static_cast<double>(std::count(mask.begin(), mask.end(), true)) / static_cast<double>(mask.size());

    for (const Variant& variant : experiment.variants) {
        progress(variant.label);
        render_cpu::RenderResult rendered = renderer.render(variant.settings, isa);
        const image::Comparison comparison = image::compare(rendered.image, result.reference);
        VariantResult row;
        row.label = variant.label;
        row.seconds = rendered.statistics.render_seconds;
        row.rmse = comparison.rmse;
        row.rmse_outside_penumbrae = rmse_in(mask, rendered.image, result.reference) / result.mean;
        row.invalid_pixels = comparison.invalid_a.count;
        row.image = std::move(rendered.image);
        result.variants.push_back(std::move(row));
    }
    for (const Expectation& expectation : experiment.expectations)
        result.expectations.push_back({to_text(expectation), holds(result, expectation)});
    return result;
}

} // namespace nusselt::experiments
