#pragma once
/// The scene model: what importers produce and renderers consume. Plain data in world space; units are
/// metres and W/(sr m^2). Types of include/nusselt do not appear here on purpose: their names differ between
/// instruction sets, while this data crosses from baseline code into code compiled for each of them.

#include <cstdint>
#include <string>
#include <vector>

namespace nusselt::scene {

struct Float2 {
    float x, y;
};

struct Float3 {
    float x, y, z;
};

/// Linear RGB texels, three floats each. Row 0 is the row at texture coordinate v = 0 (the bottom of the
/// image file). Lookups are bilinear with texel centres at (i + 0.5) / size and wrap around.
struct Texture {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<float> texels;
};

enum class BrdfModel : std::uint32_t {
    lambert,   ///< diffuse / pi; f0 and roughness are unused
    frostbite, ///< Disney diffuse (renormalised) plus GGX
};

/// What a surface reduces to (docs/materials.md lists the reductions from the materials of pbrt).
struct Material {
    std::string name;
    BrdfModel model = BrdfModel::lambert;
    Float3 diffuse = {0.5f, 0.5f, 0.5f}; ///< diffuse albedo, multiplied by the texture if there is one
    int diffuse_texture = -1;            ///< index into Scene::textures, -1 for none
    Float3 f0 = {0.04f, 0.04f, 0.04f};   ///< specular reflectance at normal incidence
    float roughness = 1.0f;              ///< perceptual roughness in [0, 1]; the GGX alpha is its square
};

/// A convex planar light of 3 to 8 vertices. It emits `radiance` to the side from which the vertices appear
/// counter-clockwise, or to both sides.
struct PolygonLight {
    std::string name;
    std::vector<Float3> vertices;
    Float3 radiance = {0, 0, 0};
    bool two_sided = false;
};

/// What light a tube gives.
enum class TubeModel : std::uint32_t {
    linear, ///< that of a linear light with brightness radiance * radius [W/(sr m)]: the limit of a small radius
    solid, ///< that of a closed cylinder, which shines outwards from its mantle and its caps
};

/// A tube. Cameras see it as a cylinder of this radius; it casts no shadows.
struct LineLight {
    std::string name;
    Float3 begin = {0, 0, 0};
    Float3 end = {0, 0, 0};
    float radius = 0;
    Float3 radiance = {0, 0, 0};
    TubeModel model = TubeModel::solid;
};

/// Perspective pinhole camera. The ray through raster position (x, y), in pixels with y downwards and pixel
/// centres at half integers, starts at `origin` and has the (not normalised) direction
/// corner + x * right + y * down.
struct Camera {
    Float3 origin = {0, 0, 0};
    Float3 corner = {0, 0, 1};
    Float3 right = {1, 0, 0};
    Float3 down = {0, 1, 0};
};

struct Film {
    int width = 640;
    int height = 480;
    std::string filename; ///< as written in the scene file; may be empty
};

struct Triangle {
    std::uint32_t vertex[3];
};

struct Scene {
    // Vertices, all arrays equally long. A zero normal means: use the geometric normal of the triangle.
    std::vector<Float3> positions;
    std::vector<Float3> normals;
    std::vector<Float2> uvs;
    // Triangles, all arrays equally long. The geometric normal is (v1 - v0) x (v2 - v0).
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> triangle_material; ///< index into materials
    std::vector<std::int32_t> triangle_light; ///< index into polygon_lights, -1 for surfaces that do not emit

    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<PolygonLight> polygon_lights;
    std::vector<LineLight> line_lights;
    Camera camera;
    Film film;

    std::vector<std::string> warnings; ///< "file:line: message", in order, each kind once
    double radius = 0;                 ///< half the diagonal of the bounding box of surfaces and lights [m]
};

} // namespace nusselt::scene
