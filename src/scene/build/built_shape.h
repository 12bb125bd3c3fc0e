#pragma once
/// What shapes contribute to a scene.

#include "scene/build/mesh.h"
#include "scene/input/diagnostics.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace nusselt::scene {

/// What the name of an emitter consists of.
struct EmitterOrigin {
    std::string_view kind; ///< ShapeDescription::kind
    Location location;
};

/// The contribution of one shape to the scene, or of several in a row.
struct BuiltShape : Mesh {
    /// Empty, or for each triangle the number of a light among the polygons and then the round lights of these shapes, -1 for
    /// none.
    std::vector<std::int32_t> triangle_light;
    std::vector<std::uint32_t> triangle_material; ///< for each triangle ShapeDescription::material
    Lights lights; ///< with indices into `emitters`, `emission_textures` and `emission_profiles`
    std::vector<TexturedEmission> emission_textures;
    std::vector<ProfiledEmission> emission_profiles;
    std::vector<std::shared_ptr<const Luminaire>> luminaires;                  ///< of light sources
    std::vector<std::shared_ptr<const EnvironmentMapTexels>> environment_maps; ///< of light sources
    std::vector<EmitterOrigin> emitters;
    std::optional<Location> first_degenerate; ///< the first shape with degenerate triangles
    std::size_t round_shapes = 0;             ///< see is_round()
    Warnings warnings;
};

template <class T, class Owner>
std::vector<std::size_t> sizes_of(const std::vector<BuiltShape>& shapes, std::vector<T> Owner::*array) {
    std::vector<std::size_t> sizes;
    for (const BuiltShape& shape : shapes) sizes.push_back((shape.*array).size());
    return sizes;
}

/// Joins shapes in their order, and releases them: large scenes fill the memory, so that little may exist twice. Normals
/// and texture coordinates of shapes that have none are zero if others have some.
/// \param copies  the word for copies in messages
/// \throws std::runtime_error  if there are too many vertices or triangles, see check_counts()
BuiltShape join(std::vector<BuiltShape> shapes, std::string_view copies);

} // namespace nusselt::scene
