#pragma once
/// Ray queries against the surfaces of a scene, by Embree.

#include "scene/model/scene.h"
#include "visibility/ray_packets.h"

#include <memory>

namespace nusselt::visibility {

/// Rays are valid if no coordinate of origin and direction is NaN or larger than this in magnitude, t_far is
/// not NaN and not negative. Embree of Debian aborts the process otherwise.
inline constexpr float kLargestRayCoordinate = 1e18f;

/// The bounding volume hierarchy of a scene. Shadow rays see all surfaces (emitters included), camera rays
/// also the lights that are no surfaces. Both meet the exact shape of round lights, in place of their triangles. Surfaces
/// with an alpha below 1 are there with that probability, independently for each ray, triangle and crossing of a round
/// light: what happens is a hash of these. Immutable, usable from several threads at once.
class EmbreeScene {
public:
    /// Builds the hierarchy with the threads of the caller's oneTBB arena.
    /// \param scene must outlive this object
    /// \throws std::runtime_error if Embree reports an error (such as a lack of memory)
    explicit EmbreeScene(const scene::Scene& scene);
    ~EmbreeScene();
    EmbreeScene(EmbreeScene&&) noexcept;
    EmbreeScene& operator=(EmbreeScene&&) noexcept;

    /// Functions that trace this scene; valid as long as it lives.
    RayTracer tracer() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace nusselt::visibility
