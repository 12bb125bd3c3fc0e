#pragma once
/// The techniques under test, and access to the lanes of their arguments and results.

#include <cstring>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include <nusselt/simd/pack.h>

#include "proof/techniques/interface.h"
#include "proof/techniques/registry.h"

namespace nusselt_test {

using namespace nusselt::hostile;

/// A technique and the number type with which it is instantiated: the parameter of typed tests.
template <class KindType, class RealType>
struct Instance {
    using Kind = KindType;
    using Real = RealType;
    using Scalar = nusselt::scalar_t<Real>;
    using Technique = typename Kind::template Technique<Real>;
    using ScalarTechnique = typename Kind::template Technique<Scalar>;
    using Light = typename Kind::template Light<Real>;
    using ScalarLight = typename Kind::template Light<Scalar>;
    using Random = typename Kind::template Random<Real>;
    using ScalarRandom = typename Kind::template Random<Scalar>;
    static constexpr int kLanes = nusselt::RealTraits<Real>::kLanes;
    static_assert(is_technique<Kind, Real>());
};

namespace detail {

template <class... Instances>
struct InstanceList {};
template <class... A, class... B>
InstanceList<A..., B...> operator+(InstanceList<A...>, InstanceList<B...>);

template <class... Instances>
::testing::Types<Instances...> types_of(InstanceList<Instances...>);

template <class... Reals, class... Kinds>
auto instances_of(KindList<Kinds...>) {
    const auto with_each_real = []<class Kind> { return InstanceList<Instance<Kind, Reals>...>(); };
    return (InstanceList<>() + ... + with_each_real.template operator()<Kinds>());
}

} // namespace detail

/// The types of a suite of tests: each technique of a KindList with each number type.
template <class List, class... Reals>
using Instances = decltype(detail::types_of(detail::instances_of<Reals...>(List())));

/// Names the tests of an instance, such as PolygonArea4_float.
struct InstanceNames {
    template <class Test>
    static std::string GetName(int) {
        using Scalar = typename Test::Scalar;
        std::string name = Test::Kind::kName;
        if constexpr (kIsPolygon<typename Test::Kind>) name += std::to_string(Test::Kind::kVertices);
        name += std::is_same_v<Scalar, float>    ? "_float"
                : std::is_same_v<Scalar, double> ? "_double"
                                                 : "_long_double";
        return Test::kLanes > 1 ? name + "_packs" : name;
    }
};

/// The tests of the distribution of samples, under the name of the suite in techniques.json.
struct StatisticsSuite {
    static constexpr std::string_view kName = "statistics";
};

/// Writes one lane of a struct of packs of T, or of a pack. A pack lies in memory as an array of its lanes.
template <class T, class Packed, class Single>
void set_lane(Packed& packed, int lane, const Single& single) {
    static_assert(std::is_trivially_copyable_v<Packed> && std::is_trivially_copyable_v<Single>);
    constexpr std::size_t kLanes = sizeof(Packed) / sizeof(Single);
    static_assert(sizeof(Packed) == kLanes * sizeof(Single) && sizeof(Single) % sizeof(T) == 0);
    auto* target = reinterpret_cast<unsigned char*>(&packed) + static_cast<std::size_t>(lane) * sizeof(T);
    const auto* source = reinterpret_cast<const unsigned char*>(&single);
    for (std::size_t i = 0; i < sizeof(Single); i += sizeof(T)) {
        std::memcpy(target + i * kLanes, source + i, sizeof(T));
    }
}

/// Reads one lane of a struct of packs of T, or of a pack.
template <class T, class Single, class Packed>
Single get_lane(const Packed& packed, int lane) {
    static_assert(std::is_trivially_copyable_v<Packed> && std::is_trivially_copyable_v<Single>);
    constexpr std::size_t kLanes = sizeof(Packed) / sizeof(Single);
    static_assert(sizeof(Packed) == kLanes * sizeof(Single) && sizeof(Single) % sizeof(T) == 0);
    Single single;
    auto* target = reinterpret_cast<unsigned char*>(&single);
    const auto* source =
        reinterpret_cast<const unsigned char*>(&packed) + static_cast<std::size_t>(lane) * sizeof(T);
    for (std::size_t i = 0; i < sizeof(Single); i += sizeof(T)) {
        std::memcpy(target + i, source + i * kLanes, sizeof(T));
    }
    return single;
}

} // namespace nusselt_test
