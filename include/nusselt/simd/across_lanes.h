#pragma once
/// Scalar code that takes the vertices of one light as lanes: operations across the lanes of Pack<float, L>, and records
/// of such packs in memory.

#include <nusselt/core/vec.h>
#include <nusselt/simd/pack.h>

#if NUSSELT_HAS_VERTEX_LANES

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// The operations for packs in arrays or in several registers.
template <int L>
struct AcrossLanes {
    using P = Pack<float, L>;

    template <class Function>
    NUSSELT_INLINE static P from(Function f) noexcept {
        float lanes[L];
        for (int i = 0; i < L; ++i) lanes[i] = f(i);
        return P::load(lanes);
    }
    NUSSELT_INLINE static P permute(const P& p, const std::int32_t* indices) noexcept {
        float lanes[L];
        p.store(lanes);
        return from([&](int i) { return lanes[indices[i]]; });
    }
    NUSSELT_INLINE static Pack<float, L / 2> permute_to_half(const P& p,
                                                             const std::int32_t* indices) noexcept {
        float lanes[L];
        p.store(lanes);
        return AcrossLanes<L / 2>::from([&](int i) { return lanes[indices[i]]; });
    }
    NUSSELT_INLINE static P sums_before(const P& p) noexcept {
        float lanes[L];
        p.store(lanes);
        float sum[L] = {};
        for (int i = 1; i < L; ++i) sum[i] = sum[i - 1] + lanes[i - 1];
        return P::load(sum);
    }
    template <class Function>
    NUSSELT_INLINE static float reduce(const P& p, Function f) noexcept {
        float lanes[L];
        p.store(lanes);
        for (int step = L / 2; step > 0; step /= 2)
            for (int i = 0; i < step; ++i) lanes[i] = f(lanes[i], lanes[i + step]);
        return lanes[0];
    }
};

#if defined(__SSE2__)
template <>
struct AcrossLanes<4> {
    using P = Pack<float, 4>;

    template <class Function>
    NUSSELT_INLINE static P from(Function f) noexcept {
        return P::from_native(_mm_setr_ps(f(0), f(1), f(2), f(3)));
    }
    NUSSELT_INLINE static P permute(const P& p, const std::int32_t* indices) noexcept {
#if defined(__AVX2__) && defined(__FMA__)
        return P::from_native(
            _mm_permutevar_ps(p.native(), _mm_loadu_si128(reinterpret_cast<const __m128i*>(indices))));
#else
        float lanes[4];
        p.store(lanes);
        return from([&](int i) { return lanes[indices[i]]; });
#endif
    }
    NUSSELT_INLINE static P sums_before(const P& p) noexcept {
        const auto by = [&](auto bytes) {
            constexpr int kBytes = decltype(bytes)::value;
            return P::from_native(_mm_castsi128_ps(_mm_slli_si128(_mm_castps_si128(p.native()), kBytes)));
        };
        return by(std::integral_constant<int, 4>()) + by(std::integral_constant<int, 8>()) +
               by(std::integral_constant<int, 12>());
    }
    template <class Function>
    NUSSELT_INLINE static float reduce(const P& p, Function f) noexcept {
        const P pairs = f(p, P::from_native(_mm_movehl_ps(p.native(), p.native())));
        const P other = P::from_native(_mm_shuffle_ps(pairs.native(), pairs.native(), 1));
        return _mm_cvtss_f32(f(pairs, other).native());
    }
};

template <>
struct AcrossLanes<8> {
    using P = Pack<float, 8>;
    using Half = Pack<float, 4>;

    template <class Function>
    NUSSELT_INLINE static P from(Function f) noexcept {
#if defined(__AVX2__) && defined(__FMA__)
        return P::from_native(_mm256_setr_ps(f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7)));
#else
        return P::from_native({_mm_setr_ps(f(0), f(1), f(2), f(3)), _mm_setr_ps(f(4), f(5), f(6), f(7))});
#endif
    }
    NUSSELT_INLINE static P permute(const P& p, const std::int32_t* indices) noexcept {
#if defined(__AVX2__) && defined(__FMA__)
        return P::from_native(_mm256_permutevar8x32_ps(
            p.native(), _mm256_loadu_si256(reinterpret_cast<const __m256i*>(indices))));
#else
        float lanes[8];
        p.store(lanes);
        return from([&](int i) { return lanes[indices[i]]; });
#endif
    }
    NUSSELT_INLINE static Half permute_to_half(const P& p, const std::int32_t* indices) noexcept {
#if defined(__AVX2__) && defined(__FMA__)
        const __m128i four = _mm_loadu_si128(reinterpret_cast<const __m128i*>(indices));
        return Half::from_native(
            _mm256_castps256_ps128(_mm256_permutevar8x32_ps(p.native(), _mm256_castsi128_si256(four))));
#else
        float lanes[8];
        p.store(lanes);
        return AcrossLanes<4>::from([&](int i) { return lanes[indices[i]]; });
#endif
    }
    NUSSELT_INLINE static P sums_before(const P& p) noexcept {
        float lanes[8];
        p.store(lanes);
        float sum[8] = {};
        for (int i = 1; i < 8; ++i) sum[i] = sum[i - 1] + lanes[i - 1];
        return from([&](int i) { return sum[i]; });
    }
    template <class Function>
    NUSSELT_INLINE static float reduce(const P& p, Function f) noexcept {
#if defined(__AVX2__) && defined(__FMA__)
        const Half low = Half::from_native(_mm256_castps256_ps128(p.native()));
        const Half high = Half::from_native(_mm256_extractf128_ps(p.native(), 1));
#else
        const Half low = Half::from_native(p.native().low);
        const Half high = Half::from_native(p.native().high);
#endif
        return AcrossLanes<4>::reduce(f(low, high), f);
    }
};
#endif

} // namespace detail

/// The number of lanes in which scalar code keeps so many vertices.
constexpr int lanes_for(int count) noexcept { return count <= 4 ? 4 : count <= 8 ? 8 : 16; }

/// The pack whose lane i is f(i).
template <int L, class Function>
NUSSELT_INLINE Pack<float, L> make_lanes(Function f) noexcept {
    return detail::AcrossLanes<L>::from(f);
}
/// The vectors whose lane i is f(i).
template <int L, class Function>
NUSSELT_INLINE Vec3<Pack<float, L>> make_vector_lanes(Function f) noexcept {
    return {make_lanes<L>([&](int i) { return f(i).x; }), make_lanes<L>([&](int i) { return f(i).y; }),
            make_lanes<L>([&](int i) { return f(i).z; })};
}

/// Lane i of the result is lane indices[i].
/// \tparam S      number of lanes of the result, L or half of it.
/// \param indices S of them, each in [0, L).
template <int S, int L>
NUSSELT_INLINE Pack<float, S> permute(const Pack<float, L>& p, const std::int32_t* indices) noexcept {
    static_assert(S == L || 2 * S == L, "all lanes, or half of them");
    if constexpr (S == L)
        return detail::AcrossLanes<L>::permute(p, indices);
    else
        return detail::AcrossLanes<L>::permute_to_half(p, indices);
}
/// \copydoc permute
template <int S, int L>
NUSSELT_INLINE Vec3<Pack<float, S>> permute(const Vec3<Pack<float, L>>& v,
                                            const std::int32_t* indices) noexcept {
    return {permute<S>(v.x, indices), permute<S>(v.y, indices), permute<S>(v.z, indices)};
}

/// Lane i of the result is the sum of lanes 0 to i - 1.
template <int L>
NUSSELT_INLINE Pack<float, L> sums_before(const Pack<float, L>& p) noexcept {
    return detail::AcrossLanes<L>::sums_before(p);
}
/// \copydoc sums_before
template <int L>
NUSSELT_INLINE Vec3<Pack<float, L>> sums_before(const Vec3<Pack<float, L>>& v) noexcept {
    return {sums_before(v.x), sums_before(v.y), sums_before(v.z)};
}

template <int L>
NUSSELT_INLINE float largest_lane(const Pack<float, L>& p) noexcept {
    return detail::AcrossLanes<L>::reduce(p, [](auto a, auto b) { return max(a, b); });
}
template <int L>
NUSSELT_INLINE float smallest_lane(const Pack<float, L>& p) noexcept {
    return detail::AcrossLanes<L>::reduce(p, [](auto a, auto b) { return min(a, b); });
}

/// L floats in memory, of which scalar code reads single ones.
template <int L>
struct StoredLanes {
    float lane[L];
};

NUSSELT_NAMESPACE_END
#endif
