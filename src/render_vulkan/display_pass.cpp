#include "render_vulkan/display_pass.h"

#include "interface/display.h"
#include "shaders/display.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace nusselt::render_vulkan {

namespace {

std::uint32_t groups_for(std::uint32_t pixels) { return (pixels - 1) / interface::kDisplayGroupSide + 1; }

interface::ShownSums shown_sums(const Accumulator& image) {
    const auto scale = [](std::uint32_t frames) {
        return frames > 0 ? 1.0f / static_cast<float>(frames) : 0.0f;
    };
    return {scale(image.frames()), scale(image.frames() + 1), image.rows_ahead()};
}

} // namespace

std::string_view name_of(Shown shown) { return shown == Shown::image ? "image" : "error"; }

std::string_view name_of(ToneCurve curve) {
    switch (curve) {
    case ToneCurve::reinhard:
        return "reinhard";
    case ToneCurve::filmic:
        return "filmic";
    case ToneCurve::none:
        break;
    }
    return "none";
}

DisplayPass::DisplayPass(const gpu::Device& device, std::uint32_t width, std::uint32_t height)
    : device_(device),
      width_(width),
      height_(height),
      groups_x_(groups_for(width)),
      groups_y_(groups_for(height)),
      shown_(device, sizeof(std::uint32_t) * width * height, gpu::Residence::read_back),
      squared_errors_(device, 2 * sizeof(float) * groups_x_ * groups_y_, gpu::Residence::read_back),
      pipeline_(device, shaders::kDisplay,
                {.storage_buffers = 5, .push_constant_size = sizeof(interface::DisplayRecord)}),
      pixels_(std::size_t{width} * height),
      errors_(std::size_t{2} * groups_x_ * groups_y_) {}

DisplayErrors DisplayPass::show(const Accumulator& left, const Accumulator& right,
                                const Accumulator& reference, const DisplaySettings& settings) {
    interface::DisplayRecord record;
    record.width = width_;
    record.height = height_;
    record.left = shown_sums(left);
    record.right = shown_sums(right);
    record.reference = shown_sums(reference);
    record.exposure = static_cast<float>(std::exp2(settings.exposure));
    record.wipe = static_cast<std::uint32_t>(std::lround(std::clamp(settings.wipe, 0.0, 1.0) * width_));
    record.tone_curve = static_cast<std::uint32_t>(settings.tone_curve);
    record.shows_error = settings.shown == Shown::error ? 1 : 0;
    pipeline_.bind({&left.sums(), &right.sums(), &reference.sums(), &shown_, &squared_errors_});
    seconds_ = 1e-9 * device_.time([&](const gpu::Device::Commands& commands) {
        pipeline_.dispatch(commands, std::as_bytes(std::span(&record, 1)), groups_x_, groups_y_);
    });
    shown_.read(std::span(pixels_));
    if (reference.frames() == 0) return {};
    squared_errors_.read(std::span(errors_));
    double sums[2] = {0, 0};
    for (std::size_t i = 0; i < errors_.size(); ++i) sums[i % 2] += static_cast<double>(errors_[i]);
    const double values = 3.0 * static_cast<double>(pixels_.size());
    return {std::sqrt(sums[0] / values), std::sqrt(sums[1] / values)};
}

} // namespace nusselt::render_vulkan
