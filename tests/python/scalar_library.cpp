/// The techniques and functions of the package in scalars, one element after the other, as functions that Python's ctypes
/// calls: what arrays must have the bits of. Lanes, groups, blocks and buffers of the package play no role here.
#include "wasm/light_columns.h"

NUSSELT_NAMESPACE_BEGIN
namespace columns {

template <>
struct Reader<double> {
    const double* first;
    std::size_t stride;

    double number(int column) const noexcept { return first[static_cast<std::size_t>(column) * stride]; }
    Vec3<double> vector(int column) const noexcept {
        return {number(column), number(column + 1), number(column + 2)};
    }
};

template <>
struct Reader<float> {
    const float* first;
    std::size_t stride;

    float number(int column) const noexcept { return first[static_cast<std::size_t>(column) * stride]; }
    Vec3<float> vector(int column) const noexcept {
        return {number(column), number(column + 1), number(column + 2)};
    }
};

template <class Scalar>
struct ScalarWriter {
    Scalar* first;
    std::size_t stride;

    void number(int column, Scalar x) const noexcept { first[static_cast<std::size_t>(column) * stride] = x; }
    void vector(int column, const Vec3<Scalar>& v) const noexcept {
        number(column, v.x);
        number(column + 1, v.y);
        number(column + 2, v.z);
    }
};
template <>
struct Writer<double> : ScalarWriter<double> {};
template <>
struct Writer<float> : ScalarWriter<float> {};

} // namespace columns
NUSSELT_NAMESPACE_END

#include "python/kernels/function_kernels.h"
#include "python/kernels/techniques.h"

#include <cstddef>
#include <cstring>
#include <vector>

namespace {

using namespace nusselt;

/// \param inputs, outputs with contiguous columns
template <class Scalar>
python::Block<Scalar> block_of(int count, int columns, const Scalar* const* inputs, int input_count,
                               Scalar* const* outputs, int output_count) {
    const auto stride = static_cast<std::size_t>(count);
    python::Block<Scalar> block;
    block.packs = count;
    block.columns = columns;
    for (int i = 0; i < input_count; ++i) block.inputs[i] = {inputs[i], stride};
    for (int i = 0; i < output_count; ++i) block.outputs[i] = {outputs[i], stride};
    return block;
}

template <class Scalar>
bool call(const char* name, int count, int columns, const Scalar* const* inputs, int input_count,
          Scalar* const* outputs, int output_count, const python::TableEntries& table) {
    for (const python::FunctionRow<Scalar>& row : kernels::kFunctions<Scalar>) {
        if (std::strcmp(row.name, name) != 0) continue;
        python::Block<Scalar> block = block_of(count, columns, inputs, input_count, outputs, output_count);
        block.state = &table;
        row.kernel(block);
        return true;
    }
    return false;
}

} // namespace

#define NUSSELT_EXPORT extern "C" __attribute__((visibility("default")))

/// \param inputs  the lights and u
/// \param outputs wi, pdf and p of the samples, density and inverse of wi, and the measure
/// \returns false if there is no such technique for lights of so many columns
NUSSELT_EXPORT bool nusselt_scalar_technique(const char* name, int count, int columns,
                                             const double* const* inputs, int input_count,
                                             double* const* outputs, int output_count) {
    if (input_count != 2 || output_count != 6) return false;
    for (const python::TechniqueRow<double>& row : kernels::kTechniques<double>) {
        if (std::strcmp(row.name, name) != 0 || !row.takes(columns)) continue;
        std::vector<std::max_align_t> state(
            static_cast<std::size_t>(count) * row.bytes / sizeof(std::max_align_t) + 1);
        row.prepare(block_of<double>(count, columns, inputs, 1, nullptr, 0), state.data());
        const auto run = [&](python::Kernel<double> kernel, const double* const* operands, int operand_count,
                             double* const* results, int result_count) {
            auto block = block_of(count, columns, operands, operand_count, results, result_count);
            block.state = state.data();
            block.step = row.bytes;
            kernel(block);
        };
        run(row.sample, inputs + 1, 1, outputs, 3);
        const double* const wi = outputs[0];
        run(row.pdf, &wi, 1, outputs + 3, 1);
        run(row.invert, &wi, 1, outputs + 4, 1);
        run(row.measure, nullptr, 0, outputs + 5, 1);
        return true;
    }
    return false;
}

/// \returns false if there is no such function
NUSSELT_EXPORT bool nusselt_scalar_function_double(const char* name, int count, int columns,
                                                   const double* const* inputs, int input_count,
                                                   double* const* outputs, int output_count,
                                                   const python::TableEntries* table) {
    return call(name, count, columns, inputs, input_count, outputs, output_count, *table);
}
NUSSELT_EXPORT bool nusselt_scalar_function_float(const char* name, int count, int columns,
                                                  const float* const* inputs, int input_count,
                                                  float* const* outputs, int output_count,
                                                  const python::TableEntries* table) {
    return call(name, count, columns, inputs, input_count, outputs, output_count, *table);
}
