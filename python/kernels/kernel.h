#pragma once
/// The interface of the units that are compiled once per instruction set: functions over columns of numbers. Only plain
/// data crosses it.

#include "base/isa.h"

#include <cstddef>
#include <span>

namespace nusselt::python {

/// Number k of lane i of the first pack is first[k * stride + i]; the next pack follows that in each column.
template <class Number>
struct Columns {
    Number* first;
    std::size_t stride;
};

inline constexpr int kMostInputs = 5;
inline constexpr int kMostOutputs = 3;
/// Numbers of one element of the widest operand: polygons of eight vertices, with a lobe.
inline constexpr int kMostColumns = 3 * 8 + 5;

/// The operands of one call of a kernel.
template <class Scalar>
struct Block {
    const void* state = nullptr; ///< of the first pack, such as a prepared technique in each lane
    std::size_t step = 0;        ///< from the state of one pack to that of the next [bytes]
    int packs = 0;
    int columns = 0; ///< of the first input, for kernels that take lights of several sizes
    Columns<const Scalar> inputs[kMostInputs] = {};
    Columns<Scalar> outputs[kMostOutputs] = {};
};

/// A function of each element of a block.
template <class Scalar>
using Kernel = void (*)(const Block<Scalar>& block) noexcept;

/// A technique for lights with some numbers of columns (wasm/light_columns.h).
template <class Scalar>
struct TechniqueRow {
    const char* name;
    const char* light; ///< the kind in techniques.json
    bool (*takes)(int columns) noexcept;
    int random;        ///< random numbers of a sample
    int lanes;         ///< lights in a group
    std::size_t bytes; ///< of a prepared group
    /// Prepares the lights of the first input as groups: the state, which is written, of the others.
    void (*prepare)(const Block<Scalar>& block, void* state) noexcept;
    Kernel<Scalar> sample; ///< u -> wi, pdf, p
    Kernel<Scalar> pdf;    ///< wi -> pdf
    Kernel<Scalar> invert; ///< wi -> u
    Kernel<Scalar> measure;
};

/// A function of numbers, without a light that is prepared.
template <class Scalar>
struct FunctionRow {
    const char* name;
    int lanes;
    Kernel<Scalar> kernel;
};

/// Techniques, several rows in a sequence for one that is compiled for several kinds of lights.
template <base::Isa, class Scalar>
std::span<const TechniqueRow<Scalar>> technique_rows();

template <base::Isa, class Scalar>
std::span<const FunctionRow<Scalar>> function_rows();

/// A table of linearly transformed cosines, the state of the kernel that looks lobes up.
struct TableEntries {
    const float* entries;
    int roughnesses, inclinations, f0s;
};

} // namespace nusselt::python
