#pragma once
/// Arrays of numpy as operands of loops.

#include "python/loops/loop.h"

#include <pybind11/numpy.h>

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace nusselt::python {

/// The strides of an array whose first axes are those of a loop; a last axis of its own has the numbers of an element.
template <class Number>
Operand<Number> operand_of(const pybind11::array& array, std::size_t axes) {
    constexpr auto kBytes = static_cast<std::ptrdiff_t>(sizeof(Number));
    const auto rank = static_cast<std::size_t>(array.ndim());
    if (!pybind11::isinstance<pybind11::array_t<std::remove_const_t<Number>>>(array) ||
        (rank != axes && rank != axes + 1))
        throw std::logic_error("an array has another type or rank than its loop");
    Operand<Number> operand;
    if constexpr (std::is_const_v<Number>)
        operand.data = static_cast<Number*>(array.data());
    else
        operand.data = static_cast<Number*>(const_cast<pybind11::array&>(array).mutable_data());
    for (std::size_t i = 0; i < axes; ++i)
        operand.strides.push_back(array.strides(static_cast<int>(i)) / kBytes);
    if (rank > axes) {
        operand.size = static_cast<int>(array.shape(static_cast<int>(axes)));
        operand.component = array.strides(static_cast<int>(axes)) / kBytes;
    }
    return operand;
}

/// A loop over arrays that have its shape as their first axes.
template <class Scalar>
Loop<Scalar> loop_of(const std::vector<std::ptrdiff_t>& shape, const std::vector<pybind11::array>& inputs,
                     const std::vector<pybind11::array>& outputs) {
    if (inputs.size() > kMostInputs || outputs.size() > kMostOutputs)
        throw std::logic_error("a kernel has fewer operands");
    Loop<Scalar> loop;
    loop.shape = shape;
    loop.light_strides.resize(shape.size());
    for (const pybind11::array& input : inputs)
        loop.inputs.push_back(operand_of<const Scalar>(input, shape.size()));
    for (const pybind11::array& output : outputs)
        loop.outputs.push_back(operand_of<Scalar>(output, shape.size()));
    return loop;
}

/// The instruction set of all kernels: that of NUSSELT_ISA, or the best one.
inline base::Isa kernel_isa() {
    static const base::Isa isa = base::choose_isa();
    return isa;
}

} // namespace nusselt::python
