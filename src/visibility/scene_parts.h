#pragma once
/// The map between the triangles of a scene and the geometries of Embree.

#include "scene/model/scene.h"
#include "visibility/embree_api.h"
#include "visibility/round_surfaces.h"

#include <cstdint>
#include <vector>

namespace nusselt::visibility {

// Numbers of geometries in the world and in objects.
inline constexpr unsigned kFullGeometry = 0;
inline constexpr unsigned kPartialGeometry = 1; ///< surfaces with an alpha below 1: hits pass a filter
inline constexpr unsigned kRoundGeometry = 2;   ///< round lights, only in the world
inline constexpr unsigned kFirstInstance = 3;
// The geometry that only camera rays meet: lights that are no surfaces. Its number differs from those of the world.
inline constexpr unsigned kLightGeometry = 3;

/// The triangles of the world or of an object, without those of round lights.
struct ScenePart {
    const scene::Scene* scene = nullptr;
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    /// Whether all triangles of the range make up kFullGeometry in their order; else the lists say which do.
    bool is_full = true;
    std::vector<std::uint32_t> full = {}, partial = {}; ///< indices into Scene::triangles

    std::uint32_t triangle_of(unsigned geometry, unsigned primitive) const {
        if (geometry == kPartialGeometry) return partial[primitive];
        return is_full ? first_triangle + primitive : full[primitive];
    }
};

/// The world, then the objects. \param scene must outlive the result
std::vector<ScenePart> make_parts(const scene::Scene& scene);

/// The target of RayTracer::context of EmbreeScene::tracer().
struct TracedScene {
    RTCScene all = nullptr; ///< what shadow rays meet, and camera rays too
    /// What only camera rays meet; null if there is none. A scene of its own: shadow rays would search it in vain, since many end
    /// next to it.
    RTCScene seen = nullptr;
    const scene::Scene* scene = nullptr;
    std::vector<ScenePart> parts;
    std::vector<RoundSurface> round_surfaces; ///< the primitives of kRoundGeometry
    std::vector<std::uint32_t> lights;        ///< of each triangle of kLightGeometry: see scene::LightMesh

    std::int32_t light_of(unsigned primitive) const { return static_cast<std::int32_t>(lights[primitive]); }
    /// \param instance RTC_INVALID_GEOMETRY_ID for hits on the world
    const ScenePart& part_of(unsigned instance) const {
        if (instance == RTC_INVALID_GEOMETRY_ID) return parts[0];
        return parts[1 + scene->instances[instance - kFirstInstance].object];
    }
};

} // namespace nusselt::visibility
