#pragma once
/// The packs of kernels: as many lanes as the registers of the instruction set hold, with one pixel per lane.
///
/// Everything in this folder is compiled once per instruction set. Standard containers and algorithms must
/// not appear here: the linker would merge their inline functions across instruction sets.

#include "scene/model/scene.h"

#include <nusselt/core/vec.h>
#include <nusselt/simd/pack.h>

#include <cstdint>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

inline constexpr int kLanes = kNativeLanes<float>;
using Real = Pack<float, kLanes>;
using LaneMask = Mask<float, kLanes>;
using Vector = Vec3<Real>;

/// One integer per lane.
struct Indices {
    alignas(4 * kLanes) std::int32_t lane[kLanes];
};

/// A packet of vectors in memory, for access to single lanes.
struct Lanes {
    alignas(4 * kLanes) float x[kLanes];
    float y[kLanes];
    float z[kLanes];
};

inline Lanes store(const Vector& v) noexcept {
    Lanes lanes;
    v.x.store(lanes.x);
    v.y.store(lanes.y);
    v.z.store(lanes.z);
    return lanes;
}

inline Vector load(const Lanes& lanes) noexcept {
    return {Real::load(lanes.x), Real::load(lanes.y), Real::load(lanes.z)};
}

inline std::uint64_t count_lanes(LaneMask mask) noexcept {
    return static_cast<std::uint64_t>(__builtin_popcount(mask.bits()));
}

/// That of scene/model/library_vector.h is compiled without the instruction set of the kernel.
inline Vec3<float> to_vec(const scene::Float3& v) noexcept { return {v.x, v.y, v.z}; }

/// Loads the entry `column` from rows of `stride` floats. Each active lane has its row number; the other lanes are 0.
inline Real gather_column(const float* rows, int stride, int column, const Indices& row,
                          LaneMask active) noexcept {
    Indices scaled;
    for (int i = 0; i < kLanes; ++i) scaled.lane[i] = stride * row.lane[i];
    return Real::gather(rows + column, scaled.lane, active);
}

/// Loads three consecutive entries, starting at `column`, from rows of `stride` floats.
inline Vector gather_vector(const float* rows, int stride, int column, const Indices& row,
                            LaneMask active) noexcept {
    return {gather_column(rows, stride, column, row, active),
            gather_column(rows, stride, column + 1, row, active),
            gather_column(rows, stride, column + 2, row, active)};
}

/// A sum with the error of a single rounding, regardless of the number of terms (Kahan).
struct CompensatedSum {
    Vector sum{Real(0), Real(0), Real(0)};
    Vector excess{Real(0), Real(0), Real(0)}; ///< by which `sum` is too large

    void add(const Vector& term) noexcept {
        const Vector corrected = term - excess;
        const Vector next = sum + corrected;
        excess = (next - sum) - corrected;
        sum = next;
    }
};

} // namespace kernel
NUSSELT_NAMESPACE_END
