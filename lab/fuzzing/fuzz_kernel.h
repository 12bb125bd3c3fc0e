#pragma once
/// The interface of the units compiled per instruction set to fuzz.cpp: plain data and functions.

#include "base/isa.h"

#include <cstdint>

namespace nusselt::lab {

enum class FuzzLight { quadrilateral, octagon, line, cylinder, ellipsoid };

/// Hostile configurations, one column each. Polygons with fewer vertices repeat the last one.
template <class T>
struct FuzzBlock {
    static constexpr int kSize = 512; ///< a multiple of all numbers of lanes
    T coordinates[8][3][kSize];       ///< of vertices; of the centre and the semi-diameters of ellipsoids
    T radius[kSize];                  ///< of cylinders; the first two vertices are the ends of the axis
    T u[2][kSize];
    T lobe[5][kSize]; ///< m00, m02, m11, m20, m22 of LtcCoefficients, for techniques that take a lobe
};

/// A configuration for which a technique broke the contract, and the results of the technique.
template <class T>
struct FuzzViolation {
    std::uint64_t index;
    const char* problem;
    T wi[3], pdf, p[3];
    T pdf_of_wi, inverse[2], measure;
};

/// The violations of a block, with the first ones in detail.
template <class T>
struct FuzzBlockResult {
    static constexpr int kKept = 3;
    int count = 0;
    FuzzViolation<T> first[kKept]; ///< index: column of the block
};

template <class T>
struct FuzzTechnique {
    const char* name; ///< name of the class
    FuzzLight light;
    /// Checks the first columns of the block. Their number is rounded up to a whole number of packs.
    void (*check)(const FuzzBlock<T>& block, int columns, FuzzBlockResult<T>& result);
    bool takes_lobe = false;
};

template <class T>
struct FuzzTable {
    const FuzzTechnique<T>* begin;
    int count;
};

/// Techniques in packs of float or double.
template <base::Isa, class T>
FuzzTable<T> fuzz_table();
/// Techniques in long double, for which no instruction set has packs.
FuzzTable<long double> fuzz_table_long_double();

} // namespace nusselt::lab
