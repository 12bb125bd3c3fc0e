#pragma once
/// The data that the renderer passes to kernels: plain data only, so that code compiled for different instruction
/// sets agrees on it. No type of the library appears here, nor any inline function.

#include "base/isa.h"
#include "render/pixel_filter.h"
#include "render/settings.h"
#include "render/tile.h"
#include "scene/model/scene.h"
#include "visibility/line_bvh_view.h"
#include "visibility/ray_packets.h"

#include <cstddef>
#include <cstdint>

namespace nusselt::render_cpu {

using namespace render;

/// A material as a row of floats, so that kernels gather any entry with one stride.
struct MaterialRow {
    float diffuse[3];
    float f0[3];
    float roughness;
    float exponent;
    float model; ///< the number of a scene::BrdfModel
};

struct TextureView {
    const float* texels; ///< as Texture::texels, at most 2^31 floats
    std::int32_t width;
    std::int32_t height;
    std::int32_t channels; ///< 1 or 3
    scene::TextureWrap wrap;
    scene::TextureFilter filter;
};

/// The textures of a material, as in scene::Material. Words of four bytes only, so that kernels gather any of them.
struct MaterialTextures {
    scene::TextureUse diffuse;
    scene::TextureUse f0;
    scene::TextureUse roughness;
    scene::TextureUse normal;
    scene::TextureUse bump;
    float bump_height;
    float is_bump_in_uv; ///< 1 for BumpUnit::texture_coordinate, 0 for metres
};

/// Which textures a material has, as bits.
enum TextureKind : std::uint32_t {
    kDiffuseTexture = 1,
    kF0Texture = 2,
    kRoughnessTexture = 4,
    kNormalTexture = 8,
    kBumpTexture = 16,
};

struct RenderJob;
struct LightSet;

/// A packet of shading points that receive light. Each instruction set derives its own type.
struct LitPacket {};

/// Adds the radiance that a packet reflects of one light.
/// \param index among the lights of the set
using AddLight = void (*)(LitPacket& packet, const LightSet& lights, std::int32_t index) noexcept;

/// The largest number of shapes of one kind of light. Each shape has its own code.
inline constexpr int kMostShapes = 6;

/// The code for a kind of light, compiled for one instruction set.
struct LightCode {
    /// Chooses how a job samples or integrates the lights of each shape.
    void (*choose)(const RenderJob& job, AddLight (&add)[kMostShapes]) noexcept;
    /// The shape of a light, an index into LightSet::add.
    std::int32_t (*shape_of)(const LightSet& lights, std::int32_t index) noexcept;
    /// The radiance along a ray that meets the light.
    scene::Float3 (*emission)(const LightSet& lights, std::int32_t index, const scene::Float3& origin,
                              const scene::Float3& direction) noexcept;
    /// The radiance along a ray that meets nothing; null for kinds that no such ray sees.
    scene::Float3 (*background)(const LightSet& lights, std::int32_t index, const scene::Float3& origin,
                                const scene::Float3& direction) noexcept = nullptr;
};

/// The lights of one kind.
struct LightSet {
    const void* records; ///< in the form that the code of this kind reads
    std::int32_t first;  ///< number of its first light among all lights of the scene
    std::int32_t count;
    LightCode code;
    AddLight add[kMostShapes];
};

/// The LtcTableView of a specular component; without entries if the job does not use them.
struct LtcTableRecord {
    const float* entries;
    std::int32_t roughnesses, inclinations, f0s;
};

/// An instance as kernels need it, in floats only.
struct InstanceRecord {
    float world_from_object[12]; ///< as Instance::world_from_object
    /// Rows of three: inverse transpose of the linear part, times a number above 0.
    float normal_from_object[9];
    float handedness; ///< -1 for mirror images, else 1
    float rounding;   ///< factor by which rounding errors grow on the way to the object and back
};

/// The distribution of camera rays over a pixel along one axis.
struct FilterAxis {
    float reach;             ///< as PixelFilterTable::reach; the radius of a box [pixels]
    const float* cumulative; ///< see PixelFilterTable, null for boxes
    const float* weights;
};

/// Views of the arrays of a scene::Scene, and of precomputed arrays.
struct KernelScene {
    const scene::Float3* positions;
    const scene::Float3* normals;
    const scene::Float2* uvs;
    const scene::Triangle* triangles;
    const std::uint32_t* triangle_material;
    const std::int32_t* triangle_light; ///< among all lights of the scene, -1 for none
    const MaterialRow* materials;
    const std::uint32_t* material_texture_kinds; ///< TextureKind
    const MaterialTextures* material_textures;
    const TextureView* textures;
    const InstanceRecord* instances; ///< null if there are none
    const LightSet* light_sets;
    std::int32_t light_set_count;
    std::int32_t light_count;           ///< of all sets
    const std::uint32_t* light_emitter; ///< of each of them
    std::uint32_t emitter_count;
    LtcTableRecord frostbite_lobes;
    LtcTableRecord phong_lobes;
    scene::Camera camera;
    FilterAxis filter_x, filter_y;
    std::int32_t film_width, film_height;
    float radius; ///< of the scene [m]
};

/// Where jobs store layers beside the image, each in the form of RenderJob::pixels. Layers that nobody asked for are null.
struct LayerTargets {
    float* albedo;
    float* normal;
    float* depth;    ///< one float per pixel
    float* coverage; ///< one float per pixel
    float* pieces;   ///< one float per pixel
    float* emission;
    float* diffuse;
    float* specular;
    float* variance;
    float* const* lights; ///< one layer for each emitter
};

struct RenderJob {
    KernelScene scene;
    visibility::RayTracer tracer;
    LightSamples light_samples;
    LineSettings lines;
    const visibility::LineBvhView* line_bvh; ///< null without line samples
    std::int32_t most_occluders;             ///< see most_occluders_for_lines(); below 0: points everywhere
    std::uint32_t points_in_place_of_lines;
    Technique technique;
    Strategies strategies;
    EmissionSampling emission_sampling;
    Mis mis;
    float visibility_estimate;
    SampleOrder sample_order;
    const unsigned char* blue_noise; ///< the bytes of a BlueNoiseView
    PixelPosition pixel_position;
    std::uint32_t seed;
    std::uint32_t camera_rays;       ///< per pixel
    std::uint32_t samples_per_light; ///< per camera ray, light and technique
    std::int32_t x_begin;            ///< the first pixel of the image, on the film
    std::int32_t y_begin;
    std::int32_t width; ///< of the image
    float* pixels;      ///< three floats for each, as image::Image
    float* rays;        ///< one float for each, as Frame::rays
    bool has_layers;    ///< whether any layer was asked for
    LayerTargets layers;
    const unsigned char* stop_requested; ///< becomes other than 0 at any time once the rendering is to stop
};

/// Bytes in which a kernel sums up all but the layers of lights.
inline constexpr std::size_t kPacketSumBytes = 4096;

/// Floats per emitter and lane in which a kernel sums up layers of lights: a compensated sum of colours.
inline constexpr std::size_t kLightSumFloatsPerLane = 2 * 3;

/// Working memory for line samples.
inline constexpr std::size_t kLineMemoryBytes = std::size_t(1) << 16;

/// The work that tiles took. Times are ticks of the time stamp counter.
struct TileStatistics {
    std::uint64_t primary_ticks;
    std::uint64_t shading_ticks;
    std::uint64_t shadow_ticks;
    std::uint64_t primary_rays;
    std::uint64_t shadow_rays;
    std::uint64_t rejected_samples; ///< see RenderStatistics
    // For line samples, see LineStatistics.
    std::uint64_t line_visibility_ticks;
    std::uint64_t lines;
    std::uint64_t line_parts;
    std::uint64_t line_lights;
    std::uint64_t point_lights;
    visibility::LineCounters line_counters;
};

/// Working memory of one thread, aligned to 64 bytes. The sums of an unfinished tile stay in it, so that the same kernel
/// can go on with them.
struct TileMemory {
    void* packet_sums; ///< kPacketSumBytes
    /// kLightSumFloatsPerLane times the number of lanes, for each emitter; unused without layers of lights.
    float* light_sums;
    /// As many, for the sums before a camera ray that may be given up; unused if there is one camera ray per pixel.
    float* kept_light_sums;
    void* lines; ///< kLineMemoryBytes; unused without line samples
};

/// How far a tile is. All zero at first.
struct TileProgress {
    std::uint32_t packet;     ///< number of the first packet of pixels that is not finished
    std::uint32_t camera_ray; ///< how many camera rays it has
};

/// Renders a tile from where it is, and adds its work to the statistics. Any number of threads may render different
/// tiles.
/// \returns whether the tile is finished. If the job was stopped before, its image has all camera rays so far.
using RenderTile = bool (*)(const RenderJob& job, const Tile& tile, const TileMemory& memory,
                            TileProgress& progress, TileStatistics& statistics);

/// Distinguishes kernels that are compiled from the same source for different instruction sets.
template <int kLanes>
struct LaneCount {};

} // namespace nusselt::render_cpu
