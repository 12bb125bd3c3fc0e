#include "scene/build/build_shape.h"

#include "scene/build/lights/polygon_light.h"
#include "scene/build/lights/round_light.h"
#include "scene/build/lights/tube_light.h"
#include "scene/build/tessellate.h"
#include "scene/input/file_bytes.h"
#include "scene/model/vector_math.h"

#include <cmath>
#include <limits>
#include <utility>

namespace nusselt::scene {

namespace {

/// How shapes become lights of one kind other than polygons.
struct LightBuilder {
    bool (*takes)(const Geometry& geometry, const Emission& emission, const Transform& world_from_object);
    BuiltShape (*build)(const PlacedShape& placed, const FormatWords& words);
    bool is_surface; ///< whether rays meet such lights
};

/// Which shapes become which kind of light is decided here: the first row that takes a shape builds it. What no row takes
/// becomes a surface, whose lights are polygons if it emits.
constexpr LightBuilder kLightBuilders[] = {{becomes_tube, build_tube, false},
                                           {becomes_round_light, build_round_light, true}};

/// The row that takes a shape; null if there is none.
const LightBuilder* find_light_builder(const Geometry& geometry, const Emission& emission,
                                       const Transform& world_from_object) {
    for (const LightBuilder& builder : kLightBuilders)
        if (builder.takes(geometry, emission, world_from_object)) return &builder;
    return nullptr;
}

Mesh read_mesh(const MeshFile& file, SceneBudget& budget) {
    try {
        return file.read(FileBytes(file.path, budget.inflated_bytes).view());
    } catch (const std::runtime_error& error) {
        throw SceneError(file.origin, "mesh file '" + file.path.string() + "': " + error.what());
    }
}

/// Makes the triangles of a surface in its own coordinates.
class MeshMaker {
public:
    MeshMaker(const PlacedShape& placed, SceneBudget& budget, Warnings& warnings)
        : placed_(placed), budget_(budget), warnings_(warnings) {}

    Mesh operator()(Mesh& mesh) const { return placed_.is_shared ? mesh : std::move(mesh); }
    Mesh operator()(const MeshFile& file) const { return read_mesh(file, budget_); }
    Mesh operator()(const Tube&) const { return {}; }
    template <class Curved>
    Mesh operator()(const Curved& curved) const {
        return tessellate(curved, placed_, warnings_);
    }

private:
    const PlacedShape& placed_;
    SceneBudget& budget_;
    Warnings& warnings_;
};

/// Whether the emitting side is opposite to the one that the right-hand rule gives in world space.
bool flips_orientation(const PlacedShape& placed) {
    return placed.shape->reverse_orientation != (linear_determinant(placed.world_from_object) < 0);
}

void move_to_world(const PlacedShape& placed, Mesh& mesh) {
    const Transform& transform = placed.world_from_object;
    if (!is_identity(transform)) {
        for (Float3& p : mesh.positions) p = to_float(transform_point(transform, to_double(p)));
        for (Float3& n : mesh.normals) n = to_float(transform_normal(transform, to_double(n)));
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (is_valid_coordinate(mesh.positions[i])) continue;
        const Float3& p = mesh.positions[i];
        throw SceneError(placed.shape->origin, subject_of(*placed.shape) + ": vertex " + std::to_string(i) +
                                                   " at (" + to_text(p.x) + ", " + to_text(p.y) + ", " +
                                                   to_text(p.z) + ") must be finite and within 1e15 m");
    }
    for (Float3& n : mesh.normals) {
        if (placed.shape->reverse_orientation) n = {-n.x, -n.y, -n.z};
        // Some meshes have normals with NaN; zero stands for the geometric normal.
        if (!is_valid_coordinate(n)) n = {0, 0, 0};
    }
    constexpr float kMaxTextureCoordinate = 1e6f;
    for (Float2& uv : mesh.uvs)
        if (!(std::fabs(uv.x) <= kMaxTextureCoordinate && std::fabs(uv.y) <= kMaxTextureCoordinate))
            uv = {0, 0};
    if (flips_orientation(placed))
        for (Triangle& triangle : mesh.triangles) std::swap(triangle.vertex[1], triangle.vertex[2]);
}

/// Renderers normalise normals in single precision, where their squares must not vanish.
void remove_degenerate_triangles(Mesh& mesh) {
    const auto is_degenerate = [&](const Triangle& triangle) {
        const Double3 p0 = to_double(mesh.positions[triangle.vertex[0]]);
        const Double3 normal = cross(to_double(mesh.positions[triangle.vertex[1]]) - p0,
                                     to_double(mesh.positions[triangle.vertex[2]]) - p0);
        return dot(normal, normal) < static_cast<double>(std::numeric_limits<float>::min());
    };
    mesh.degenerate_triangles += std::erase_if(mesh.triangles, is_degenerate);
}

BuiltShape build_surface(const PlacedShape& placed, SceneBudget& budget, const FormatWords& words,
                         ShownImages& images) {
    BuiltShape built;
    static_cast<Mesh&>(built) = std::visit(MeshMaker(placed, budget, built.warnings), placed.shape->geometry);
    move_to_world(placed, built);
    remove_degenerate_triangles(built);
    if (!is_black(placed.shape->emission.radiance) && !built.triangles.empty())
        add_polygon_lights(*placed.shape, words, images, built);
    return built;
}

} // namespace

bool becomes_surface(const Geometry& geometry, const Emission& emission, const Transform& world_from_object) {
    const LightBuilder* const light = find_light_builder(geometry, emission, world_from_object);
    return light == nullptr || light->is_surface;
}

std::string subject_of(const ShapeDescription& shape) { return "shape \"" + std::string(shape.kind) + '"'; }

BuiltShape build_shape(const PlacedShape& placed, SceneBudget& budget, const FormatWords& words,
                       ShownImages& images) {
    const ShapeDescription& shape = *placed.shape;
    const LightBuilder* const light =
        find_light_builder(shape.geometry, shape.emission, placed.world_from_object);
    BuiltShape built =
        light != nullptr ? light->build(placed, words) : build_surface(placed, budget, words, images);
    built.warnings.append(shape.warnings);
    built.triangle_material.assign(built.triangles.size(), static_cast<std::uint32_t>(shape.material));
    if (!built.lights.empty()) built.emitters = {{shape.kind, shape.origin}};
    if (built.degenerate_triangles > 0) built.first_degenerate = shape.origin;
    built.round_shapes = is_round(shape.geometry) ? 1 : 0;
    return built;
}

} // namespace nusselt::scene
