#pragma once
/// A rendering that is over.

#include "image/image.h"
#include "image/layers.h"
#include "render/frame.h"
#include "render/statistics.h"

#include <vector>

namespace nusselt::render {

struct RenderResult {
    image::Image image;               ///< pixels that were not rendered are black
    std::vector<image::Layer> layers; ///< see make_frame()
    RenderStatistics statistics;
    double finished_fraction = 0; ///< of the work; below 1 if it was cancelled
};

/// \param frame is moved from
RenderResult to_result(Frame&& frame, const RenderStatistics& statistics);

} // namespace nusselt::render
