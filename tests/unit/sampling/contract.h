#pragma once
/// The contract of a technique (proof/hostile/contract.h) for tests.

#include <cstdio>
#include <cstring>
#include <string>

#include <nusselt/simd/pack.h>

#include "proof/hostile/contract.h"
#include "proof/hostile/lights.h"
#include "techniques.h"

namespace nusselt_test {

using NativeFloat = nusselt::Pack<float, nusselt::kNativeLanes<float>>;
using NativeDouble = nusselt::Pack<double, nusselt::kNativeLanes<double>>;

/// All numbers of a light, random number or sample in hexadecimal, to be pasted into a regression test.
template <class T, class Struct>
std::string hexadecimal(const Struct& numbers) {
    std::string text;
    for (std::size_t i = 0; i < sizeof(Struct) / sizeof(T); ++i) {
        T x;
        std::memcpy(&x, reinterpret_cast<const unsigned char*>(&numbers) + i * sizeof(T), sizeof(T));
        char buffer[64];
        std::snprintf(buffer, sizeof buffer, "%La ", static_cast<long double>(x));
        text += buffer;
    }
    return text;
}

template <class Kind, class T>
typename Kind::template Light<T> hostile_light(HostileLights<T>& lights) {
    const auto light = [&] {
        if constexpr (kIsPolygon<Kind>) {
            return lights.template polygon<Kind::kVertices>();
        } else if constexpr (kIsCylinder<Kind>) {
            return lights.cylinder();
        } else if constexpr (kIsRound<Kind>) {
            return lights.ellipsoid();
        } else {
            return lights.line();
        }
    }();
    if constexpr (kHasLobe<Kind>) {
        return {Kind::from(light), lights.lobe()};
    } else {
        return Kind::from(light);
    }
}

template <class Kind, class T>
auto hostile_random(HostileLights<T>& lights) {
    if constexpr (kTakesPairs<Kind>) {
        const T x = lights.random_number();
        return nusselt::Vec2<T>{x, lights.random_number()};
    } else {
        return lights.random_number();
    }
}

} // namespace nusselt_test
