#pragma once
/// The scene model: what importers produce and renderers consume. Plain data in world space; units are
/// metres and W/(sr m^2). Types of include/nusselt do not appear here on purpose: their names differ between
/// instruction sets, while this data crosses from baseline code into code compiled for each of them.

#include "scene/model/float3.h"
#include "scene/model/lights/light_kinds.h"
#include "scene/model/lights/profiled_emission.h"
#include "scene/model/lights/textured_emission.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::scene {

/// The values of a texture outside of the unit square.
enum class TextureWrap : std::uint32_t {
    repeat, ///< those of the unit square, repeated
    clamp,  ///< those of the nearest texel of the border
    black,  ///< 0
};

enum class TextureFilter : std::uint32_t { bilinear, nearest };

/// Linear texels. Row 0 is the row at texture coordinate v = 0 (the bottom of the image file), texel centres lie at
/// (i + 0.5) / size.
struct Texture {
    std::string name = {};
    int width = 0;
    int height = 0;
    std::vector<float> texels = {}; ///< channels * width * height; finite and not negative
    int channels = 3;               ///< 3 for RGB, 1 for grey
    TextureWrap wrap = TextureWrap::repeat;
    TextureFilter filter = TextureFilter::bilinear;
    std::string path = {}; ///< of its file, so that two mentions of one file are the same; empty for others
};

/// Where a surface looks up a texture: at scale * uv + offset.
struct TextureUse {
    int texture = -1; ///< index into Scene::textures, -1 for none
    Float2 scale = {1, 1};
    Float2 offset = {0, 0};
};

enum class BrdfModel : std::uint32_t {
    lambert,   ///< diffuse / pi; f0, roughness and exponent are unused
    frostbite, ///< Disney diffuse (renormalised) plus GGX; the exponent is unused
    phong, ///< diffuse / pi plus f0 (n + 2) / (2 pi) times a power n of the cosine with the mirrored direction
};

/// The unit of the heights of bump maps.
enum class BumpUnit : std::uint32_t {
    metre,
    /// As in pbrt v3, on triangles with normals: the derivatives of the position by the texture coordinates count as
    /// unit vectors, and point backwards. Other triangles: metres.
    texture_coordinate,
};

/// The material of a surface (docs/materials.md lists how others reduce to it). Textures are
/// multiplied by the numbers beside them; where those are no colours, the first channel of a texture counts.
struct Material {
    std::string name = {};
    BrdfModel model = BrdfModel::lambert;
    Float3 diffuse = {0.5f, 0.5f, 0.5f}; ///< diffuse albedo
    TextureUse diffuse_texture = {};
    Float3 f0 = {0.04f, 0.04f, 0.04f}; ///< specular reflectance at normal incidence
    TextureUse f0_texture = {};
    float roughness = 1.0f; ///< perceptual roughness in [0, 1]; the GGX alpha is its square
    TextureUse roughness_texture = {};
    float exponent = 100.0f; ///< n of Phong lobes, 0 or from 1 to kLargestPhongExponent
    float alpha = 1.0f;      ///< probability that the surface is there
    TextureUse alpha_texture = {};
    float bump = 1.0f; ///< height of texels of value 1 of the bump texture [bump_unit]
    TextureUse bump_texture = {};
    BumpUnit bump_unit = BumpUnit::metre;
    /// Normals in the tangent frame (dp/du orthogonalised, normal x that, normal), a component n as (n + 1) / 2. Takes
    /// precedence over the bump texture.
    TextureUse normal_texture = {};
};

/// One light as the user sees it: an emissive shape, which may consist of many lights of the renderer. Light rigs and
/// layers of images refer to lights by these.
struct Emitter {
    std::string name;
};

/// A camera whose rays depend linearly on the raster position (x, y), in pixels of the whole film with y downwards and
/// pixel centres at half integers: a ray starts at origin + x * origin_right + y * origin_down and has the (not
/// normalised) direction corner + x * right + y * down. Perspective cameras have rays from one point, orthographic ones
/// parallel rays.
struct Camera {
    Float3 origin = {0, 0, 0};
    Float3 origin_right = {0, 0, 0};
    Float3 origin_down = {0, 0, 0};
    Float3 corner = {0, 0, 1};
    Float3 right = {1, 0, 0};
    Float3 down = {0, 1, 0};
    bool operator==(const Camera&) const = default;
};

enum class FilterKind : std::uint32_t { box, triangle, gaussian, mitchell };

/// How a pixel weights radiance around its centre. The defaults are a box of one pixel.
struct PixelFilter {
    FilterKind kind = FilterKind::box;
    float radius_x = 0.5f; ///< half the width of its support in pixels
    float radius_y = 0.5f;
    float sigma = 0.5f; ///< gaussian: standard deviation in pixels; its value at the radius is subtracted
    float b = 1.0f / 3; ///< mitchell
    float c = 1.0f / 3; ///< mitchell
};

/// Pixels x_begin <= x < x_end, y_begin <= y < y_end of a film.
struct PixelBounds {
    int x_begin = 0;
    int y_begin = 0;
    int x_end = 0;
    int y_end = 0;
};

struct Film {
    int width = 640;
    int height = 480;
    std::optional<PixelBounds> crop = {}; ///< the pixels to render, at least one; default: all
    PixelFilter filter = {};
    std::string filename = {}; ///< as written in the scene file; may be empty
    /// The samples per pixel that the scene file asks for, at least 1; nothing if it leaves them open.
    std::optional<int> pixel_samples = {};
};

struct Triangle {
    std::uint32_t vertex[3];
};

/// Surfaces that instances share, in their own coordinates: a range of Scene::triangles. They do not emit.
struct Object {
    std::string name;
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
};

/// A copy of an object.
struct Instance {
    std::uint32_t object = 0; ///< index into Scene::objects
    /// Affine and invertible; rows of four: the linear part, then the translation.
    std::array<float, 12> world_from_object = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
};

struct Luminaire;

struct Scene {
    // Vertices, all arrays equally long. A zero normal stands for the geometric normal of the triangle.
    std::vector<Float3> positions;
    std::vector<Float3> normals;
    std::vector<Float2> uvs;
    // Triangles, all arrays equally long. The geometric normal is (v1 - v0) x (v2 - v0). Those in world space come
    // first, then those of objects.
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> triangle_material; ///< index into materials
    /// The number of the light, a polygon or a round light, among all lights; -1 for surfaces that do not emit.
    std::vector<std::int32_t> triangle_light;
    std::vector<Object> objects;
    std::vector<Instance> instances;

    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Emitter> emitters;
    Lights lights = no_lights_of_each_kind();        ///< lights of a kind are in the order of their emitters
    std::vector<TexturedEmission> emission_textures; ///< of polygons, tubes and lines
    std::vector<ProfiledEmission> emission_profiles; ///< of polygons, tubes and lines
    std::vector<std::shared_ptr<const Luminaire>> luminaires; ///< of point lights
    std::vector<std::shared_ptr<const EnvironmentMapTexels>> environment_maps;
    Camera camera;
    Film film;

    std::vector<std::filesystem::path> files; ///< it was read from, the scene file first
    std::vector<std::string> warnings;        ///< "file:line: message", in order, each kind once
    double radius = 0; ///< half the diagonal of the bounding box of surfaces and lights [m]
};

/// The emitter of each light, in the order of their numbers.
inline std::vector<std::uint32_t> light_emitters(const Scene& scene) {
    std::vector<std::uint32_t> emitters;
    for (const LightList& list : scene.lights)
        for (std::size_t i = 0; i < list.size(); ++i) emitters.push_back(list.emitter(i));
    return emitters;
}

/// Number of triangles that belong to no object.
inline std::size_t world_triangle_count(const Scene& scene) {
    return scene.objects.empty() ? scene.triangles.size() : scene.objects.front().first_triangle;
}

} // namespace nusselt::scene
