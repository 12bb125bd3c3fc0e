#pragma once
/// The random numbers of the library for the orders of samples among the settings.

#include "render/settings.h"

#include <nusselt/random/light_random.h>

NUSSELT_NAMESPACE_BEGIN

inline Sampler sampler_of(render::SampleOrder order) noexcept {
    switch (order) {
    case render::SampleOrder::independent:
        return Sampler::independent;
    case render::SampleOrder::jittered:
        return Sampler::jittered;
    case render::SampleOrder::stratified:
        return Sampler::stratified;
    case render::SampleOrder::z_sobol:
        return Sampler::z_sobol;
    case render::SampleOrder::blue_noise:
        return Sampler::blue_noise;
    case render::SampleOrder::sobol:
        break;
    }
    return Sampler::sobol;
}

NUSSELT_NAMESPACE_END
