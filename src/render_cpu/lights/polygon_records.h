#pragma once
/// Polygonal lights in the form that kernels read: plain data, see kernel.h.

#include "render_cpu/kernel.h"
#include "render_cpu/lights/profile_record.h"

#include <cstdint>
#include <memory>

namespace nusselt::render_cpu {

/// Columns and rows of the lattice of cells over a textured light.
inline constexpr int kTextureCells = 8;

/// The texture of a polygon.
struct PolygonTexture {
    // A TexturePlane<float> in world space.
    scene::Float3 corner, side_x, side_y, normal;
    const scene::Float3* radiance; ///< texels [W/(sr m^2)], as TextureView<float>
    std::int32_t width, height;
    scene::Float3 inverse_mean; ///< of the radiance; 0 for channels that are black everywhere
    const void* cells;          ///< a TexturedLight<float, kTextureCells>
};

/// How the radiance of a polygon depends on the direction.
struct PolygonProfile : ProfileRecord {
    scene::Float3 hole_axis;     ///< along which the holes of the honeycomb lie, in world space
    scene::Float2 inverse_holes; ///< over the slopes of the honeycomb along and across it, 0 for none
    const void*
        side[2]; ///< WindowedLight<float> of the front and, if it emits, of the back; of a mean radiance of 1
};

/// A polygon in the form of ConvexPolygon<float, 4> or <float, 8>. Its vertices and then its edges are in
/// PolygonRecords::corners.
struct PolygonRecord {
    scene::Float3 normal;
    scene::Float3 radiance;
    std::uint32_t first_corner;
    std::int32_t slots; ///< room for vertices, and for as many edges: 4 or 8
    std::int32_t two_sided;
    std::int32_t texture; ///< index into PolygonRecords::textures, -1 for none
    std::int32_t profile; ///< index into PolygonRecords::profiles, -1 for none
};

struct PolygonRecords {
    const PolygonRecord* lights;
    const scene::Float3* corners;
    const PolygonTexture* textures;
    const PolygonProfile* profiles;
};

/// Makes PolygonRecords, see LightKernel. Fails if a polygon has fewer than 3 vertices, or if the scene has more polygons
/// than 32-bit indices can address.
std::shared_ptr<const void> make_polygon_records(const scene::Scene& scene, const scene::LightList& list);

// In kernel/lights/polygon.cpp.
LightCode polygon_code(LaneCount<4>), polygon_code(LaneCount<8>), polygon_code(LaneCount<16>);

} // namespace nusselt::render_cpu
