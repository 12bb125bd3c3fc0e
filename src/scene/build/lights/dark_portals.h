#pragma once
/// Portals that let no light through to any surface.

#include "scene/build/built_shape.h"
#include "scene/build/lights/camera_view.h"
#include "scene/build/lights/emission_warnings.h"
#include "scene/input/diagnostics.h"
#include "scene/model/scene.h"

#include <optional>
#include <vector>

namespace nusselt::scene {

/// Where the environments of a scene come from, in their order.
std::vector<EmitterOrigin> environment_origins(const BuiltShape& shapes);

/// Finds portals that let no light through to any surface of a scene.
class DarkPortals {
public:
    /// \param scene must outlive this
    explicit DarkPortals(const Scene& scene) : scene_(scene) {}

    /// Why no surface receives light through the portal of an environment: because the map is black on one side of its plane, and
    /// all surfaces are on the other side or in the plane, or because something hides it from all that the camera sees. This
    /// reads all surfaces and all texels of the map. Nothing for environments without a portal and scenes without surfaces.
    Darkness of(const EnvironmentLight& light);

private:
    const Scene& scene_;
    std::optional<CameraView> view_; ///< made when it is needed
};

/// Warns of each such portal. \param origins of the environments of the scene
void warn_of_dark_portals(const Scene& scene, const std::vector<EmitterOrigin>& origins, Warnings& warnings);

} // namespace nusselt::scene
