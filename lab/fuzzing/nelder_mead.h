#pragma once
/// Local maximisation without derivatives, for any scalar.
///
/// J. A. Nelder, R. Mead 1965, A Simplex Method for Function Minimization, The Computer Journal 7(4),
/// doi:10.1093/comjnl/7.4.308, with the usual coefficients (reflection 1, expansion 2, contraction 1/2, shrinking
/// 1/2) and bounds after M. J. Box 1965: trial points are moved into the box, so the search also finds maxima on its
/// boundary.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace nusselt::lab {

template <class Real, std::size_t N>
using Point = std::array<Real, N>;

/// A range from low to high for each coordinate, ends included.
template <class Real, std::size_t N>
struct Box {
    Point<Real, N> low, high;

    Point<Real, N> nearest(Point<Real, N> p) const {
        for (std::size_t i = 0; i < N; ++i) p[i] = std::clamp(p[i], low[i], high[i]);
        return p;
    }
};

template <class Real, std::size_t N>
struct Vertex {
    Point<Real, N> at;
    Real value;
};

/// The simplex of Nelder and Mead, with vertices sorted from best to worst.
template <class Real, std::size_t N, class Function>
class Simplex {
    using P = Point<Real, N>;
    using V = Vertex<Real, N>;

public:
    /// \param size of the first simplex along each coordinate; it extends inwards where the box ends.
    Simplex(const Function& function, const Box<Real, N>& box, const P& start, Real size)
        : function_(function), box_(box) {
        vertices_[0] = evaluated(start);
        for (std::size_t i = 0; i < N; ++i) {
            P p = vertices_[0].at;
            p[i] += p[i] + size <= box.high[i] ? size : -size;
            vertices_[i + 1] = evaluated(p);
        }
        sort();
    }

    void step() {
        const P middle = centroid_without_worst();
        const V& worst = vertices_[N];
        const V reflected = along(middle, worst.at, -1);
        if (reflected.value > vertices_[0].value) {
            const V expanded = along(middle, worst.at, -2);
            replace_worst(expanded.value > reflected.value ? expanded : reflected);
        } else if (reflected.value > vertices_[N - 1].value) {
            replace_worst(reflected);
        } else {
            const V& better = reflected.value > worst.value ? reflected : worst;
            const V contracted = along(middle, better.at, Real(0.5));
            if (contracted.value > better.value)
                replace_worst(contracted);
            else
                shrink();
        }
    }

    const V& best() const { return vertices_[0]; }

    /// Whether all values agree up to rounding, or the simplex has lost its extent.
    bool is_flat() const {
        const Real scale = std::max(magnitude(vertices_[0].value), magnitude(vertices_[N].value));
        if (vertices_[0].value - vertices_[N].value <= 4 * std::numeric_limits<Real>::epsilon() * scale)
            return true;
        return std::all_of(vertices_.begin() + 1, vertices_.end(),
                           [&](const V& v) { return v.at == vertices_[0].at; });
    }

private:
    static Real magnitude(Real x) { return x < 0 ? -x : x; }

    V evaluated(const P& p) const {
        const P inside = box_.nearest(p);
        return {inside, function_(inside)};
    }

    /// The point from + weight (to - from).
    V along(const P& from, const P& to, Real weight) const {
        P p;
        for (std::size_t i = 0; i < N; ++i) p[i] = from[i] + weight * (to[i] - from[i]);
        return evaluated(p);
    }

    P centroid_without_worst() const {
        P sum{};
        for (std::size_t j = 0; j < N; ++j)
            for (std::size_t i = 0; i < N; ++i) sum[i] += vertices_[j].at[i];
        for (Real& x : sum) x /= static_cast<Real>(N);
        return sum;
    }

    void replace_worst(const V& v) {
        vertices_[N] = v;
        sort();
    }

    void shrink() {
        for (std::size_t j = 1; j <= N; ++j)
            vertices_[j] = along(vertices_[0].at, vertices_[j].at, Real(0.5));
        sort();
    }

    // The sort is stable, so the order of equal values, and thus the result, does not depend on the standard library.
    void sort() {
        std::stable_sort(vertices_.begin(), vertices_.end(),
                         [](const V& a, const V& b) { return a.value > b.value; });
    }

    const Function& function_;
    const Box<Real, N>& box_;
    std::array<V, N + 1> vertices_;
};

/// Climbs to a local maximum. Deterministic.
/// \param function   of a point in the box; -infinity where a point is not allowed, never NaN.
/// \param start      in the box.
/// \param size       of the first simplex along each coordinate, above 0 and at most half of the box.
/// \param iterations at most, each with one or two evaluations and rarely N more.
/// \returns the best point found, at least as good as the start.
template <class Real, std::size_t N, class Function>
Vertex<Real, N> maximize(const Function& function, const Box<Real, N>& box, const Point<Real, N>& start,
                         Real size, int iterations) {
    Simplex<Real, N, Function> simplex(function, box, start, size);
    for (int i = 0; i < iterations && !simplex.is_flat(); ++i) simplex.step();
    return simplex.best();
}

} // namespace nusselt::lab
