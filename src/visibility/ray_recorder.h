#pragma once
/// Recording of rays, to measure what Embree alone takes for them.

#include "visibility/embree_packets.h"
#include "visibility/embree_scene.h"

#include <tbb/enumerable_thread_specific.h>
#include <time.h>

#include <cstddef>
#include <vector>

namespace nusselt::visibility {

/// Consecutive queries of one thread, ready for Embree. Small enough for copies to stay in the cache.
template <int N>
struct RayBatch {
    static constexpr std::size_t kCapacity = 32;
    std::vector<ClosestHitQuery<N>> closest_hit;
    std::vector<ShadowQuery<N>> shadow;
};

/// Times of Embree's functions alone, without the time that other programs take from the thread [s].
struct ReplaySeconds {
    double closest_hit = 0;
    double shadow = 0;

    ReplaySeconds operator+(const ReplaySeconds& other) const {
        return {closest_hit + other.closest_hit, shadow + other.shadow};
    }
};

/// Traces packets of N rays as a scene does and remembers them.
template <int N>
class RayRecorder {
public:
    /// \param scene must outlive this object
    explicit RayRecorder(const EmbreeScene& scene) : inner_(scene.tracer()) {}
    RayRecorder(const RayRecorder&) = delete;
    RayRecorder& operator=(const RayRecorder&) = delete;

    /// Records packets of N, from any number of threads; no other width works. Valid as long as this object.
    RayTracer tracer() {
        RayTracer result{};
        static_cast<PacketTracer<N>&>(result) = {intersect, occluded};
        result.context = this;
        return result;
    }

    /// The rays recorded so far. Must not be called during recording.
    std::vector<const RayBatch<N>*> batches() const {
        std::vector<const RayBatch<N>*> result;
        for (const auto& of_thread : batches_)
            for (const RayBatch<N>& batch : of_thread) result.push_back(&batch);
        return result;
    }

    /// Traces a batch again. Embree overwrites packets, so this works on a copy; it is made, and with it the
    /// rays enter the cache, before the clock starts.
    ReplaySeconds replay(const RayBatch<N>& batch) const {
        RayBatch<N> copy = batch;
        const TracedScene& scene = traced_scene(inner_.context);
        const double begin = thread_seconds();
        for (ClosestHitQuery<N>& query : copy.closest_hit) query.trace(scene);
        const double middle = thread_seconds();
        for (ShadowQuery<N>& query : copy.shadow) query.trace(scene);
        return {middle - begin, thread_seconds() - middle};
    }

private:
    const PacketTracer<N>& inner() const { return inner_; }

    /// The processor time of the calling thread so far.
    static double thread_seconds() {
        timespec time;
        ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    /// The batch in which the calling thread records its next query.
    RayBatch<N>& current_batch() {
        std::vector<RayBatch<N>>& batches = batches_.local();
        if (batches.empty() ||
            batches.back().closest_hit.size() + batches.back().shadow.size() == RayBatch<N>::kCapacity)
            batches.emplace_back();
        return batches.back();
    }

    static RayRecorder& self(const void* context) {
        return *static_cast<RayRecorder*>(const_cast<void*>(context));
    }

    static void intersect(const void* context, std::uint32_t active, const RayPacket<N>& rays,
                          HitPacket<N>& hits) {
        RayRecorder& recorder = self(context);
        recorder.current_batch().closest_hit.emplace_back(active, rays);
        recorder.inner().intersect(recorder.inner_.context, active, rays, hits);
    }

    static std::uint32_t occluded(const void* context, std::uint32_t active, const RayPacket<N>& rays) {
        RayRecorder& recorder = self(context);
        recorder.current_batch().shadow.emplace_back(active, rays);
        return recorder.inner().occluded(recorder.inner_.context, active, rays);
    }

    RayTracer inner_;
    tbb::enumerable_thread_specific<std::vector<RayBatch<N>>> batches_;
};

} // namespace nusselt::visibility
