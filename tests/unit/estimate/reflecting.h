#pragma once
/// Surfaces under hostile and ordinary lights, as scalars and packs.

#include <cmath>

#include <nusselt/estimate/direct_light.h>

#include "sampling/contract.h"
#include "sampling/lights.h"

namespace nusselt_test {

/// All that an estimate of direct light depends on, as plain numbers.
template <class Real, class LightType>
struct Reflection {
    using Light = LightType;

    Light light;
    nusselt::LtcCoefficients<Real> lobe;
    nusselt::Vec3<Real> wo;
    nusselt::Vec3<Real> albedo, f0;
    Real roughness;
    nusselt::Vec2<Real> u[2];

    nusselt::GlossySurface<Real> surface() const {
        const nusselt::Frostbite<Real> brdf(wo, albedo, f0, roughness);
        // A stand-in for the albedo from a table.
        const nusselt::Vec3<Real> specular_albedo = lobe.albedo * f0;
        return {wo,
                nusselt::ggx_alpha(roughness),
                brdf,
                nusselt::Ltc<Real>(lobe),
                brdf.diffuse_albedo(),
                specular_albedo};
    }
};

template <class Real>
using PolygonReflection = Reflection<Real, nusselt::ConvexPolygon<Real, 4>>;
template <class Real>
using LineReflection = Reflection<Real, nusselt::LineSegment<Real>>;
template <class Real>
using CylinderReflection = Reflection<Real, nusselt::Cylinder<Real>>;

/// Valid but often extreme cases: black, white and coloured surfaces, mirrors, and eyes below the surface.
template <class T>
class HostileReflections {
public:
    explicit HostileReflections(std::uint64_t seed) : lights_(seed), random_(seed + 1) {}

    template <class Case>
    Case next() {
        Case c;
        if constexpr (std::is_same_v<Case, PolygonReflection<T>>)
            c.light = lights_.template polygon<4>();
        else if constexpr (std::is_same_v<Case, CylinderReflection<T>>)
            c.light = lights_.cylinder();
        else
            c.light = lights_.line();
        fill(c);
        return c;
    }

    /// Sets everything but the light.
    template <class Case>
    void fill(Case& c) {
        c.lobe = lights_.lobe();
        const double z = random_.index(4) == 0 ? random_.log_between(1e-12, 1) : random_.between(-0.1, 1);
        c.wo = {static_cast<T>(std::sqrt((1 - z) * (1 + z))), 0, static_cast<T>(z)};
        c.albedo = colour();
        c.f0 = colour();
        c.roughness = random_.index(4) == 0 ? T(0) : static_cast<T>(random_.uniform());
        for (auto& u : c.u) u = {lights_.random_number(), lights_.random_number()};
    }

private:
    nusselt::Vec3<T> colour() {
        switch (random_.index(4)) {
        case 0:
            return {0, 0, 0};
        case 1:
            return {1, 1, 1};
        default:
            return {static_cast<T>(random_.uniform()), 0, static_cast<T>(random_.log_between(1e-6, 1))};
        }
    }

    HostileLights<T> lights_;
    RandomSource random_;
};

/// One sample of each technique with each heuristic, and one of a technique chosen at random.
template <class Real>
struct AllSamples {
    static constexpr int kCount = 13;
    nusselt::DirectLightSample<Real> sample[kCount];

    /// Whether sample i comes from the optimal heuristic.
    static constexpr bool is_optimal(int i) { return i == 8 || i == 9; }
};

template <class Strategies, class Real, class Light>
AllSamples<Real> all_samples(const Reflection<Real, Light>& c) {
    const nusselt::GlossySurface<Real> surface = c.surface();
    const nusselt::DirectLight<Real, Light, nusselt::Frostbite<Real>, Strategies> estimator(c.light, surface,
                                                                                            Real(1), Real(2));
    AllSamples<Real> result;
    auto* next = result.sample;
    const auto add = [&](const auto& heuristic) {
        *next++ = estimator.sample_diffuse(heuristic, c.u[0]);
        *next++ = estimator.sample_specular(heuristic, c.u[1]);
    };
    add(nusselt::BalanceHeuristic());
    add(nusselt::PowerHeuristic());
    add(nusselt::WeightedBalanceHeuristic());
    add(nusselt::ClampedOptimalHeuristic<Real>{Real(0.5f)});
    add(nusselt::OptimalHeuristic<Real>{Real(0.5f)});
    add(nusselt::SeparateComponents());
    *next = estimator.sample_one(c.u[0]);
    return result;
}

} // namespace nusselt_test
