#pragma once
/// Polygons whose radiance depends on the direction and not on the point: portals of environment maps, and lights with a
/// profile.

#include <nusselt/core/frame.h>
#include <nusselt/emission/rectified_table.h>
#include <nusselt/emission/textured_light.h>

NUSSELT_NAMESPACE_BEGIN

/// The plane of a light. Slopes are those of directions to the light in the frame: x over z, y over z.
template <class Real>
struct WindowPlane {
    Vec3<Real> corner; ///< where coordinates in the plane are zero [m]
    Frame<Real>
        frame; ///< orthogonal unit vectors, in either handedness; the normal leads away from points that see the light
};

/// The plane seen from a shading point: the point becomes the origin, the normal of the frame +z.
template <class Real>
NUSSELT_HD inline WindowPlane<Real> to_shading_space(const WindowPlane<Real>& world, const Vec3<Real>& point,
                                                     const Frame<Real>& frame) noexcept {
    return {frame.to_local(world.corner - point),
            {frame.to_local(world.frame.t), frame.to_local(world.frame.b), frame.to_local(world.frame.n)}};
}

/// \tparam T float, double or long double.
template <class T>
struct WindowedLight {
    WindowPlane<T> plane;      ///< in world space
    TextureOutline<T> outline; ///< vertices in the plane [m], counter-clockwise
    RectifiedTable<T> table;   ///< of the frame of the plane

    /// Area [m^2].
    NUSSELT_HD T area() const noexcept {
        T doubled = T(0);
        for (int k = 2; k < outline.count; ++k)
            doubled += det(outline.vertex[k - 1] - outline.vertex[0], outline.vertex[k] - outline.vertex[0]);
        return T(0.5) * doubled;
    }
};

namespace detail {

template <class T>
NUSSELT_HD inline WindowedLight<T> make_windowed_light(const Frame<T>& frame, const Vec3<T>* vertices,
                                                       int count, const RectifiedTable<T>& table) noexcept {
    WindowedLight<T> light{{vertices[0], frame}, {{}, count}, table};
    Vec2<T>(&v)[TextureOutline<T>::kMostVertices] = light.outline.vertex;
    T doubled_area = T(0);
    T extent = T(0);
    for (int k = 0; k < count; ++k) {
        const Vec3<T> local = frame.to_local(vertices[k] - vertices[0]);
        v[k] = xy(local);
        extent = max(extent, max(abs(local.x), abs(local.y)));
        if (k >= 2) doubled_area += det(v[k - 1] - v[0], v[k] - v[0]);
    }
    if (doubled_area < T(0)) {
        for (int k = 0; k < count / 2; ++k) {
            const Vec2<T> swapped = v[k];
            v[k] = v[count - 1 - k];
            v[count - 1 - k] = swapped;
        }
    }
    // Edges that are parallel to an axis but for rounding would cut all cells at the edge of the window.
    const T rounding = 16 * std::numeric_limits<T>::epsilon() * extent;
    for (int k = 0; k < count; ++k) {
        Vec2<T>& next = v[k + 1 < count ? k + 1 : 0];
        if (abs(next.x - v[k].x) <= rounding) next.x = v[k].x;
        if (abs(next.y - v[k].y) <= rounding) next.y = v[k].y;
    }
    return light;
}

} // namespace detail

/// A portal, through which an environment map shines.
/// \param frame    of the portal; its normal leads out. Rectangles want its other axes along their sides: then, no cell is cut.
/// \param vertices of a convex polygon in a plane across the normal, in either winding [m].
/// \param count    3 to 8.
/// \param table    of the radiance that arrives from a direction of the frame.
template <class T>
NUSSELT_HD inline WindowedLight<T> make_portal(const Frame<T>& frame, const Vec3<T>* vertices, int count,
                                               const RectifiedTable<T>& table) noexcept {
    return detail::make_windowed_light(frame, vertices, count, table);
}

/// A flat light whose radiance depends on the direction.
/// \param frame of the light; its normal leads to the side that emits. \copydetails make_portal
/// \param table of the radiance that leaves in a direction of the frame.
template <class T>
NUSSELT_HD inline WindowedLight<T> make_profiled_light(const Frame<T>& frame, const Vec3<T>* vertices,
                                                       int count, const RectifiedTable<T>& table) noexcept {
    // Who looks from the light's side sees directions the other way around.
    return detail::make_windowed_light({-frame.t, -frame.b, -frame.n}, vertices, count, table);
}

NUSSELT_NAMESPACE_END
