#pragma once
/// The functions of a technique over blocks of columns.

#include <new>

#include "python/kernels/kernel.h"
#include "wasm/technique_columns.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernels {

template <class Scalar>
using Block = python::Block<Scalar>;

/// Packs of float and of double that fill a register.
template <class Scalar>
using PackOf = Pack<Scalar, base::lane_count(base::Isa::NUSSELT_UNIT_ISA) * 4 / int(sizeof(Scalar))>;

/// The columns of a pack in an input or output.
template <class Real>
columns::Reader<Real> reader(const Block<scalar_t<Real>>& block, int input, int pack) noexcept {
    const auto& operand = block.inputs[input];
    return {operand.first + RealTraits<Real>::kLanes * pack, operand.stride};
}
template <class Real>
columns::Writer<Real> writer(const Block<scalar_t<Real>>& block, int output, int pack) noexcept {
    const auto& operand = block.outputs[output];
    return {operand.first + RealTraits<Real>::kLanes * pack, operand.stride};
}

/// \tparam Light     one of the kinds in light_columns.h
/// \tparam Technique for such lights in a pack
template <class Light, class Technique, class Real>
struct TechniqueKernels {
    using Scalar = scalar_t<Real>;
    using Of = columns::TechniqueOf<Light, Technique, Real>;

    static void prepare(const Block<Scalar>& block, void* state) noexcept {
        for (int pack = 0; pack < block.packs; ++pack)
            new (static_cast<Technique*>(state) + pack)
                Technique(Of::make(reader<Real>(block, 0, pack), block.columns));
    }
    static void sample(const Block<Scalar>& block) noexcept {
        for_each(block, [&](const Technique& technique, int pack) {
            Of::sample(technique, reader<Real>(block, 0, pack), writer<Real>(block, 0, pack),
                       writer<Real>(block, 1, pack), writer<Real>(block, 2, pack));
        });
    }
    static void pdf(const Block<Scalar>& block) noexcept {
        for_each(block, [&](const Technique& technique, int pack) {
            Of::pdf(technique, reader<Real>(block, 0, pack), writer<Real>(block, 0, pack));
        });
    }
    static void invert(const Block<Scalar>& block) noexcept {
        for_each(block, [&](const Technique& technique, int pack) {
            Of::invert(technique, reader<Real>(block, 0, pack), writer<Real>(block, 0, pack));
        });
    }
    static void measure(const Block<Scalar>& block) noexcept {
        for_each(block, [&](const Technique& technique, int pack) {
            Of::measure(technique, writer<Real>(block, 0, pack));
        });
    }

    static constexpr python::TechniqueRow<Scalar> row(const char* name, const char* light) noexcept {
        return {
            name,   light, Light::takes, Light::kRandom, RealTraits<Real>::kLanes, sizeof(Technique), prepare,
            sample, pdf,   invert,       measure};
    }

private:
    template <class Visit>
    static void for_each(const Block<Scalar>& block, const Visit& visit) noexcept {
        const char* state = static_cast<const char*>(block.state);
        for (int pack = 0; pack < block.packs; ++pack, state += block.step)
            visit(*reinterpret_cast<const Technique*>(state), pack);
    }
};

} // namespace kernels
NUSSELT_NAMESPACE_END
