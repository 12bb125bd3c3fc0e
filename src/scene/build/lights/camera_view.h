#pragma once
/// What the camera sees, to find portals through which none of it receives light.

#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <cstdint>
#include <vector>

namespace nusselt::scene {

/// Some points that the camera of a scene sees, spread over its film.
class CameraView {
public:
    /// Traces some rays, each against all triangles, unless there are too many of these.
    /// \param scene must outlive this
    explicit CameraView(const Scene& scene);

    /// Whether some of the points, or the camera itself, receive light through a portal. Surfaces that are only partly there hide
    /// nothing. A portal that lights less than a thousandth of the image may be missed.
    /// \param arrives function of a direction to the portal: whether light comes from there
    /// \returns true if the camera sees no surfaces, or if it would take too long to find out
    template <class Arrives>
    bool receives_light(const PolygonVertices& portal, const Arrives& arrives) {
        if (!is_known_ || points_.empty()) return true;
        for (const Ray& ray : sky_rays_)
            if (arrives(ray.direction) && passes(ray, portal)) return true;
        for (std::uint32_t round = 0; round < kRounds; ++round) {
            std::vector<Ray> rays;
            for (const Point& point : points_) {
                const Double3 direction = point_of(portal) - point.position;
                if (dot(point.normal, direction) > 0 && arrives(direction))
                    rays.push_back({point.position, direction});
            }
            if (reaches_sky(std::move(rays))) return true;
        }
        return false;
    }

private:
    struct Ray {
        Double3 origin, direction;
    };
    struct Point {
        Double3 position, normal; ///< slightly above the surface; the normal leads to the camera
    };
    static constexpr std::uint32_t kRounds = 8;

    void see(const Camera& camera, const Film& film);
    static bool passes(const Ray& ray, const PolygonVertices& portal);
    /// The next of points that cover a portal evenly.
    Double3 point_of(const PolygonVertices& portal);
    /// Whether one of the rays meets nothing, or there have been too many to tell.
    bool reaches_sky(std::vector<Ray> rays);

    const Scene& scene_;
    std::uint64_t tests_ = 0; ///< of a ray with a triangle, so far
    bool is_known_ = false;
    std::uint32_t portal_points_ = 0;
    std::vector<Point> points_;
    std::vector<Ray> sky_rays_; ///< of the camera
};

} // namespace nusselt::scene
