#include "scene/build/polygons/polygon_triangulation.h"
#include "scene/build/tessellate.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nusselt::scene {

namespace {

// The largest distance of the pieces of a curved patch from it, relative to its longest side; lights cost time per piece.
constexpr double kSurfaceTolerance = 1e-3;
constexpr double kLightTolerance = 1e-2;
constexpr double kMaxPieces = 1e6; ///< for all patches of a mesh

/// Values at the corners in the order of scene files: (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
template <class T>
using Corners = std::array<T, 4>;

Double3 interpolate(const Corners<Double3>& c, double u, double v) {
    return (1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[2] + u * c[3]);
}

struct Patch {
    Corners<Double3> positions;
    Corners<Double3> normals; ///< zero for missing ones
    Corners<Double3> uvs;     ///< z is unused

    double longest_side() const {
        return std::max({length(positions[1] - positions[0]), length(positions[3] - positions[1]),
                         length(positions[2] - positions[3]), length(positions[0] - positions[2])});
    }
    /// The difference between opposite sides.
    Double3 twist() const { return (positions[0] - positions[1]) - (positions[2] - positions[3]); }
    bool is_planar() const {
        const Double3 along_u = positions[1] - positions[0];
        const Double3 along_v = positions[2] - positions[0];
        Double3 normal = normalized(cross(along_u, along_v));
        if (length(normal) == 0) normal = normalized(cross(positions[3] - positions[0], along_v));
        constexpr double kTolerance = 1e-5;
        return std::fabs(dot(positions[3] - positions[0], normal)) <= kTolerance * longest_side();
    }
    Double3 normal_at(double u, double v) const {
        const Double3 given = interpolate(normals, u, v);
        if (length(given) > 0) return normalized(given);
        const Double3 along_u = (1 - v) * (positions[1] - positions[0]) + v * (positions[3] - positions[2]);
        const Double3 along_v = (1 - u) * (positions[2] - positions[0]) + u * (positions[3] - positions[1]);
        return normalized(cross(along_u, along_v));
    }
};

/// The patch whose four indices begin at this one.
Patch patch_at(const BilinearPatches& patches, std::size_t first_index) {
    Patch patch;
    for (std::size_t j = 0; j < 4; ++j) {
        const std::uint32_t vertex = patches.indices[first_index + j];
        patch.positions[j] = to_double(patches.positions[vertex]);
        patch.normals[j] = patches.normals.empty() ? Double3{} : to_double(patches.normals[vertex]);
        patch.uvs[j] = patches.uvs.empty()
                           ? Double3{static_cast<double>(j % 2), static_cast<double>(j / 2), 0}
                           : Double3{patches.uvs[vertex].x, patches.uvs[vertex].y, 0};
    }
    return patch;
}

void add_vertex(const Patch& patch, double u, double v, const Double3& normal, Mesh& mesh) {
    const Double3 uv = interpolate(patch.uvs, u, v);
    mesh.positions.push_back(to_float(interpolate(patch.positions, u, v)));
    mesh.normals.push_back(to_float(normal));
    mesh.uvs.push_back({static_cast<float>(uv.x), static_cast<float>(uv.y)});
}

void add_planar_patch(const Patch& patch, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    constexpr std::uint32_t kAround[] = {0, 1, 3, 2};
    std::vector<Double3> outline;
    for (const std::uint32_t corner : kAround) {
        outline.push_back(patch.positions[corner]);
        add_vertex(patch, corner % 2, corner / 2, patch.normals[corner], mesh);
    }
    for (const Triangle& t : triangulate_polygon(outline))
        mesh.triangles.push_back({{first + t.vertex[0], first + t.vertex[1], first + t.vertex[2]}});
}

/// \returns the number of pieces per side
int add_curved_patch(const Patch& patch, double tolerance, int max_pieces, Mesh& mesh) {
    // In the middle of a piece, the two triangles that replace it are off by a quarter of its twist.
    const double pieces = std::sqrt(length(patch.twist()) / (4 * tolerance * patch.longest_side()));
    const int n = std::clamp(static_cast<int>(std::ceil(pieces)), 1, max_pieces);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int row = 0; row <= n; ++row) {
        for (int column = 0; column <= n; ++column) {
            const double u = static_cast<double>(column) / n;
            const double v = static_cast<double>(row) / n;
            add_vertex(patch, u, v, patch.normal_at(u, v), mesh);
        }
    }
    const auto stride = static_cast<std::uint32_t>(n) + 1;
    for (std::uint32_t row = 0; row + 1 < stride; ++row) {
        for (std::uint32_t column = 0; column + 1 < stride; ++column) {
            const std::uint32_t corner = first + row * stride + column;
            mesh.triangles.push_back({{corner, corner + 1, corner + stride + 1}});
            mesh.triangles.push_back({{corner, corner + stride + 1, corner + stride}});
        }
    }
    return n;
}

} // namespace

Mesh tessellate(const BilinearPatches& patches, const PlacedShape& placed, Warnings& warnings) {
    const std::vector<std::uint32_t>& indices = patches.indices;
    const double tolerance = is_black(placed.shape->emission.radiance) ? kSurfaceTolerance : kLightTolerance;

    const double pieces_per_patch = 4 * kMaxPieces / static_cast<double>(indices.size());
    const int max_pieces = std::clamp(static_cast<int>(std::sqrt(pieces_per_patch)), 1, placed.max_sides / 2);

    Mesh mesh;
    std::size_t curved_patches = 0;
    int most_pieces = 0;
    for (std::size_t i = 0; i < indices.size(); i += 4) {
        const Patch patch = patch_at(patches, i);
        if (patch.is_planar()) {
            add_planar_patch(patch, mesh);
        } else {
            ++curved_patches;
            most_pieces = std::max(most_pieces, add_curved_patch(patch, tolerance, max_pieces, mesh));
        }
    }
    if (curved_patches > 0)
        warnings.add(placed.shape->origin, "curved bilinear patches",
                     subject_of(*placed.shape) + ": " + std::to_string(curved_patches) +
                         " curved patches are split into at most " + std::to_string(most_pieces) + " x " +
                         std::to_string(most_pieces) + " quads each");
    return mesh;
}

bool are_planar(const BilinearPatches& patches) {
    for (std::size_t i = 0; i < patches.indices.size(); i += 4)
        if (!patch_at(patches, i).is_planar()) return false;
    return true;
}

} // namespace nusselt::scene
