#pragma once
/// The functions of a technique over columns of numbers: what the packages for JavaScript and for Python share.

#include <type_traits>

#include <nusselt/core/light_sample.h>
#include <nusselt/ltc/ltc.h>

#include "wasm/light_columns.h"

NUSSELT_NAMESPACE_BEGIN
namespace columns {

/// \tparam Light     one of the kinds in light_columns.h
/// \tparam Technique for such lights in a pack of numbers
template <class Light, class Technique, class Real>
struct TechniqueOf {
    static Technique make(const Reader<Real>& light, int count) noexcept {
        if constexpr (std::is_constructible_v<Technique, decltype(Light::read(light, count))>)
            return Technique(Light::read(light, count));
        else
            return Technique(Light::read(light, count), Ltc(Light::lobe(light, count)));
    }
    static void sample(const Technique& technique, const Reader<Real>& u, const Writer<Real>& wi,
                       const Writer<Real>& pdf, const Writer<Real>& p) noexcept {
        const LightSample<Real> sample = draw(technique, random(u));
        wi.vector(0, sample.wi);
        pdf.number(0, sample.pdf);
        p.vector(0, sample.p);
    }
    static void pdf(const Technique& technique, const Reader<Real>& wi, const Writer<Real>& pdf) noexcept {
        pdf.number(0, technique.pdf(wi.vector(0)));
    }
    static void invert(const Technique& technique, const Reader<Real>& wi, const Writer<Real>& u) noexcept {
        const auto inverse = technique.invert(wi.vector(0));
        if constexpr (Light::kRandom == 1) {
            u.number(0, inverse);
        } else {
            u.number(0, inverse.x);
            u.number(1, inverse.y);
        }
    }
    static void measure(const Technique& technique, const Writer<Real>& measure) noexcept {
        measure.number(0, technique.measure());
    }

private:
    static Vec2<Real> random(const Reader<Real>& u) noexcept {
        if constexpr (Light::kRandom == 1)
            return {u.number(0), Real(0)};
        else
            return {u.number(0), u.number(1)};
    }
};

} // namespace columns
NUSSELT_NAMESPACE_END
