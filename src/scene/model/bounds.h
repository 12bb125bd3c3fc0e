#pragma once
/// Bounding boxes of the parts of a scene.

#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <array>
#include <cstddef>

namespace nusselt::scene {

/// A box along the axes. A new one is empty: low > high.
struct Bounds {
    Bounds();
    bool is_empty() const { return low.x > high.x; }
    void add(const Double3& p);
    void add(const Bounds& other);

    Double3 low;
    Double3 high;
};

/// The bounds of the triangles from `first` on, in their own coordinates.
Bounds triangle_bounds(const Scene& scene, std::size_t first, std::size_t count);

/// The box around the image of a box under an affine transform with the rows of Instance.
Bounds transformed(const Bounds& box, const std::array<float, 12>& rows);

/// The box around surfaces, instances and lights.
Bounds scene_bounds(const Scene& scene);

/// Half the diagonal of scene_bounds() [m], 0 for empty scenes.
double scene_radius(const Scene& scene);

} // namespace nusselt::scene
