#pragma once
/// From shadows in packs of triangles to single ones for packs of lines, and back from lines to what remains of a light.

#include <nusselt/line_samples/triangle_shadow.h>
#include <nusselt/line_samples/visible_parts.h>
#include <nusselt/simd/pack.h>

NUSSELT_NAMESPACE_BEGIN

/// The shadows of a pack of triangles in memory.
template <class Scalar, int N>
class StoredShadows {
public:
    explicit StoredShadows(const TriangleShadow<Pack<Scalar, N>>& shadows) noexcept {
        shadows.first.store(value_[0]);
        shadows.middle.store(value_[1]);
        shadows.last.store(value_[2]);
        store(shadows.through, 3);
        store(shadows.before, 5);
        store(shadows.after, 7);
    }

    /// \param i in [0, N)
    TriangleShadow<Scalar> operator[](int i) const noexcept {
        return {value_[0][i], value_[1][i], value_[2][i], edge(i, 3), edge(i, 5), edge(i, 7)};
    }

private:
    void store(const ShadowEdge<Pack<Scalar, N>>& edge, int row) noexcept {
        edge.at_zero.store(value_[row]);
        edge.slope.store(value_[row + 1]);
    }
    ShadowEdge<Scalar> edge(int i, int row) const noexcept { return {value_[row][i], value_[row + 1][i]}; }

    Scalar value_[9][N];
};

/// Extends a rectangle by what is visible of lines.
template <class Scalar, int N>
inline LineBounds<Scalar> join(LineBounds<Scalar> bounds, const Pack<Scalar, N>& offset,
                               const VisibleParts<Pack<Scalar, N>>& parts) noexcept {
    const Interval<Scalar> none = empty_interval<Scalar>();
    Scalar value[4][N];
    const Mask<Scalar, N> lit = parts.lit();
    select(lit, offset, Pack<Scalar, N>(none.begin)).store(value[0]);
    select(lit, offset, Pack<Scalar, N>(none.end)).store(value[1]);
    parts.bounds().begin.store(value[2]);
    parts.bounds().end.store(value[3]);
    for (int i = 0; i < N; ++i) {
        bounds.offsets = {min(value[0][i], bounds.offsets.begin), max(value[1][i], bounds.offsets.end)};
        bounds.extent = {min(value[2][i], bounds.extent.begin), max(value[3][i], bounds.extent.end)};
    }
    return bounds;
}

NUSSELT_NAMESPACE_END
