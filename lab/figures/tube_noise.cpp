#include "lab/figures/tube_noise.h"

#include <nusselt/random/sobol.h>
#include <nusselt/random/unit_interval.h>
#include <nusselt/related/cylinder_rejection_gamito.h>
#include <nusselt/sampling/cylinder_ltc.h>
#include <nusselt/sampling/cylinder_projected_solid_angle.h>
#include <nusselt/sampling/cylinder_solid_angle.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/stopwatch.h"
#include "proof/median.h"

namespace nusselt::lab {

namespace {

template <class Real>
Cylinder<Real> make_cylinder(const proof::TubeLight& light) {
    return {make_line(broadcast<Real>(light.begin), broadcast<Real>(light.end)),
            static_cast<Real>(light.radius)};
}

struct WeightStatistics {
    double deviation; ///< relative to the mean
    double hits;      ///< share of samples with a density
};

template <class Technique, class Importance>
WeightStatistics weigh_samples(const Technique& technique, const Importance& importance) {
    constexpr int kCount = 1 << 16;
    double sum = 0;
    double squares = 0;
    int hits = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        // Use the middle between the coordinates of the net, so that the first point is not a corner.
        const UInt2 bits = sobol(i);
        const auto s = technique.sample(
            {to_unit<double>(bits.x) + 0.5 / kCount, to_unit<double>(bits.y) + 0.5 / kCount});
        if (!(s.pdf > 0)) continue;
        ++hits;
        const double weight = importance(s.wi) / s.pdf;
        sum += weight;
        squares += weight * weight;
    }
    return {std::sqrt(std::max(squares * kCount / (sum * sum) - 1, 0.0)), static_cast<double>(hits) / kCount};
}

constexpr int kTimedTurns = 256;

/// The light seen in different azimuths, which all techniques are indifferent to: no two are the same to the compiler.
std::vector<Cylinder<float>> turned(const proof::TubeLight& light) {
    std::vector<Cylinder<float>> result;
    for (int i = 0; i < kTimedTurns; ++i) {
        const double angle = 2 * std::numbers::pi * i / kTimedTurns;
        const auto turn = [c = std::cos(angle), s = std::sin(angle)](const Vec3<double>& v) {
            return Vec3<double>{c * v.x - s * v.y, s * v.x + c * v.y, v.z};
        };
        result.push_back(
            make_cylinder<float>({light.name, turn(light.begin), turn(light.end), light.radius}));
    }
    return result;
}

/// Time for preparing each light and taking a sample of it [s].
template <class Technique>
double time_samples(const std::vector<Cylinder<float>>& lights) {
    // Short runs are repeated until the clock's resolution does not matter.
    constexpr std::uint32_t kSamplesPerLight = 4;
    static volatile float sink;
    float total = 0;
    const base::Stopwatch stopwatch;
    std::uint32_t index = 0;
    for (std::uint32_t k = 0; k < kSamplesPerLight; ++k)
        for (const Cylinder<float>& light : lights) {
            const UInt2 bits = sobol(index++);
            const auto s = Technique(light).sample({to_unit(bits.x), to_unit(bits.y)});
            total += s.wi.x + s.wi.y + s.wi.z + s.pdf + s.p.x + s.p.y + s.p.z;
        }
    const double seconds = stopwatch.seconds();
    sink = total;
    (void)sink;
    return seconds;
}

} // namespace

TubeNoise measure_tube_noise(const proof::TubeLight& light) {
    using Direction = Vec3<double>;
    const auto cylinder = make_cylinder<double>(light);
    const Ltc<double> lobe(proof::kGlossyLobe);
    const auto one = [](const Direction&) { return 1.0; };
    const auto cosine = [](const Direction& wi) { return std::max(wi.z, 0.0); };
    const auto density = [&](const Direction& wi) { return lobe.density(wi); };

    const WeightStatistics rejection = weigh_samples(CylinderRejectionGamito<double>(cylinder), cosine);
    return {weigh_samples(CylinderSolidAngle<double>(cylinder), one).deviation,
            weigh_samples(CylinderProjectedSolidAngle<double>(cylinder), cosine).deviation,
            weigh_samples(CylinderLtc<double>(cylinder, lobe), density).deviation, rejection.hits,
            rejection.deviation};
}

double measure_tube_time_ratio(const proof::TubeLight& light, int repetitions) {
    const std::vector<Cylinder<float>> lights = turned(light);
    std::vector<double> ratios;
    for (int i = 0; i < repetitions; ++i) {
        const double ours = time_samples<CylinderProjectedSolidAngle<float>>(lights);
        ratios.push_back(ours / time_samples<CylinderRejectionGamito<float>>(lights));
    }
    return proof::median(std::move(ratios));
}

} // namespace nusselt::lab
