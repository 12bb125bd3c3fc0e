#pragma once
/// Vectors of the scene model.

namespace nusselt::scene {

struct Float2 {
    float x, y;
};

struct Float3 {
    float x, y, z;
    bool operator==(const Float3&) const = default;
};

} // namespace nusselt::scene
