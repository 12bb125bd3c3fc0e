#include "lab/timing/sampler_loops.h"

#include <algorithm>

namespace nusselt::lab {

AnyArray::AnyArray(int count, std::size_t size)
    : size_(size), lines_((static_cast<std::size_t>(count) * size + kLine - 1) / kLine) {}

LoadedLights::LoadedLights(const TimedLights& lights, const TimedLightType& type, int lanes)
    : groups(kTimedLights / lanes),
      light(groups, type.light_size),
      place(groups, type.place_size),
      random(groups, type.random_size),
      moved(1, type.light_size) {
    type.load(lights, light.element(0));
    type.load_random(lights, random.element(0));
    if (type.load_places) type.load_places(lights, place.element(0));
}

SamplerLoops::SamplerLoops(const TimedTechnique& technique, LoadedLights& lights, int kept)
    : technique_(technique), lights_(lights), kept_(kept, technique.size) {}

void SamplerLoops::prepare(int begin, int end) {
    for (int i = begin; i < end; ++i) technique_.prepare(lights_.light.element(i), kept_.element(0));
}

void SamplerLoops::prepare_from_world(int begin, int end) {
    void* const moved = lights_.moved.element(0);
    for (int i = begin; i < end; ++i) {
        technique_.transform(lights_.place.element(i), moved);
        technique_.prepare(moved, kept_.element(0));
    }
}

void SamplerLoops::once(int begin, int end) {
    for (int i = begin; i < end; ++i) {
        technique_.prepare(lights_.light.element(i), kept_.element(0));
        technique_.sample(kept_.element(0), lights_.random.element(i), 1);
    }
}

void SamplerLoops::keep(int count) {
    for (int i = 0; i < count; ++i) technique_.prepare(lights_.light.element(i), kept_.element(i));
}

void SamplerLoops::draw(void (*function)(const void*, const void*, int), int count, int samples) {
    for (int i = 0; i < count; ++i)
        for (int left = samples; left > 0; left -= lights_.groups)
            function(kept_.element(i), lights_.random.element(0), std::min(left, lights_.groups));
}

} // namespace nusselt::lab
