#pragma once
/// The loops of the benches of samplers, over techniques as functions on memory (sampler_timing_kernel.h).

#include "lab/timing/sampler_timing_kernel.h"

#include <vector>

namespace nusselt::lab {

/// An array of elements of which only the size is known.
class AnyArray {
public:
    /// \param size of an element [bytes].
    AnyArray(int count, std::size_t size);
    void* element(int i) { return lines_.data()->bytes + static_cast<std::size_t>(i) * size_; }

private:
    static constexpr std::size_t kLine = 64;
    struct alignas(kLine) Line {
        std::byte bytes[kLine];
    };
    std::size_t size_;
    std::vector<Line> lines_;
};

/// The lights of a class in the type that some techniques take, in groups of as many as a pack has lanes.
struct LoadedLights {
    LoadedLights(const TimedLights& lights, const TimedLightType& type, int lanes);

    int groups;
    AnyArray light, place, random;
    AnyArray moved; ///< room for a light that is transformed
};

/// Each loop does one thing with the groups of lights from `begin` to `end`.
class SamplerLoops {
public:
    /// \param technique, lights must outlive this; lights are of the type that the technique takes.
    /// \param kept how many groups keep() prepares at most
    SamplerLoops(const TimedTechnique& technique, LoadedLights& lights, int kept);

    void prepare(int begin, int end);
    /// Transforms to shading space and prepares; for techniques with TimedTechnique::transform.
    void prepare_from_world(int begin, int end);
    /// Prepares and takes one sample.
    void once(int begin, int end);

    /// Prepares the first groups for draw().
    void keep(int count);
    /// Takes samples of each of the first groups.
    /// \param function TimedTechnique::sample or direction
    void draw(void (*function)(const void*, const void*, int), int count, int samples);

private:
    const TimedTechnique& technique_;
    LoadedLights& lights_;
    AnyArray kept_;
};

} // namespace nusselt::lab
