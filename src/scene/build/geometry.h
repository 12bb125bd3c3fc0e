#pragma once
/// The shapes that importers pass to the builder, in their own coordinates. The right-hand rule gives their normals.

#include "scene/build/mesh.h"
#include "scene/input/diagnostics.h"

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <variant>
#include <vector>

namespace nusselt::scene {

/// A mesh in a file of its own. The builder reads such files in parallel.
struct MeshFile {
    std::filesystem::path path;
    /// Turns the contents into a mesh. Throws std::runtime_error with the reason if it cannot.
    Mesh (*read)(std::string_view bytes) = nullptr;
    Location origin; ///< where the scene names the file
};

/// Quads between four corners each, interpolated bilinearly; not empty.
struct BilinearPatches {
    std::vector<Float3> positions;
    std::vector<Float3> normals; ///< empty or as long as positions
    std::vector<Float2> uvs;     ///< empty or as long as positions
    std::vector<std::uint32_t>
        indices; ///< four per patch: the corners at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1)
};

// Surfaces of revolution around the z axis. A sweep below 360 degrees leaves out a part of the circle.

/// The part of a sphere between two heights, which are clamped to the radius.
struct Sphere {
    double radius = 1; ///< positive
    double z_min = -1;
    double z_max = 1;
    double sweep_degrees = 360;
};

/// A disk with a hole, parallel to the xy plane. It faces +z.
struct Disk {
    double radius = 1;       ///< positive
    double inner_radius = 0; ///< at least 0 and below the radius
    double height = 0;
    double sweep_degrees = 360;
};

/// The lateral surface of a cylinder.
struct Cylinder {
    double radius = 1; ///< positive
    double z_min = -1;
    double z_max = 1;
    double sweep_degrees = 360;
    Location radius_origin; ///< where the radius is given
};

/// A tubular light or a strip, which is no surface: cameras see it, but it casts no shadows.
struct Tube {
    Float3 start = {0, 0, 0};
    Float3 end = {0, 0, 0};
    double radius = 0; ///< positive; of strips, half the width
    TubeModel model = TubeModel::solid;
    Float3 normal = {0, 0,
                     0}; ///< of strips, not along the line; of tubes where the axis of a profile points, or 0
    Location radius_origin; ///< where the radius or width is given
};

using Geometry = std::variant<Mesh, MeshFile, BilinearPatches, Sphere, Disk, Cylinder, Tube>;

} // namespace nusselt::scene
