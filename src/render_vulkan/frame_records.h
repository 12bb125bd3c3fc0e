#pragma once
/// Camera rays: one per pixel and frame.

#include "interface/scene.h"
#include "render/pixel_filter.h"
#include "render/settings.h"
#include "scene/model/scene.h"

namespace nusselt::render_vulkan {

/// Makes the parameters of each frame.
class FrameRecords {
public:
    /// \throws std::runtime_error see make_filter_table()
    FrameRecords(const scene::Film& film, const render::RenderSettings& settings);

    std::uint32_t count() const { return count_; }

    /// All pixels share one random offset from their centres, with the distribution of the pixel filter.
    /// \param number below count()
    interface::FrameRecord make(std::uint32_t number) const;

private:
    render::RenderSettings settings_;
    std::uint32_t count_;
    scene::PixelFilter filter_;
    render::PixelFilterTable table_x_, table_y_;
};

} // namespace nusselt::render_vulkan
