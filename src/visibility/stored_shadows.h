#pragma once
/// Converts shadows in packs of triangles to single shadows for packs of lines.

#include <nusselt/line_samples/triangle_shadow.h>
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

NUSSELT_NAMESPACE_END
