#include "render/result.h"

#include <utility>

namespace nusselt::render {

RenderResult to_result(Frame&& frame, const RenderStatistics& statistics) {
    RenderResult result;
    result.statistics = statistics;
    result.finished_fraction = finished_fraction(frame);
    result.image = std::move(frame.image);
    result.layers = std::move(frame.layers);
    return result;
}

} // namespace nusselt::render
