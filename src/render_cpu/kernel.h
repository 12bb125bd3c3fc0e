#pragma once
/// What the renderer hands to the kernels: plain data only, so that code compiled for different instruction
/// sets agrees on it. No type of the library appears here, nor any inline function.

#include "render_cpu/settings.h"
#include "scene/scene.h"
#include "visibility/ray_packets.h"

#include <cstdint>

namespace nusselt::render_cpu {

/// A material as a row of floats, so that kernels gather any entry with one stride.
struct MaterialRow {
    float diffuse[3];
    float f0[3];
    float roughness;
    float is_frostbite; ///< 1, or 0 for Lambert
};

struct TextureView {
    const float* texels; ///< as Texture::texels, at most 2^31 floats
    std::int32_t width;
    std::int32_t height;
};

/// A polygon in the form of ConvexPolygon<float, 4> or <float, 8>. Its vertices and then its edges are in
/// KernelScene::polygon_corners.
struct PolygonLightRecord {
    scene::Float3 normal;
    scene::Float3 radiance;
    std::uint32_t first_corner;
    std::int32_t slots; ///< of vertices, and as many of edges: 4 or 8
    std::int32_t two_sided;
};

/// A tube, its axis in the form of LineSegment<float>.
struct LineLightRecord {
    scene::Float3 begin;
    scene::Float3 direction;
    float length;
    float radius;
    scene::TubeModel model;
    scene::Float3 radiance;
    scene::Float3 radiance_times_radius;
};

/// As LtcTableView, of the specular Frostbite BRDF; no entries if the job has no use for them.
struct LtcTableRecord {
    const float* entries;
    std::int32_t roughnesses, inclinations, f0s;
};

/// Views of the arrays of a scene::Scene, with what kernels need precomputed.
struct KernelScene {
    const scene::Float3* positions;
    const scene::Float3* normals;
    const scene::Float2* uvs;
    const scene::Triangle* triangles;
    const std::uint32_t* triangle_material;
    const std::int32_t* triangle_light;
    const MaterialRow* materials;
    const std::int32_t* material_texture; ///< index into textures, -1 for none
    const TextureView* textures;
    const PolygonLightRecord* polygon_lights;
    const scene::Float3* polygon_corners;
    const LineLightRecord* line_lights;
    std::int32_t polygon_light_count;
    std::int32_t line_light_count;
    LtcTableRecord ltc;
    scene::Camera camera;
    float radius; ///< of the scene [m]
};

struct RenderJob {
    KernelScene scene;
    visibility::RayTracer tracer;
    Technique technique;
    Strategies strategies;
    Mis mis;
    float visibility_estimate;
    SampleOrder sample_order;
    PixelPosition pixel_position;
    std::uint32_t seed;
    std::uint32_t camera_rays;   ///< per pixel
    std::uint32_t light_samples; ///< per camera ray, light and technique
    std::int32_t width;
    std::int32_t height;
    float* pixels; ///< 3 * width * height floats, as image::Image
};

/// Pixels x_begin <= x < x_end, y_begin <= y < y_end.
struct Tile {
    std::int32_t x_begin, y_begin, x_end, y_end;
};

/// Work done for tiles. Times are ticks of the time stamp counter.
struct TileStatistics {
    std::uint64_t primary_ticks;
    std::uint64_t shading_ticks;
    std::uint64_t shadow_ticks;
    std::uint64_t primary_rays;
    std::uint64_t shadow_rays;
    std::uint64_t rejected_samples; ///< see RenderStatistics
};

/// Renders a tile and adds its work to the statistics. Any number of threads may render different tiles.
using RenderTile = void (*)(const RenderJob& job, const Tile& tile, TileStatistics& statistics);

void render_tile_sse42(const RenderJob& job, const Tile& tile, TileStatistics& statistics);
void render_tile_avx2(const RenderJob& job, const Tile& tile, TileStatistics& statistics);
void render_tile_avx512(const RenderJob& job, const Tile& tile, TileStatistics& statistics);

} // namespace nusselt::render_cpu
