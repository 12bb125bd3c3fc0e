#pragma once
/// The functions of a technique over blocks of columns.

#include <new>
#include <type_traits>

#include <nusselt/core/light_sample.h>
#include <nusselt/ltc/ltc.h>

#include "python/kernels/kernel.h"
#include "wasm/light_columns.h"

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

    static void prepare(const Block<Scalar>& block, void* state) noexcept {
        for (int pack = 0; pack < block.packs; ++pack)
            new (static_cast<Technique*>(state) + pack)
                Technique(make(reader<Real>(block, 0, pack), block.columns));
    }
    static void sample(const Block<Scalar>& block) noexcept {
        for_each(block, [&](const Technique& technique, int pack) {
            const LightSample<Real> sample = draw(technique, random(reader<Real>(block, 0, pack)));
            writer<Real>(block, 0, pack).vector(0, sample.wi);
            writer<Real>(block, 1, pack).number(0, sample.pdf);
            writer<Real>(block, 2, pack).vector(0, sample.p);
        });
    }
    static void pdf(const Block<Scalar>& block) noexcept {
        for_each(block, [&](const Technique& technique, int pack) {
            writer<Real>(block, 0, pack).number(0, technique.pdf(reader<Real>(block, 0, pack).vector(0)));
        });
    }
    static void invert(const Block<Scalar>& block) noexcept {
        for_each(block, [&](const Technique& technique, int pack) {
            const auto inverse = technique.invert(reader<Real>(block, 0, pack).vector(0));
            const auto u = writer<Real>(block, 0, pack);
            if constexpr (Light::kRandom == 1) {
                u.number(0, inverse);
            } else {
                u.number(0, inverse.x);
                u.number(1, inverse.y);
            }
        });
    }
    static void measure(const Block<Scalar>& block) noexcept {
        for_each(block, [&](const Technique& technique, int pack) {
            writer<Real>(block, 0, pack).number(0, technique.measure());
        });
    }

    static constexpr python::TechniqueRow<Scalar> row(const char* name, const char* light) noexcept {
        return {
            name,   light, Light::takes, Light::kRandom, RealTraits<Real>::kLanes, sizeof(Technique), prepare,
            sample, pdf,   invert,       measure};
    }

private:
    static Technique make(const columns::Reader<Real>& light, int columns) noexcept {
        if constexpr (std::is_constructible_v<Technique, decltype(Light::read(light, columns))>)
            return Technique(Light::read(light, columns));
        else
            return Technique(Light::read(light, columns), Ltc(Light::lobe(light, columns)));
    }

    template <class Visit>
    static void for_each(const Block<Scalar>& block, const Visit& visit) noexcept {
        const char* state = static_cast<const char*>(block.state);
        for (int pack = 0; pack < block.packs; ++pack, state += block.step)
            visit(*reinterpret_cast<const Technique*>(state), pack);
    }

    static Vec2<Real> random(const columns::Reader<Real>& u) noexcept {
        if constexpr (Light::kRandom == 1)
            return {u.number(0), Real(0)};
        else
            return {u.number(0), u.number(1)};
    }
};

} // namespace kernels
NUSSELT_NAMESPACE_END
