#include "lab/emission/emission_timing.h"

#include "base/process_time.h"
#include "lab/emission/emission_timing_kernel.h"
#include "proof/hostile/lights.h"
#include "proof/median.h"

#include <nusselt/core/frame.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nusselt::lab {

namespace {

void put(float (&to)[3], const Vec3<double>& v) {
    to[0] = static_cast<float>(v.x);
    to[1] = static_cast<float>(v.y);
    to[2] = static_cast<float>(v.z);
}

Vec3<double> random_direction(hostile::RandomSource& random) {
    Vec3<double> v;
    do v = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    while (dot(v, v) > 1 || dot(v, v) < 1e-3);
    return normalize(v);
}

EmissionViews make_views() {
    EmissionViews views;
    hostile::RandomSource random(1, 21);
    const Vec3<double> centre{0.5, 0.5, 0};
    for (int i = 0; i < kEmissionViews; ++i) {
        Vec3<double> way, normal;
        do {
            way = random_direction(random);
            normal = random_direction(random);
        } while (way.z < 0.3 || dot(normal, way) > -0.1);
        const auto frame = Frame<double>::from_normal(normal);
        put(views.tangent[i], frame.t);
        put(views.bitangent[i], frame.b);
        put(views.normal[i], frame.n);
        put(views.position[i], centre + way);
        for (auto& u : views.u[i])
            for (float& x : u) x = std::min(static_cast<float>(random.uniform()), 0.999999f);
    }
    return views;
}

/// Times of one technique per shading point [ns].
struct Series {
    std::vector<double> prepare, first_sample, samples, density;
};

template <class Run>
void time_once(const Run& run, const EmissionViews& views, std::vector<double>& nanoseconds) {
    run(views); // Renderers run the same code for many pixels.
    const double begin = base::process_seconds();
    const float sum = run(views);
    nanoseconds.push_back(1e9 * (base::process_seconds() - begin) / kEmissionViews);
    // What nobody uses might not be computed.
    if (std::isnan(sum)) throw std::logic_error("a density is not a number");
}

} // namespace

std::vector<EmissionCost> time_emission(int repetitions, base::Isa isa) {
    const EmissionGroups groups =
        base::dispatch(isa, []<base::Isa chosen> { return emission_groups<chosen>(); });
    std::vector<const EmissionTechnique*> techniques;
    std::vector<std::size_t> uniform;
    for (int g = 0; g < groups.count; ++g) {
        uniform.resize(uniform.size() + static_cast<std::size_t>(groups.first[g].count), techniques.size());
        for (int i = 0; i < groups.first[g].count; ++i) techniques.push_back(groups.first[g].first + i);
    }
    const EmissionViews views = make_views();
    std::vector<Series> series(techniques.size());
    for (int k = -1; k < repetitions; ++k) {
        for (std::size_t i = 0; i < series.size(); ++i) {
            time_once(techniques[i]->prepare, views, series[i].prepare);
            time_once(techniques[i]->sample_once, views, series[i].first_sample);
            time_once(techniques[i]->sample_often, views, series[i].samples);
            time_once(techniques[i]->ask_density, views, series[i].density);
        }
        // The first round makes the lights.
        if (k < 0) std::fill(series.begin(), series.end(), Series());
    }
    std::vector<EmissionCost> costs;
    for (std::size_t i = 0; i < series.size(); ++i) {
        const double prepare = proof::median(series[i].prepare);
        const double first = proof::median(series[i].first_sample);
        costs.push_back({techniques[i]->name, uniform[i], prepare, first,
                         (proof::median(series[i].samples) - first) / (kEmissionSamples - 1),
                         proof::median(series[i].density) - prepare});
    }
    return costs;
}

} // namespace nusselt::lab
