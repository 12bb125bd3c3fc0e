#include "lab/figures/run_image_comparison.h"

#include "lab/figures/technique_image.h"
#include "render/film.h"
#include "render_cpu/renderer.h"
#include "scene/import/importers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

namespace nusselt::lab {

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

/// Shares of a light below a thousandth may go unnoticed.
constexpr int kPenumbraSamples = 1024;

/// Finds the pixels that see each light entirely or not at all. Uniform samples of the area of the lights decide, with
/// and without shadows: outside penumbrae both images agree to the bit, or that with shadows is black.
/// Independent of the techniques under test except area sampling.
std::vector<bool> outside_penumbrae(const render_cpu::Renderer& renderer, base::Isa isa,
                                    const render::RenderSettings& reference) {
    render::RenderSettings settings = reference;
    settings.samples = std::min(settings.samples, kPenumbraSamples);
    settings.technique = render::Technique::area;
    settings.strategies = render::Strategies::diffuse;
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

const VariantResult& variant_of(const ImageComparisonResult& result, const std::string& label) {
    const auto found = std::find_if(result.variants.begin(), result.variants.end(),
                                    [&](const VariantResult& v) { return v.label == label; });
    if (found == result.variants.end())
        throw std::logic_error("comparison " + result.comparison.name + " has an expectation about " + label +
                               ", which it does not render");
    return *found;
}

const RegionErrors& errors_in(const ImageComparisonResult& result, const ImageErrors& errors,
                              const std::string& inset) {
    if (inset.empty()) return errors.frame;
    const std::vector<Inset>& insets = result.comparison.insets;
    for (std::size_t i = 0; i < insets.size(); ++i)
        if (insets[i].name == inset) return errors.insets[i];
    throw std::logic_error("comparison " + result.comparison.name + " has no inset " + inset);
}

double measured(const ImageComparisonResult& result, const std::string& variant, const Metric& metric) {
    const ImageErrors& errors = variant_of(result, variant).errors;
    const RegionErrors& region = errors_in(result, errors, metric.inset);
    switch (metric.measure) {
    case Measure::rmse:
        return region.rmse;
    case Measure::rmse_clamped:
        return region.rmse_clamped;
    case Measure::relative_rmse:
        return region.relative_rmse;
    case Measure::bias:
        return std::fabs(region.relative_bias);
    case Measure::rmse_in_penumbrae:
        return errors.rmse_in_penumbrae;
    case Measure::rmse_blurred:
        return errors.rmse_blurred;
    case Measure::rmse_outside_penumbrae:
        break;
    }
    return errors.rmse_outside_penumbrae;
}

bool holds(const ImageComparisonResult& result, const AtMost& expected) {
    return measured(result, expected.variant, expected.metric) <= expected.limit;
}

bool holds(const ImageComparisonResult& result, const AtMostTimes& expected) {
    const double value = measured(result, expected.variant, expected.metric);
    return std::all_of(expected.others.begin(), expected.others.end(), [&](const std::string& other) {
        return value <= expected.factor * measured(result, other, expected.metric);
    });
}

bool holds(const ImageComparisonResult& result, const Falling& expected) {
    for (std::size_t i = 1; i < expected.variants.size(); ++i)
        if (!(measured(result, expected.variants[i], expected.metric) <
              measured(result, expected.variants[i - 1], expected.metric)))
            return false;
    return true;
}

bool holds(const ImageComparisonResult& result, const Unbiased& expected) {
    return std::all_of(expected.variants.begin(), expected.variants.end(), [&](const std::string& label) {
        const VariantResult& variant = variant_of(result, label);
        if (!variant.bias)
            throw std::logic_error("comparison " + result.comparison.name +
                                   " needs several frames to detect bias");
        return variant.bias->passes();
    });
}

/// Variants and reference have different random numbers: even and odd seeds.
std::uint32_t seed_of_frame(int frame, bool is_reference) {
    return 2 * static_cast<std::uint32_t>(frame) + (is_reference ? 1u : 0u);
}

/// The reference for all frames of all variants.
struct Reference {
    image::Image image;
    BiasStatistics statistics;
};

Reference render_reference(const render_cpu::Renderer& renderer, base::Isa isa,
                           render::RenderSettings settings, int frames) {
    Reference reference;
    std::vector<double> sums;
    for (int i = 0; i < frames; ++i) {
        settings.seed = seed_of_frame(i, true);
        image::Image frame = renderer.render(settings, isa).image;
        reference.statistics.add(frame);
        sums.resize(frame.pixels.size());
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += static_cast<double>(frame.pixels[k]);
        reference.image = std::move(frame);
    }
    for (std::size_t k = 0; k < sums.size(); ++k)
        reference.image.pixels[k] = static_cast<float>(sums[k] / frames);
    return reference;
}

/// An image and the time of its render phase [s], where that counts.
struct TimedImage {
    image::Image image;
    std::optional<double> seconds;
};

/// A scene that a variant changes.
struct OtherScene {
    OtherScene(scene::Scene changed, int threads) : scene(std::move(changed)), renderer(scene, threads) {}

    scene::Scene scene;
    render_cpu::Renderer renderer;
};

/// Renders variants.
class VariantRenderer {
public:
    VariantRenderer(const scene::Scene& scene, const render_cpu::Renderer& renderer, base::Isa isa,
                    int threads)
        : scene_(scene), renderer_(renderer), isa_(isa), threads_(threads) {}

    TimedImage render(const Variant& variant, std::uint32_t seed) {
        if (variant.technique.empty()) {
            render::RenderSettings settings = variant.settings;
            settings.seed = seed;
            render::RenderResult result = renderer_of(variant).render(settings, isa_);
            return {std::move(result.image), result.statistics.render_seconds};
        }
        if (!techniques_) techniques_.emplace(scene_, renderer_);
        return {techniques_->render(variant.technique, seed), {}};
    }

private:
    /// A scene with other tubes has a renderer of its own.
    const render_cpu::Renderer& renderer_of(const Variant& variant) {
        if (!variant.tubes) return renderer_;
        auto& other = others_[*variant.tubes];
        if (other == nullptr) {
            scene::Scene changed = scene_;
            for (scene::LineLight& light : changed.lights.of<scene::LineLight>())
                light.model = *variant.tubes;
            other = std::make_unique<OtherScene>(std::move(changed), threads_);
        }
        return other->renderer;
    }

    const scene::Scene& scene_;
    const render_cpu::Renderer& renderer_;
    base::Isa isa_;
    int threads_;
    std::map<scene::TubeModel, std::unique_ptr<OtherScene>> others_;
    std::optional<TechniqueImages> techniques_; ///< once they are needed
};

VariantResult render_variant(VariantRenderer& renderer, const Variant& variant,
                             const ImageComparison& comparison, const Reference& reference,
                             const std::vector<bool>& outside) {
    ImageErrorSums errors(reference.image, outside, comparison.insets, comparison.blur);
    BiasStatistics statistics;
    VariantResult result;
    result.label = variant.label;
    for (int i = 0; i < comparison.frames; ++i) {
        TimedImage rendered = renderer.render(variant, seed_of_frame(i, false));
        errors.add(rendered.image);
        statistics.add(rendered.image);
        if (rendered.seconds)
            result.seconds = result.seconds.value_or(0) + *rendered.seconds / comparison.frames;
        if (i == 0) result.image = std::move(rendered.image);
    }
    result.errors = errors.errors();
    if (comparison.frames > 1 && comparison.reference_frames > 1)
        result.bias = statistics.compare(reference.statistics);
    return result;
}

} // namespace

ImageComparisonResult run_image_comparison(const ImageComparison& comparison, const RunSettings& settings,
                                           const ProgressText& progress) {
    scene::Scene scene = scene::load_scene(settings.scenes / comparison.scene);
    if (comparison.width > 0) render::resize_film_to_width(scene, comparison.width);
    const render_cpu::Renderer renderer(scene, thread_count(settings));
    const base::Isa isa = base::choose_isa();

    ImageComparisonResult result;
    result.comparison = comparison;
    result.files = scene.files;
    progress(fmt::format("reference, {} samples per pixel",
                         comparison.reference_frames * comparison.reference.samples));
    Reference reference = render_reference(renderer, isa, comparison.reference, comparison.reference_frames);
    result.mean = mean_radiance(reference.image);
    progress("penumbrae");
    const std::vector<bool> mask = outside_penumbrae(renderer, isa, comparison.reference);
    result.share_outside_penumbrae =
        static_cast<double>(std::count(mask.begin(), mask.end(), true)) / static_cast<double>(mask.size());

    VariantRenderer variants(scene, renderer, isa, thread_count(settings));
    for (const Variant& variant : comparison.variants) {
        progress(variant.label);
        result.variants.push_back(render_variant(variants, variant, comparison, reference, mask));
    }
    result.reference = std::move(reference.image);
    for (const Expectation& expectation : comparison.expectations) {
        const bool held = std::visit([&](const auto& e) { return holds(result, e); }, expectation);
        result.expectations.push_back(checked(to_text(expectation), held));
    }
    return result;
}

} // namespace nusselt::lab
