#include "render_vulkan/accumulator.h"

#include "render/film.h"
#include "shaders/visibility_fragment_buffer.h"
#include "shaders/visibility_fragment_images.h"
#include "shaders/visibility_vertex.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string>

namespace nusselt::render_vulkan {

namespace {

const render::RenderSettings& checked(const render::RenderSettings& settings) {
    validate(settings);
    if (const auto reason = why_unsupported(settings)) throw std::invalid_argument(*reason);
    return settings;
}

PixelBuffers make_pixels(const DeviceScene& scene) {
    const scene::PixelBounds bounds = render::rendered_pixels(scene.film());
    return {scene.device(), static_cast<std::uint32_t>(bounds.x_end - bounds.x_begin),
            static_cast<std::uint32_t>(bounds.y_end - bounds.y_begin)};
}

gpu::RasterPass make_visibility_pass(const DeviceScene& scene, const PixelBuffers& pixels) {
    const SceneBuffers& data = scene.buffers();
    const SceneTextures& textures = scene.textures();
    const std::array buffers = {&data.scene,     &data.vertices,      &data.triangles,  &data.instances,
                                &data.materials, &textures.records(), &textures.words()};
    const bool has_images = textures.images() != nullptr;
    gpu::RasterPass pass(scene.device(), shaders::kVisibilityVertex,
                         has_images ? std::span<const std::uint32_t>(shaders::kVisibilityFragmentImages)
                                    : shaders::kVisibilityFragmentBuffer,
                         {.storage_buffers = buffers.size(),
                          .images = textures.images(),
                          .push_constant_size = sizeof(interface::FrameRecord),
                          .constants = constants_of(scene.kinds())},
                         pixels.width, pixels.height);
    pass.bind(buffers);
    return pass;
}

} // namespace

Accumulator::Accumulator(const DeviceScene& scene, const render::RenderSettings& settings)
    : scene_(scene),
      constants_(shading_constants(checked(settings), scene.kinds())),
      pixels_(make_pixels(scene)),
      visibility_(make_visibility_pass(scene, pixels_)) {}

void Accumulator::restart(const render::RenderSettings& settings) {
    const std::vector<std::uint32_t> constants = shading_constants(checked(settings), scene_.kinds());
    if (constants != constants_) {
        shading_.reset();
        constants_ = constants;
    }
    pixels_.clear();
    frames_ = 0;
}

void Accumulator::compile() {
    if (!shading_) shading_.emplace(scene_, constants_, pixels_);
}

FrameTimes Accumulator::add(const interface::FrameRecord& frame) {
    compile();
    FrameTimes times;
    const std::vector<interface::FrameRecord> parts = parts_of(frame);
    for (const interface::FrameRecord& part : parts) {
        std::vector<gpu::Device::Record> passes;
        if (&part == &parts.front())
            passes.push_back([&](const gpu::Device::Commands& commands) {
                visibility_.draw(commands, std::as_bytes(std::span(&part, 1)), 3 * scene_.drawn_triangles(),
                                 pixels_.numbers);
            });
        passes.push_back([&](const gpu::Device::Commands& commands) {
            shading_->record(commands, part, std::min(rows_at_once(frame), height() - part.first_row));
        });
        const std::vector<double> nanoseconds = scene_.device().time_passes(passes);
        if (passes.size() > 1) times.visibility = 1e-9 * nanoseconds.front();
        times.shading += 1e-9 * nanoseconds.back();
    }
    ++frames_;
    return times;
}

std::uint32_t Accumulator::samples_at_once(const interface::FrameRecord& frame) const {
    // Mesa's software device ends the loops of a shader after 65535 rounds in total, those through the hierarchy included:
    // that leaves a thousand for each of 32 pairs of samples.
    const std::uint32_t most = scene_.device().description().is_software ? 32 : 4096;
    return std::min(frame.light_samples, most);
}

std::uint32_t Accumulator::lights_at_once(const interface::FrameRecord& frame) const {
    const std::uint32_t most = scene_.device().description().is_software ? 32 : 4096;
    return std::max(most / frame.light_samples, 1u);
}

std::uint32_t Accumulator::rows_at_once(const interface::FrameRecord& frame) const {
    // About a tenth of a second of a GPU: drivers stop work that takes seconds, since displays wait for it.
    constexpr double kMostSamples = 1e8;
    const std::uint32_t lights = std::clamp(scene_.light_count(), 1u, lights_at_once(frame));
    const double rows = kMostSamples / (static_cast<double>(lights) * samples_at_once(frame) * width());
    const auto together = static_cast<std::uint32_t>(std::clamp<double>(rows, 1, height())) / kRowsTogether;
    return (together + 1) * kRowsTogether;
}

std::vector<interface::FrameRecord> Accumulator::parts_of(const interface::FrameRecord& frame) const {
    std::vector<interface::FrameRecord> parts;
    const std::uint32_t lights = std::max(scene_.light_count(), 1u);
    for (std::uint32_t row = 0; row < height(); row += rows_at_once(frame))
        for (std::uint32_t light = 0; light < lights; light += lights_at_once(frame))
            for (std::uint32_t sample = 0; sample < frame.light_samples; sample += samples_at_once(frame)) {
                interface::FrameRecord& part = parts.emplace_back(frame);
                part.first_row = row;
                part.first_light = light;
                part.light_end = std::min(light + lights_at_once(frame), scene_.light_count());
                part.first_sample = sample;
                part.sample_end = std::min(sample + samples_at_once(frame), frame.light_samples);
            }
    return parts;
}

image::Image Accumulator::mean() const {
    image::Image image = image::make_image(static_cast<int>(width()), static_cast<int>(height()));
    std::vector<interface::PixelSum> sums(image.pixels.size() / 3);
    pixels_.sums.read(std::span(sums));
    const float scale = 1.0f / static_cast<float>(std::max(frames_, 1u));
    for (std::size_t i = 0; i < sums.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) image.pixels[3 * i + k] = scale * sums[i].sum[k];
    return image;
}

FrameWork Accumulator::work() const {
    interface::WorkRecord work {};
    pixels_.work.read(std::span(&work, 1));
    return checked_work(work, scene_.device().description().name);
}

FrameWork checked_work(const interface::WorkRecord& work, const std::string& device) {
    if (work.unfinished > 0)
        throw gpu::Error(
            device + ": the driver stopped a shader before it finished; use another device or --backend cpu");
    if (work.unknown_settings > 0)
        throw gpu::Error(device + ": a setting is not supported by a shader; use --backend cpu");
    const auto joined = [](const std::uint32_t(&words)[2]) {
        return std::uint64_t{words[1]} << 32 | words[0];
    };
    return {joined(work.shadow_rays), joined(work.rejected_samples)};
}

std::optional<std::string> why_unsupported(const render::RenderSettings& settings) {
    const std::string remedy = " not supported on GPUs; use --backend cpu";
    if (settings.light_samples != render::LightSamples::points)
        return "--light-samples " + std::string(name_of(settings.light_samples)) + " is" + remedy;
    if (!settings.layers.empty())
        return "layer " + std::string(name_of(settings.layers.front())) + " is" + remedy;
    if (settings.part.count > 1) return "--part is" + remedy;
    return std::nullopt;
}

} // namespace nusselt::render_vulkan
