#pragma once
/// A light as a shading point sees it, and what boxes and triangles have to do with that. Compiled for each instruction
/// set; see line_traversal.h.

#include "visibility/line_bvh_view.h"

#include <nusselt/line_samples/triangle_shadow.h>
#include <nusselt/simd/pack.h>

#include <limits>

NUSSELT_NAMESPACE_BEGIN

/// A lane for each child of a node, or for each triangle of a block.
using BvhReal = Pack<float, visibility::kBvhWidth>;
using BvhMask = Mask<float, visibility::kBvhWidth>;

/// Tests of boxes err on the side of traversal: by this share of the largest coordinate of the box or the point. That is
/// twice what the longest chain of operations on a coordinate adds up to, eight roundings of half an epsilon each: the
/// corner of the light (2), cross product (2), rotation to the space of the box (2), product with the box (2).
inline constexpr float kTraversalRounding = 8 * std::numeric_limits<float>::epsilon();

/// The lines of a light that is seen from a point.
struct SeenLight {
    static constexpr int kLargestCount = 8;

    ShadowFrame<float> frame;
    int corner_count;
    Vec3<float> corner[kLargestCount]; ///< relative to the point, in the axes of the frame [m]
    LineBounds<float> bounds;          ///< of all lines
    std::int32_t light;                ///< as TriangleBlock::light: its triangles cast no shadow

    /// Whether the light can be seen at all: not from a point in its plane, or one that is not finite.
    NUSSELT_HD bool is_visible() const noexcept {
        const Vec3<float>& p = frame.point;
        const Vec3<float>& o = frame.origin;
        return o.z > 0 && is_finite(o.x + o.y + o.z) && is_finite(p.x + p.y + p.z);
    }
};

/// \param polygon the light, in the same space as the point and the family.
/// \param light   its index among the polygonal lights of the scene.
template <int N>
NUSSELT_HD inline SeenLight see_light(const ConvexPolygon<float, N>& polygon,
                                      const LineFamily<float, N>& family, const Vec3<float>& point,
                                      std::int32_t light) noexcept {
    static_assert(N <= SeenLight::kLargestCount);
    const LinePlane<float>& plane = family.plane();
    SeenLight seen;
    seen.frame = make_shadow_frame(plane, point);
    seen.corner_count = N;
    seen.bounds = {family.offsets(), {0, 0}};
    seen.light = light;
    float offset = 0;
    float t = 0;
    for (int j = 0; j < N; ++j) {
        seen.corner[j] = {seen.frame.origin.x + offset, seen.frame.origin.y + t, seen.frame.origin.z};
        seen.bounds.extent = {min(seen.bounds.extent.begin, t), max(seen.bounds.extent.end, t)};
        offset += dot(polygon.edge[j], plane.across);
        t += dot(polygon.edge[j], plane.along);
    }
    return seen;
}

/// Coordinates of the world or of an object, as traversal needs them.
struct TracedSpace {
    /// The frame has the point in these coordinates, and axes that map their differences to the coordinates of the
    /// light.
    ShadowFrame<float> frame;
    float apex; ///< largest coordinate of the point

    /// A point in the axes of the frame and in its unit.
    template <class Real>
    NUSSELT_INLINE Vec3<Real> seen(const Vec3<Real>& p) const noexcept {
        const Vec3<Real> d = p - broadcast<Real>(frame.point);
        const auto row = [&](const Vec3<float>& r) {
            return fma(Real(r.x), d.x, fma(Real(r.y), d.y, Real(r.z) * d.z));
        };
        return {row(frame.across), row(frame.along), row(frame.normal)};
    }

    /// Converts a linear function of the axes of the frame to one of these coordinates.
    NUSSELT_INLINE Vec3<float> gradient(const Vec3<float>& m) const noexcept {
        return m.x * frame.across + m.y * frame.along + m.z * frame.normal;
    }
};

NUSSELT_HD inline float largest_coordinate(const Vec3<float>& p) noexcept {
    return max(max(abs(p.x), abs(p.y)), abs(p.z));
}

NUSSELT_HD inline TracedSpace world_space(const SeenLight& seen) noexcept {
    return {seen.frame, largest_coordinate(seen.frame.point)};
}

NUSSELT_HD inline TracedSpace object_space(const SeenLight& seen,
                                           const visibility::LineBvhInstance& instance) noexcept {
    const Vec3<float>& p = seen.frame.point;
    const auto coordinate = [&](const float* row) {
        return fma(row[0], p.x, fma(row[1], p.y, fma(row[2], p.z, row[3])));
    };
    const float* to_object = instance.object_from_world;
    const float* to_world = instance.world_from_object;
    const auto transformed = [&](const Vec3<float>& row) {
        const auto column = [&](int j) {
            return row.x * to_world[j] + row.y * to_world[3 + j] + row.z * to_world[6 + j];
        };
        return Vec3<float>{column(0), column(1), column(2)};
    };
    ShadowFrame<float> frame = seen.frame;
    frame.point = {coordinate(to_object), coordinate(to_object + 4), coordinate(to_object + 8)};
    frame.across = transformed(frame.across);
    frame.along = transformed(frame.along);
    frame.normal = transformed(frame.normal);
    return {frame, largest_coordinate(frame.point)};
}

/// Largest coordinate of each child of a node.
NUSSELT_INLINE BvhReal sizes_of(const visibility::LineBvhNode& node) noexcept {
    BvhReal size(0.0f);
    for (const auto& row : node.bounds) size = max(size, abs(BvhReal::load(row)));
    return size;
}

/// The pyramid with the point as apex and the light as base, to cull what lies outside.
class LightPyramid {
public:
    NUSSELT_HD LightPyramid(const SeenLight& seen, const TracedSpace& space) noexcept {
        Vec3<float> centre{0, 0, 0};
        for (int j = 0; j < seen.corner_count; ++j) centre = centre + seen.corner[j];
        for (int j = 0; j < seen.corner_count; ++j) {
            const Vec3<float>& corner = seen.corner[j];
            const Vec3<float> edge = seen.corner[j + 1 < seen.corner_count ? j + 1 : 0] - corner;
            const Vec3<float> m = cross(corner, edge);
            const float size = largest_coordinate(corner) * largest_coordinate(edge);
            if (size > 0) add(space, copysign(1.0f, dot(m, centre)) * m, 0, size);
        }
        add(space, {0, 0, 1}, 0, 1);
        add(space, {0, 0, -1}, seen.frame.end, 1);
    }

    /// Children whose boxes may touch the pyramid.
    NUSSELT_INLINE BvhMask touched(const visibility::LineBvhNode& node) const noexcept {
        auto touched = BvhMask(true);
        const BvhReal size = sizes_of(node);
        for (int i = 0; i < count_; ++i) {
            const Plane& plane = plane_[i];
            const BvhReal x = BvhReal::load(node.bounds[plane.row[0]]);
            const BvhReal y = BvhReal::load(node.bounds[plane.row[1]]);
            const BvhReal z = BvhReal::load(node.bounds[plane.row[2]]);
            const BvhReal farthest =
                fma(BvhReal(plane.normal.x), x,
                    fma(BvhReal(plane.normal.y), y, fma(BvhReal(plane.normal.z), z, plane.constant)));
            touched &= fma(BvhReal(plane.rounding), size, farthest) >= BvhReal(0);
        }
        return touched;
    }

    /// Triangles that may touch the pyramid.
    NUSSELT_INLINE BvhMask touched(const Vec3<BvhReal> (&corner)[3]) const noexcept {
        auto touched = BvhMask(true);
        BvhReal size(0.0f);
        for (const Vec3<BvhReal>& p : corner) size = max(size, max(max(abs(p.x), abs(p.y)), abs(p.z)));
        for (int i = 0; i < count_; ++i) {
            const auto product = [&](const Vec3<BvhReal>& p) {
                const Vec3<float>& n = plane_[i].normal;
                return fma(BvhReal(n.x), p.x, fma(BvhReal(n.y), p.y, BvhReal(n.z) * p.z));
            };
            const BvhReal farthest = max(max(product(corner[0]), product(corner[1])), product(corner[2]));
            const BvhReal margin = fma(BvhReal(plane_[i].rounding), size, BvhReal(plane_[i].constant));
            touched &= farthest + margin >= BvhReal(0);
        }
        return touched;
    }

private:
    /// normal.p + constant + rounding * (largest coordinate of p) >= 0 inside.
    struct Plane {
        Vec3<float> normal;
        float constant;
        float rounding;
        int row[3]; ///< of LineBvhNode::bounds: what is farthest inside
    };

    /// \param m        in the axes of the frame
    /// \param constant in its unit
    /// \param size     of products in m
    NUSSELT_HD void add(const TracedSpace& space, const Vec3<float>& m, float constant, float size) noexcept {
        const Vec3<float> n = space.gradient(m);
        const float scale = largest_coordinate(space.frame.across) + largest_coordinate(space.frame.along) +
                            largest_coordinate(space.frame.normal);
        const float rounding = kTraversalRounding * size * scale;
        const float margin = fma(rounding, space.apex, kTraversalRounding * constant);
        plane_[count_++] = {n,
                            constant - dot(n, space.frame.point) + margin,
                            rounding,
                            {n.x < 0 ? 0 : 3, n.y < 0 ? 1 : 4, n.z < 0 ? 2 : 5}};
    }

    Plane plane_[SeenLight::kLargestCount + 2];
    int count_ = 0;
};

NUSSELT_NAMESPACE_END
