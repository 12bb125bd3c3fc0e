#include "render_cpu/kernel/layers.h"

#include "base/isa.h"
#include "render_cpu/kernel/emission.h"

#include <cstring>
#include <limits>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

static_assert(kLanes == base::lane_count(base::Isa::NUSSELT_UNIT_ISA),
              "renderers take memory for lane_count()");

namespace {

/// part / whole, or 0 where that is not finite.
Real share(const Real& part, const Real& whole) noexcept {
    const auto usable = (whole > Real(0)) & (whole <= Real(std::numeric_limits<float>::max()));
    return select(usable, part / select(usable, whole, Real(1)), Real(0));
}

Vector shares(const Vector& part, const Vector& rest) noexcept {
    return {share(part.x, part.x + rest.x), share(part.y, part.y + rest.y), share(part.z, part.z + rest.z)};
}

Vector load_vector(const float* values) noexcept {
    return {Real::load(values), Real::load(values + kLanes), Real::load(values + 2 * kLanes)};
}

void store_vector(const Vector& v, float* values) noexcept {
    v.x.store(values);
    v.y.store(values + kLanes);
    v.z.store(values + 2 * kLanes);
}

} // namespace

DiffuseShares diffuse_shares(const GlossySurface<Real, SurfaceBrdf>& surface, const Vector& wi) noexcept {
    const BrdfComponents<Real> brdf = surface.brdf.eval_components(wi);
    return {shares(brdf.diffuse, brdf.specular), shares(surface.diffuse_albedo, surface.specular_albedo)};
}

void LayerSums::clear() noexcept {
    state_ = {};
    if (job_.layers.lights != nullptr) std::memset(light_sums_, 0, light_sum_bytes());
}

void LayerSums::resume(const State& state) noexcept {
    state_ = state;
    keep();
}

const LayerSums::State& LayerSums::keep() noexcept {
    if (job_.layers.lights != nullptr) std::memcpy(kept_light_sums_, light_sums_, light_sum_bytes());
    return state_;
}

void LayerSums::restore(const State& state) noexcept {
    state_ = state;
    if (job_.layers.lights != nullptr) std::memcpy(light_sums_, kept_light_sums_, light_sum_bytes());
}

std::size_t LayerSums::light_sum_bytes() const noexcept {
    return render_cpu::kLightSumFloatsPerLane * kLanes * job_.scene.emitter_count * sizeof(float);
}

void LayerSums::add_hits(const visibility::HitPacket<kLanes>& hits, LaneMask any_hit,
                         const Vector& direction) noexcept {
    const Real distance = Real::load(hits.t) * sqrt(dot(direction, direction));
    state_.depth_and_coverage.add(
        {select(any_hit, distance, Real(0)), select(any_hit, Real(1), Real(0)), Real(0)});
}

void LayerSums::add_surface(const Surface& surface) noexcept {
    const Vector zero{Real(0), Real(0), Real(0)};
    state_.albedo.add(weight_ * select(surface.valid, surface.glossy.brdf.lambert.albedo, zero));
    state_.normal.add(weight_ * select(surface.valid, surface.frame.n, zero));
}

void LayerSums::add_to_light(std::int32_t number, int lane, const float (&rgb)[3]) noexcept {
    float* sum = sums_of(job_.scene.light_emitter[number]) + lane;
    for (int k = 0; k < 3; ++k, sum += kLanes) {
        float& excess = sum[3 * kLanes];
        const float corrected = rgb[k] - excess;
        const float next = *sum + corrected;
        excess = (next - *sum) - corrected;
        *sum = next;
    }
}

void LayerSums::add_emission(const visibility::HitPacket<kLanes>& hits, const Vector& emitted,
                             const Vector& origin, const Vector& direction) noexcept {
    const Vector weighted = weight_ * emitted;
    state_.emission.add(weighted);
    if (job_.layers.lights == nullptr) return;
    const Lanes lanes = store(weighted);
    const Lanes o = store(origin);
    const Lanes d = store(direction);
    float weight[kLanes];
    weight_.store(weight);
    for (int i = 0; i < kLanes; ++i) {
        const std::int32_t light = light_of_hit(job_.scene, hits, i);
        if (light >= 0) add_to_light(light, i, {lanes.x[i], lanes.y[i], lanes.z[i]});
        if (!meets_nothing(hits, i)) continue;
        visit_background(job_.scene, {o.x[i], o.y[i], o.z[i]}, {d.x[i], d.y[i], d.z[i]},
                         [&](std::int32_t number, const scene::Float3& radiance) {
                             add_to_light(
                                 number, i,
                                 {weight[i] * radiance.x, weight[i] * radiance.y, weight[i] * radiance.z});
                         });
    }
}

void LayerSums::add_light(std::uint32_t number, const Reflected& reflected) noexcept {
    state_.diffuse.add(weight_ * reflected.diffuse);
    state_.specular.add(weight_ * (reflected.all - reflected.diffuse));
    if (job_.layers.lights == nullptr) return;
    float* values = sums_of(job_.scene.light_emitter[number]);
    CompensatedSum sum{load_vector(values), load_vector(values + 3 * kLanes)};
    sum.add(weight_ * reflected.all);
    store_vector(sum.sum, values);
    store_vector(sum.excess, values + 3 * kLanes);
}

void LayerSums::add_radiance(const Vector& radiance) noexcept {
    state_.rays += 1;
    const Vector deviation = radiance - state_.mean;
    state_.mean = state_.mean + Real(1 / state_.rays) * deviation;
    state_.square_deviations.add(deviation * (radiance - state_.mean));
}

void LayerSums::write(const PixelBlock& block) const noexcept {
    const render_cpu::LayerTargets& layers = job_.layers;
    const Real scale = Real(1 / state_.rays);
    const auto write_mean = [&](const Vector& sum, float* image) {
        if (image != nullptr) store_rgb(job_, block, scale * sum, image);
    };
    write_mean(state_.albedo.sum, layers.albedo);
    write_mean(state_.normal.sum, layers.normal);
    write_mean(state_.emission.sum, layers.emission);
    write_mean(state_.diffuse.sum, layers.diffuse);
    write_mean(state_.specular.sum, layers.specular);
    if (layers.depth != nullptr) {
        const Real hits = state_.depth_and_coverage.sum.y;
        store_grey(job_, block, state_.depth_and_coverage.sum.x / max(hits, Real(1)), layers.depth);
        store_grey(job_, block, scale * hits, layers.coverage);
    }
    if (layers.pieces != nullptr)
        store_grey(job_, block, state_.pieces.sum.y / max(state_.pieces.sum.x, Real(1)), layers.pieces);
    if (layers.variance != nullptr)
        store_rgb(job_, block, Real(1 / (state_.rays * (state_.rays - 1))) * state_.square_deviations.sum,
                  layers.variance);
    if (layers.lights == nullptr) return;
    for (std::uint32_t i = 0; i < job_.scene.emitter_count; ++i)
        write_mean(load_vector(sums_of(i)), layers.lights[i]);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
