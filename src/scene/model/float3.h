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

/// For what is prepared once per scene, see vector_math.h.
struct Double3 {
    double x = 0, y = 0, z = 0;
    bool operator==(const Double3&) const = default;
};

} // namespace nusselt::scene
