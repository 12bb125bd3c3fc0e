#pragma once
/// The data about the transform of an instance that renderers need.

#include "scene/model/scene.h"

#include <array>

namespace nusselt::render {

struct InstanceTransform {
    /// Rows of three: inverse transpose of the linear part, times a number above 0.
    std::array<float, 9> normal_from_object = {};
    float handedness = 1; ///< -1 for mirror images, else 1
    float rounding = 0;   ///< factor by which rounding errors grow on the way to the object and back
};

/// \throws std::runtime_error naming the object if the transform cannot be inverted
InstanceTransform make_instance_transform(const scene::Scene& scene, const scene::Instance& instance);

} // namespace nusselt::render
