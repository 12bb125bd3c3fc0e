#pragma once
/// Kernels over arrays of any shape and strides.

#include "python/kernels/kernel.h"
#include "python/loops/lights.h"

#include <cstddef>
#include <vector>

namespace nusselt::python {

/// An array. Numbers of an element are `component` apart, elements that are neighbours along axis i of the loop strides[i];
/// both in numbers, 0 where an axis is broadcast.
template <class Number>
struct Operand {
    Number* data = nullptr;
    int size = 1; ///< numbers of an element
    std::ptrdiff_t component = 1;
    std::vector<std::ptrdiff_t> strides;
};

template <class Scalar>
struct Loop {
    std::vector<std::ptrdiff_t> shape;
    /// By how much the number of the light grows along each axis.
    std::vector<std::ptrdiff_t> light_strides;
    std::vector<Operand<const Scalar>> inputs;
    std::vector<Operand<Scalar>> outputs; ///< that overlap no input
};

/// Calls a kernel for all elements of a loop. Results do not depend on the number of threads.
/// \param lanes   of the packs of the kernel
/// \param threads at least 1
/// \throws std::runtime_error if the system does not start so many threads
template <class Scalar>
void run(Kernel<Scalar> kernel, int lanes, const State& state, const Loop<Scalar>& loop, int threads);

extern template void run(Kernel<float>, int, const State&, const Loop<float>&, int);
extern template void run(Kernel<double>, int, const State&, const Loop<double>&, int);

} // namespace nusselt::python
