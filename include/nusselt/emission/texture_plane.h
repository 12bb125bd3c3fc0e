#pragma once
/// Where a texture lies in space.

#include <nusselt/geometry/polygon_measures.h>

NUSSELT_NAMESPACE_BEGIN

/// An affine map from texture coordinates to a plane in space: corner + x side_x + y side_y. As for ConvexPolygon, the
/// sides and the normal are properties of the light, which are rotated and never recomputed.
template <class Real>
struct TexturePlane {
    Vec3<Real> corner; ///< texture coordinates (0, 0) [m]
    Vec3<Real> side_x; ///< from (0, 0) to (1, 0) [m]
    Vec3<Real> side_y; ///< from (0, 0) to (0, 1) [m]
    Vec3<Real> normal; ///< unit, right-handed with the sides; zero if they do not span a plane

    NUSSELT_HD Vec3<Real> point_at(const Vec2<Real>& at) const noexcept { return corner + offset_of(at); }
    /// The vector between two points whose texture coordinates differ by this much.
    NUSSELT_HD Vec3<Real> offset_of(const Vec2<Real>& difference) const noexcept {
        return multiply_add(difference.y, side_y, difference.x * side_x);
    }
    /// Area of the texture [m^2].
    NUSSELT_HD Real area() const noexcept { return length(cross(side_x, side_y)); }
};

/// \param corner, side_x, side_y see TexturePlane.
template <class Real>
NUSSELT_HD inline TexturePlane<Real> make_texture_plane(const Vec3<Real>& corner, const Vec3<Real>& side_x,
                                                        const Vec3<Real>& side_y) noexcept {
    // Unit sides have products in range.
    return {corner, side_x, side_y, normalize(cross(normalize(side_x), normalize(side_y)))};
}

/// The plane seen from a shading point: the point becomes the origin, the normal of the frame +z.
template <class Real>
NUSSELT_HD inline TexturePlane<Real> to_shading_space(const TexturePlane<Real>& world,
                                                      const Vec3<Real>& point,
                                                      const Frame<Real>& frame) noexcept {
    return {frame.to_local(world.corner - point), frame.to_local(world.side_x), frame.to_local(world.side_y),
            frame.to_local(world.normal)};
}

/// A convex polygon of the plane.
/// \tparam M    bound on the number of vertices.
/// \param point texture coordinates of the vertices.
/// \param count 3 to M.
template <int M, class Real>
NUSSELT_HD inline ConvexPolygon<Real, M> polygon_in(const TexturePlane<Real>& plane, const Vec2<Real>* point,
                                                    int count) noexcept {
    ConvexPolygon<Real, M> polygon;
    for (int k = 0; k < M; ++k) {
        const Vec2<Real> from = point[k < count ? k : count - 1];
        const Vec2<Real> to = point[k + 1 < count ? k + 1 : k + 1 < M ? count - 1 : 0];
        polygon.vertex[k] = plane.point_at(from);
        polygon.edge[k] = plane.offset_of(to - from);
    }
    polygon.normal = plane.normal;
    return polygon;
}

/// A rectangle of the texture, a parallelogram in space.
template <class Real>
NUSSELT_HD inline ConvexPolygon<Real, 4> rectangle_in(const TexturePlane<Real>& plane, const Vec2<Real>& low,
                                                      const Vec2<Real>& high) noexcept {
    const Vec2<Real> corner[4] = {low, {high.x, low.y}, high, {low.x, high.y}};
    return polygon_in<4>(plane, corner, 4);
}

/// Texture coordinates of points of a plane.
template <class Real>
class TextureCoordinates {
public:
    /// \param plane with sides that span a plane.
    NUSSELT_HD explicit TextureCoordinates(const TexturePlane<Real>& plane) noexcept {
        // Vectors whose products with one side are 1 and with the other one 0, from sides of order one.
        const Real scale = reciprocal_power_of_two(max(extent(plane.side_x), extent(plane.side_y)));
        const Vec3<Real> x = scale * plane.side_x;
        const Vec3<Real> y = scale * plane.side_y;
        const Vec3<Real> n = cross(x, y);
        const Real squared = dot(n, n);
        const Real factor = select(squared > Real(0), scale / squared, Real(0));
        corner_ = plane.corner;
        dual_x_ = factor * cross(y, n);
        dual_y_ = factor * cross(n, x);
    }

    /// Texture coordinates of a point of the plane, in [0, 1).
    NUSSELT_HD Vec2<Real> operator()(const Vec3<Real>& p) const noexcept {
        const Vec3<Real> offset = p - corner_;
        return {below_one(dot(dual_x_, offset)), below_one(dot(dual_y_, offset))};
    }

private:
    NUSSELT_HD static Real extent(const Vec3<Real>& v) noexcept { return detail::extent_of(v); }

    Vec3<Real> corner_, dual_x_, dual_y_;
};

NUSSELT_NAMESPACE_END
