#include "render_vulkan/frame_records.h"

#include "render/choices/sampler.h"

#include <nusselt/random/light_random.h>

#include <algorithm>
#include <cstddef>

namespace nusselt::render_vulkan {

namespace {

/// Maps a random number to the offset along one axis, and multiplies the weight by that of the filter.
float filtered_offset(const render::PixelFilterTable& table, float radius, float u, float& weight) {
    if (table.cumulative.empty()) return radius * (2 * u - 1);
    const auto next = std::upper_bound(table.cumulative.begin() + 1, table.cumulative.end() - 1, u);
    const auto cell = static_cast<std::size_t>(next - table.cumulative.begin()) - 1;
    const float below = table.cumulative[cell];
    const float part = (u - below) / (table.cumulative[cell + 1] - below);
    weight *= table.weights[cell];
    const float position = (static_cast<float>(cell) + part) / render::kFilterCells;
    return table.reach * (2 * position - 1);
}

} // namespace

FrameRecords::FrameRecords(const scene::Film& film, const render::RenderSettings& settings)
    : settings_(settings),
      count_(static_cast<std::uint32_t>(camera_ray_count(settings))),
      filter_(film.filter),
      table_x_(render::make_filter_table(filter_, filter_.radius_x)),
      table_y_(render::make_filter_table(filter_, filter_.radius_y)) {}

interface::FrameRecord FrameRecords::make(std::uint32_t number) const {
    interface::FrameRecord record {};
    record.weight = 1;
    if (settings_.pixel_position != render::PixelPosition::center) {
        const auto u = camera_random(sampler_of(settings_.sample_order), settings_.seed, 0, 0, number);
        record.offset[0] = filtered_offset(table_x_, filter_.radius_x, u.x, record.weight);
        record.offset[1] = filtered_offset(table_y_, filter_.radius_y, u.y, record.weight);
    }
    record.number = number;
    record.count = count_;
    // Integrals need no samples.
    const bool is_analytic = settings_.technique == render::Technique::ltc_analytic;
    record.light_samples = is_analytic ? 1 : static_cast<std::uint32_t>(settings_.samples) / count_;
    record.seed = settings_.seed;
    record.visibility_estimate = settings_.visibility_estimate;
    record.mis = static_cast<std::int32_t>(settings_.mis);
    record.loop_probe = 2;
    return record;
}

} // namespace nusselt::render_vulkan
