#include "render_vulkan/accumulator.h"

#include "render/film.h"
#include "render_vulkan/unsupported.h"
#include "shaders/visibility_fragment_buffer.h"
#include "shaders/visibility_fragment_images.h"
#include "shaders/visibility_vertex.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <stdexcept>
#include <string>

namespace nusselt::render_vulkan {

namespace {

const render::RenderSettings& checked(const render::RenderSettings& settings, const DeviceScene& scene) {
    validate(settings);
    if (const auto reason = why_unsupported(scene.kinds(), settings)) throw std::invalid_argument(*reason);
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
    static_assert(interface::kRoundLightsBinding == interface::kFirstLightBinding);
    const std::array buffers = {&data.scene,       &data.vertices,      &data.triangles,
                                &data.instances,   &data.materials,     &textures.records(),
                                &textures.words(), &data.lights.front()};
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

/// How many groups of that size there are, the last of which may be smaller.
std::uint64_t group_count(std::uint64_t count, std::uint64_t size) { return (count + size - 1) / size; }

} // namespace

Accumulator::Accumulator(const DeviceScene& scene, const render::RenderSettings& settings)
    : scene_(scene),
      constants_(shading_constants(checked(settings, scene), scene.kinds())),
      pixels_(make_pixels(scene)),
      visibility_(make_visibility_pass(scene, pixels_)),
      next_row_(pixels_.height) {}

void Accumulator::restart(const render::RenderSettings& settings) {
    const std::vector<std::uint32_t> constants = shading_constants(checked(settings, scene_), scene_.kinds());
    if (constants != constants_) {
        shading_.reset();
        constants_ = constants;
    }
    pixels_.clear();
    frames_ = 0;
    next_row_ = height();
}

void Accumulator::compile() {
    if (!shading_) shading_.emplace(scene_, constants_, pixels_);
}

FrameTimes Accumulator::add(const interface::FrameRecord& frame) { return *add(frame, nullptr); }

std::optional<FrameTimes> Accumulator::add(const interface::FrameRecord& frame,
                                           const std::atomic<bool>* cancel) {
    begin(frame);
    if (cancel != nullptr && *cancel) return give_up();
    FrameTimes times;
    if (cancel == nullptr || count_parts(height()) == 1) {
        static_cast<void>(add_until(height(), nullptr, times));
        return times;
    }
    if (!sums_before_)
        sums_before_.emplace(scene_.device(), pixels_.sums.size(), gpu::Residence::device_local);
    copy(pixels_.sums, *sums_before_);
    if (add_until(height(), cancel, times)) return times;
    copy(*sums_before_, pixels_.sums);
    return give_up();
}

void Accumulator::begin(const interface::FrameRecord& frame) {
    assert(!is_adding());
    frame_ = frame;
    next_row_ = 0;
}

std::nullopt_t Accumulator::give_up() {
    next_row_ = height();
    return std::nullopt;
}

FrameTimes Accumulator::add_rows(std::uint32_t most_rows) {
    const std::uint32_t groups = (std::clamp(most_rows, 1u, height()) - 1) / kRowsTogether + 1;
    FrameTimes times;
    static_cast<void>(add_until(std::min(next_row_ + groups * kRowsTogether, height()), nullptr, times));
    return times;
}

bool Accumulator::add_until(std::uint32_t end, const std::atomic<bool>* cancel, FrameTimes& times) {
    compile();
    const std::uint64_t count = count_parts(end);
    for (std::uint64_t i = 0; i < count; ++i) {
        if (cancel != nullptr && *cancel) return false;
        const interface::FrameRecord part = make_part(i);
        std::vector<gpu::Device::Record> passes;
        if (part.first_row == 0 && part.first_light == 0 && part.first_sample == 0)
            passes.push_back([&](const gpu::Device::Commands& commands) {
                visibility_.draw(commands, std::as_bytes(std::span(&part, 1)), 3 * scene_.drawn_triangles(),
                                 pixels_.numbers);
            });
        passes.push_back([&](const gpu::Device::Commands& commands) {
            shading_->record(commands, part, std::min(rows_at_once(frame_), end - part.first_row));
        });
        const std::vector<double> nanoseconds = scene_.device().time_passes(passes);
        if (passes.size() > 1) times.visibility = 1e-9 * nanoseconds.front();
        times.shading += 1e-9 * nanoseconds.back();
    }
    next_row_ = end;
    if (!is_adding()) ++frames_;
    return true;
}

void Accumulator::copy(const gpu::Buffer& from, const gpu::Buffer& to) const {
    scene_.device().run([&](const gpu::Device::Commands& commands) {
        commands.copyBuffer(from.handle(), to.handle(), vk::BufferCopy(0, 0, from.size()));
    });
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
    // About a tenth of a second: drivers of GPUs stop work that takes seconds, since displays wait for it.
    const double most_samples = scene_.device().description().is_software ? 1e5 : 1e8;
    const std::uint32_t lights = std::clamp(scene_.light_count(), 1u, lights_at_once(frame));
    const double rows = most_samples / (static_cast<double>(lights) * samples_at_once(frame) * width());
    const auto together = static_cast<std::uint32_t>(std::clamp<double>(rows, 1, height())) / kRowsTogether;
    return (together + 1) * kRowsTogether;
}

std::uint64_t Accumulator::count_parts(std::uint32_t end) const {
    return group_count(end - next_row_, rows_at_once(frame_)) *
           group_count(std::max(scene_.light_count(), 1u), lights_at_once(frame_)) *
           group_count(frame_.light_samples, samples_at_once(frame_));
}

interface::FrameRecord Accumulator::make_part(std::uint64_t index) const {
    const std::uint32_t lights = lights_at_once(frame_);
    const std::uint32_t samples = samples_at_once(frame_);
    const std::uint64_t light_groups = group_count(std::max(scene_.light_count(), 1u), lights);
    const std::uint64_t sample_groups = group_count(frame_.light_samples, samples);
    const std::uint64_t light_group = index / sample_groups % light_groups;
    const std::uint64_t row_group = index / sample_groups / light_groups;
    interface::FrameRecord part = frame_;
    part.first_row = next_row_ + static_cast<std::uint32_t>(row_group) * rows_at_once(frame_);
    part.first_light = static_cast<std::uint32_t>(light_group) * lights;
    part.light_end = std::min(part.first_light + lights, scene_.light_count());
    part.first_sample = static_cast<std::uint32_t>(index % sample_groups) * samples;
    part.sample_end = std::min(part.first_sample + samples, frame_.light_samples);
    return part;
}

image::Image Accumulator::mean() const {
    image::Image image = image::make_image(static_cast<int>(width()), static_cast<int>(height()));
    std::vector<interface::PixelSum> sums(image.pixels.size() / 3);
    pixels_.sums.read(std::span(sums));
    const auto scale_of = [](std::uint32_t frames) {
        return 1.0f / static_cast<float>(std::max(frames, 1u));
    };
    const std::size_t ahead = std::size_t{rows_ahead()} * width();
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const float scale = scale_of(i < ahead ? frames_ + 1 : frames_);
        for (std::size_t k = 0; k < 3; ++k) image.pixels[3 * i + k] = scale * sums[i].sum[k];
    }
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

} // namespace nusselt::render_vulkan
