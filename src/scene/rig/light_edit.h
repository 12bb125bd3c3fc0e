#pragma once
/// Lights of a scene in a form for changes of single lights.

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
    std::vector<std::uint32_t> triangles; ///< of its surface, while that is in the scene
    /// The number of its first light in the scene, while it has triangles there.
    std::uint32_t first_light = 0;
    bool has_new_surface = false; ///< LightEditor::finish() makes a surface from its shape
    std::uint32_t material = 0;   ///< of a new surface
    bool is_enabled = true;
    bool is_removed = false;
};

/// The lights of a scene, in the order of Scene::emitters.
std::vector<EditableLight> editable_lights(const Scene& scene);
/// Whether lights of its kind are surfaces.
bool is_surface(const EditableLight& light);
/// Whether no part of it emits light.
bool is_black(const EditableLight& light);
/// The centroid of its parts, weighted by their areas.
Double3 centroid(const EditableLight& light);
/// The power that it emits, with channels weighted by their luminance [W]. \param scene_radius see Scene::radius
double luminous_power(const EditableLight& light, double scene_radius);
/// The quantity of its emission; null if it has no parts.
const EmissionQuantity* quantity_of(const Lights& parts);

/// Why a light cannot have what a field of a rig says.
struct FieldDefect {
    std::string field, message;
};

/// Takes the lights out of a scene and puts them back when they have been changed.
class LightEditor {
public:
    explicit LightEditor(Scene& scene) : scene_(scene), lights_(editable_lights(scene)) {}

    std::vector<EditableLight>& lights() { return lights_; }
    const std::vector<EditableLight>& lights() const { return lights_; }
    /// Gives a light another shape. It keeps its emission and its sides; a light without a shape becomes white and
    /// one-sided. A light whose surface is invisible (alpha 0) stays invisible.
    /// \param material  of its surface if it was no surface before
    /// \returns whether it had another shape before
    bool replace_shape(EditableLight& light, const Lights& shape, std::uint32_t material);
    /// Moves a light and its surface. The transform is affine; radii grow with the cube root of its determinant.
    void transform(EditableLight& light, const Transform& transform);
    /// Puts the lights back. Lights that are black or disabled are left out, but keep their surfaces. Surfaces that were
    /// replaced or removed take along the vertices that no other surface uses.
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
    std::vector<std::uint32_t> vertex_owner_;     ///< empty until it is first needed
    std::vector<std::uint32_t> unused_triangles_; ///< those of replaced shapes
};

} // namespace nusselt::scene
