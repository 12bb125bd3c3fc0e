#pragma once
/// A rendering that is over.

#include "image/image.h"
#include "image/layers.h"
#include "render/monitor.h"
#include "render/statistics.h"

#include <vector>

namespace nusselt::render {

struct RenderResult {
    image::Image image;               ///< pixels that were not rendered are black
    std::vector<image::Layer> layers; ///< see make_frame()
    RenderStatistics statistics;
    double finished_fraction = 0; ///< of the work; below 1 if it was cancelled
};

} // namespace nusselt::render
