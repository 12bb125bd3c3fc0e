#pragma once
/// Lights of a scene in a form in which they can be changed one by one.

#include "scene/model/scene.h"
#include "scene/model/transform.h"
#include "scene/rig/rig.h"

#include <cstdint>
#include <string>
#include <vector>

namespace nusselt::scene {

/// A light with its surface.
struct EditableLight {
    std::string name;
    Lights parts;
    std::vector<std::uint32_t> triangles; ///< of its surface, as long as that is in the scene
    /// Number of its first light in the scene, while it has triangles there.
    std::uint32_t first_light = 0;
    bool has_new_surface = false; ///< made of its polygon in the end
    std::uint32_t material = 0;   ///< of a new surface
    bool is_enabled = true;
    bool is_removed = false;
};

/// The lights of a scene, in the order of Scene::emitters.
std::vector<EditableLight> editable_lights(const Scene& scene);
/// Whether lights of its kind are surfaces.
bool is_surface(const EditableLight& light);
/// Whether no part of it emits anything.
bool is_black(const EditableLight& light);
/// Centroid of the surface.
Double3 centroid(const EditableLight& light);
/// Power that it emits, channels weighed by their luminance [W].
double luminous_power(const EditableLight& light);

/// Takes the lights out of a scene and puts them back when they have been changed.
class LightEditor {
public:
    explicit LightEditor(Scene& scene) : scene_(scene), lights_(editable_lights(scene)) {}

    std::vector<EditableLight>& lights() { return lights_; }
    /// Gives a light another shape, with the radiance and the sides of what it was; one without a shape becomes white and
    /// one-sided. Polygons that take the place of polygons without a surface, as alpha 0 makes them, have none either.
    /// \param material  of its surface if it had no polygons
    void replace_shape(EditableLight& light, const Lights& shape, std::uint32_t material);
    /// Moves a light and its surface. The transform is affine; radii grow with the cube root of its determinant.
    void transform(EditableLight& light, const Transform& transform);
    /// Puts the lights back. Of those that are black or not enabled the surface stays, of tubes nothing. Vertices of
    /// surfaces that are replaced or removed go with them unless others use them.
    void finish();

private:
    std::vector<std::uint32_t> own_vertices(EditableLight& light);
    void find_vertex_owners();
    void remove_surfaces();
    void put_lights_back();
    void add_surfaces();
    void remove_vertices(const std::vector<Triangle>& removed);

    Scene& scene_;
    std::vector<EditableLight> lights_;
    std::vector<std::uint32_t> vertex_owner_;     ///< empty until it is needed
    std::vector<std::uint32_t> unused_triangles_; ///< surfaces of shapes that were replaced
};

} // namespace nusselt::scene
