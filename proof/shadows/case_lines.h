#pragma once
/// The lines of a case, and the parts of them that its occluders hide, without an acceleration structure.

#include <utility>

#include <nusselt/line_samples/partial_shadow.h>
#include <nusselt/line_samples/visible_parts.h>

#include "proof/shadows/shadow_case.h"
#include "visibility/stored_shadows.h"

NUSSELT_NAMESPACE_BEGIN
namespace shadows {

using proof::kLinesPerCase;
using proof::Occluder;
using proof::ShadowCase;
using Lines = Pack<float, kLinesPerCase>;

inline Vec3<float> vector_of(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// Sorts corners as make_triangle_shadow() requires.
inline Occluder in_order_of_position(Occluder triangle) {
    const auto swap_if_after = [&](int i, int j) {
        auto& a = triangle.corner[i];
        auto& b = triangle.corner[j];
        int k = 0;
        while (k < 2 && a[k] == b[k]) ++k;
        if (!(b[k] < a[k])) return;
        for (k = 0; k < 3; ++k) {
            const float x = a[k];
            a[k] = b[k];
            b[k] = x;
        }
    };
    swap_if_after(0, 1);
    swap_if_after(1, 2);
    swap_if_after(0, 1);
    return triangle;
}

/// Calls `use` with the TriangleShadow<float> or PartialShadow<float> of each occluder that may hide something in the
/// rectangle.
/// \tparam N number of triangles whose shadows are made at once.
/// \param order function applied to each occluder first, such as in_order_of_position().
template <int N, class Order, class Use>
void for_each_shadow(const ShadowFrame<float>& frame, const Occluder* occluders, int count,
                     const LineBounds<float>& bounds, const Order& order, const Use& use) {
    using Real = Pack<float, N>;
    const LineBounds<Real> rectangle{{Real(bounds.offsets.begin), Real(bounds.offsets.end)},
                                     {Real(bounds.extent.begin), Real(bounds.extent.end)}};
    const ShadowFrame<Real> frames = broadcast<Real>(frame);
    for (int first = 0; first < count; first += N) {
        Occluder triangle[N];
        float column[3][3][N];
        for (int i = 0; i < N; ++i) {
            triangle[i] = order(occluders[first + i < count ? first + i : count - 1]);
            for (int k = 0; k < 3; ++k)
                for (int axis = 0; axis < 3; ++axis) column[k][axis][i] = triangle[i].corner[k][axis];
        }
        Vec3<Real> corner[3];
        for (int k = 0; k < 3; ++k)
            corner[k] = {Real::load(column[k][0]), Real::load(column[k][1]), Real::load(column[k][2])};
        const TriangleShadows<Real> made = make_triangle_shadow(frames, corner[0], corner[1], corner[2]);
        const StoredShadows<float, N> stored(made.shadow);
        const auto hides = may_hide(made.shadow, rectangle);
        for (int i = 0; i < N && first + i < count; ++i) {
            const auto& v = triangle[i].corner;
            if (made.partial.lane(i))
                use(make_partial_shadow(frame, vector_of(v[0]), vector_of(v[1]), vector_of(v[2])));
            else if (hides.lane(i))
                use(stored[i]);
        }
    }
}

/// The part of each line that a shadow hides.
template <class Real>
Interval<Real> hidden_from(const TriangleShadow<scalar_t<Real>>& shadow, const Real& offset) {
    return hidden_interval(broadcast<Real>(shadow), offset);
}
template <class Real>
Interval<Real> hidden_from(const PartialShadow<scalar_t<Real>>& shadow, const Real& offset) {
    return hidden_interval(shadow, offset);
}

/// The lines of a case.
class CaseLines {
public:
    explicit CaseLines(const ShadowCase& test)
        : test_(test),
          family_(light_of(test), test.angle),
          frame_(make_shadow_frame(family_.plane(), vector_of(test.point))),
          offset_(LineFamily<Lines, 4>(family_).sample_by_length(Lines::load(test.u)).offset) {
        const Interval<float> offsets = family_.offsets();
        for (int i = 0; i < kLinesPerCase; ++i) {
            if (test.corner[i] < 0) continue;
            const Occluder& triangle = test.occluders[test.corner[i] / 3];
            const Vec3<float> corner = vector_of(triangle.corner[test.corner[i] % 3]);
            const float offset = nusselt::detail::shadow_corner(frame_, corner).offset;
            if (offset >= offsets.begin && offset < offsets.end) offset_.set_lane(i, offset);
        }
        whole_ = LineFamily<Lines, 4>(family_).chord(offset_).extent;
    }

    const LineFamily<float, 4>& family() const { return family_; }
    const ShadowFrame<float>& frame() const { return frame_; }
    const Lines& offset() const { return offset_; }
    const Interval<Lines>& whole() const { return whole_; }

    /// Calls `use` with the part of each line that an occluder hides, for all of them.
    /// \param order see for_each_shadow().
    template <class Order, class Use>
    void for_each_occluder(const Order& order, const Use& use) const {
        const Interval<float> none = empty_interval<float>();
        LineBounds<float> bounds{family_.offsets(), none};
        for (int i = 0; i < kLinesPerCase; ++i) {
            bounds.extent.begin = min(whole_.begin.lane(i), bounds.extent.begin);
            bounds.extent.end = max(whole_.end.lane(i), bounds.extent.end);
        }
        for_each_shadow<kLinesPerCase>(frame_, test_.occluders, test_.occluder_count, bounds, order,
                                       [&](const auto& shadow) { use(hidden_from(shadow, offset_)); });
    }

private:
    static ConvexPolygon<float, 4> light_of(const ShadowCase& test) {
        Vec3<float> vertices[4];
        for (int j = 0; j < 4; ++j) vertices[j] = vector_of(test.light[j]);
        return make_polygon<4>(vertices, 4);
    }

    const ShadowCase& test_;
    LineFamily<float, 4> family_;
    ShadowFrame<float> frame_;
    Lines offset_;
    Interval<Lines> whole_;
};

} // namespace shadows
NUSSELT_NAMESPACE_END
