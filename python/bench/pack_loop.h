#pragma once
/// The loop that a C++ program would write where Python calls sample() of one light.

#include "base/isa.h"

#include <cstddef>

namespace nusselt::python {

/// The arrays of one call: u of count pairs, wi and p of count triples, pdf of count numbers. The count is a multiple of the
/// lanes.
struct PackLoop {
    const float* corners; ///< x, y, z of each of four
    std::size_t count;
    const float* u;
    float* wi;
    float* pdf;
    float* p;
};

/// Samples projected solid angles in packs, without calls of any kind in the loop.
template <base::Isa>
void sample_in_packs(const PackLoop& loop);

} // namespace nusselt::python
