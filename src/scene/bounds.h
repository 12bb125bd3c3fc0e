#pragma once
/// Bounding boxes.

#include "scene/scene.h"
#include "scene/vector_math.h"

#include <limits>

namespace nusselt::scene {

/// An axis-aligned box, empty at first.
struct Bounds {
    Double3 low = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
                   std::numeric_limits<double>::max()};
    Double3 high = -1.0 * low;

    void add(const Double3& p);
};

/// Half the diagonal of a bounding box of surfaces, instances and lights [m], 0 for empty scenes.
double scene_radius(const Scene& scene);

} // namespace nusselt::scene
