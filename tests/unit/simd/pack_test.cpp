/// Compares every lane of every pack operation with the scalar operation of core/real.h, bit for bit, on hostile
/// values that differ from lane to lane. The test is built once per instruction set, as the same width is native in
/// one build and an array in another.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/core/vec.h>
#include <nusselt/simd/pack.h>

namespace {

using nusselt::kNativeLanes;
using nusselt::mask_t;
using nusselt::Pack;
using nusselt::RealTraits;
using nusselt::scalar_t;

// The scalar side of the comparisons.
using nusselt::abs;
using nusselt::copysign;
using nusselt::floor;
using nusselt::fma;
using nusselt::is_finite;
using nusselt::max;
using nusselt::min;
using nusselt::reciprocal_power_of_two;
using nusselt::select;
using nusselt::sqrt;

template <class P>
constexpr int kLanesOf = RealTraits<P>::kLanes;

template <class T>
using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

template <class T>
Bits<T> bits_of(T x) {
    Bits<T> bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}

template <class T>
T from_bits(Bits<T> bits) {
    T x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

/// Same bits, or both NaN. The compiler's order of operands decides which NaN an operation yields.
template <class T>
bool identical(T a, T b) {
    return bits_of(a) == bits_of(b) || (a != a && b != b);
}

bool identical(bool a, bool b) { return a == b; }

template <class T>
std::string hexadecimal(T x) {
    std::ostringstream text;
    text << std::hexfloat << x << " (bits " << std::hex << bits_of(x) << ")";
    return text.str();
}

/// Ends of ranges, ties and neighbours of powers of two, with both signs, followed by numbers with random bits.
template <class T>
std::vector<T> hostile_values() {
    using Limits = std::numeric_limits<T>;
    const T ulp = Limits::epsilon();
    const T mantissa_end = 2 / ulp;
    const std::vector<T> magnitudes{T(0),
                                    Limits::denorm_min(),
                                    Limits::min() - Limits::denorm_min(),
                                    Limits::min(),
                                    Limits::min() * (1 + ulp),
                                    Limits::min() * 2,
                                    Limits::min() * 4,
                                    T(1e-20),
                                    ulp,
                                    T(0.5) - ulp / 4,
                                    T(0.5),
                                    1 - ulp / 2,
                                    T(1),
                                    1 + ulp,
                                    T(1.5),
                                    T(2.5),
                                    T(3.14159265358979323846),
                                    mantissa_end / 2 - T(0.5),
                                    mantissa_end - 1,
                                    mantissa_end,
                                    T(2147483648.0),
                                    T(1e20),
                                    1 / Limits::min(),
                                    Limits::max() / 4,
                                    Limits::max() / 2,
                                    Limits::max(),
                                    Limits::infinity(),
                                    Limits::quiet_NaN()};
    std::vector<T> values;
    for (const T magnitude : magnitudes) {
        values.push_back(magnitude);
        values.push_back(-magnitude);
    }
    std::uint64_t state = 0x853c49e6748fea9bu;
    for (int i = 0; i < 103; ++i) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        values.push_back(from_bits<T>(static_cast<Bits<T>>(state >> (64 - 8 * sizeof(T)))));
    }
    return values;
}

/// Lane i holds value number start + stride * i, cyclically.
template <class P>
P strided_pack(const std::vector<scalar_t<P>>& values, std::size_t start, std::size_t stride) {
    std::array<scalar_t<P>, kLanesOf<P>> lanes;
    for (std::size_t i = 0; i < lanes.size(); ++i) lanes[i] = values[(start + stride * i) % values.size()];
    return P::load(lanes.data());
}

template <class T, class Result>
std::string describe_difference(const std::array<T, 3>& operands, Result actual, Result expected) {
    std::ostringstream text;
    text << "for";
    for (const T operand : operands) text << " " << hexadecimal(operand);
    text << std::hexfloat << " the pack gives " << actual << ", the scalar " << expected;
    return text.str();
}

/// Applies an operation to packs and to each of their lanes; describes the first lane that differs.
template <class P, class Operation>
std::optional<std::string> first_difference(Operation operation) {
    using T = scalar_t<P>;
    const std::vector<T> values = hostile_values<T>();
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t j = 0; j < values.size(); ++j) {
            const P a = strided_pack<P>(values, i, 1);
            const P b = strided_pack<P>(values, j, 3);
            const P c = strided_pack<P>(values, i * 7 + j * 5, 11);
            const auto result = operation(a, b, c);
            for (int lane = 0; lane < kLanesOf<P>; ++lane) {
                const std::array<T, 3> operands{a.lane(lane), b.lane(lane), c.lane(lane)};
                using Result = decltype(result.lane(lane));
                const auto actual = result.lane(lane);
                const auto expected = static_cast<Result>(operation(operands[0], operands[1], operands[2]));
                if (!identical(actual, expected)) return describe_difference(operands, actual, expected);
            }
        }
    }
    return std::nullopt;
}

#define EXPECT_LANES_MATCH(...)                                                                              \
    do {                                                                                                     \
        const auto operation = []([[maybe_unused]] auto a, [[maybe_unused]] auto b,                          \
                                  [[maybe_unused]] auto c) { return __VA_ARGS__; };                          \
        EXPECT_EQ(first_difference<TypeParam>(operation), std::nullopt);                                     \
    } while (false)

template <class P>
constexpr std::uint32_t kAllBitsOf = 0xffffffffu >> (32 - kLanesOf<P>);

/// No lane, all lanes, mixtures, and each lane alone.
template <class P>
std::vector<std::uint32_t> mask_patterns() {
    std::vector<std::uint32_t> patterns{0, kAllBitsOf<P>, 0x55555555u & kAllBitsOf<P>,
                                        0x9c3a7e61u & kAllBitsOf<P>};
    for (int i = 0; i < kLanesOf<P>; ++i) patterns.push_back(std::uint32_t{1} << i);
    return patterns;
}

template <class P>
class PackTest : public testing::Test {};

using PackTypes = testing::Types<Pack<float, 4>, Pack<float, 8>, Pack<float, 16>, Pack<double, 2>,
                                 Pack<double, 4>, Pack<double, 8>, Pack<float, 3>, Pack<double, 32>>;
TYPED_TEST_SUITE(PackTest, PackTypes);

TYPED_TEST(PackTest, IsTrivialAndDescribedByItsTraits) {
    using T = scalar_t<TypeParam>;
    static_assert(std::is_trivially_default_constructible_v<TypeParam>);
    static_assert(std::is_trivially_copyable_v<TypeParam>);
    static_assert(std::is_same_v<mask_t<TypeParam>, decltype(TypeParam() < TypeParam())>);
    static_assert(std::is_convertible_v<T, TypeParam>);
    static_assert(!std::is_convertible_v<int, mask_t<TypeParam>>);
    EXPECT_EQ(sizeof(T) * kNativeLanes<T>, sizeof(Pack<T, kNativeLanes<T>>));
    EXPECT_EQ(TypeParam{}.lane(kLanesOf<TypeParam> - 1), T(0));
    EXPECT_EQ(mask_t<TypeParam>{}.bits(), 0u);
}

TYPED_TEST(PackTest, BroadcastsScalarsOfAnyType) {
    using T = scalar_t<TypeParam>;
    const TypeParam implicit = T(0.1L);
    const auto from_int = TypeParam(-3);
    const auto from_long_double = TypeParam(0.1L);
    for (int i = 0; i < kLanesOf<TypeParam>; ++i) {
        EXPECT_EQ(implicit.lane(i), T(0.1L));
        EXPECT_EQ(from_int.lane(i), T(-3));
        EXPECT_EQ(from_long_double.lane(i), T(0.1L));
    }
}

TYPED_TEST(PackTest, LoadsAndStoresUnalignedBitForBit) {
    using T = scalar_t<TypeParam>;
    constexpr int kLanes = kLanesOf<TypeParam>;
    const std::vector<T> values = hostile_values<T>();
    for (std::size_t start = 0; start + kLanes <= values.size(); ++start) {
        std::array<T, kLanes + 2> target;
        target.fill(T(42));
        const TypeParam pack = TypeParam::load(&values[start]);
        pack.store(&target[1]);
        EXPECT_EQ(target.front(), T(42));
        EXPECT_EQ(target.back(), T(42));
        EXPECT_EQ(std::memcmp(&target[1], &values[start], sizeof(T) * kLanes), 0);
        for (int i = 0; i < kLanes; ++i) {
            EXPECT_EQ(bits_of(pack.lane(i)), bits_of(values[start + static_cast<std::size_t>(i)]));
        }
    }
}

TYPED_TEST(PackTest, SetsOneLaneAndNoOther) {
    using T = scalar_t<TypeParam>;
    const TypeParam before = strided_pack<TypeParam>(hostile_values<T>(), 5, 9);
    for (int i = 0; i < kLanesOf<TypeParam>; ++i) {
        TypeParam after = before;
        after.set_lane(i, T(42));
        for (int j = 0; j < kLanesOf<TypeParam>; ++j) {
            EXPECT_EQ(bits_of(after.lane(j)), bits_of(i == j ? T(42) : before.lane(j)));
        }
    }
}

TYPED_TEST(PackTest, GathersAnyIndices) {
    using T = scalar_t<TypeParam>;
    constexpr int kLanes = kLanesOf<TypeParam>;
    const std::vector<T> values = hostile_values<T>();
    const T* middle = &values[40];
    std::array<std::int32_t, kLanes> indices;
    for (int i = 0; i < kLanes; ++i) indices[static_cast<std::size_t>(i)] = (i * 29) % 97 - 40;
    const TypeParam pack = TypeParam::gather(middle, indices.data());
    for (int i = 0; i < kLanes; ++i) {
        EXPECT_EQ(bits_of(pack.lane(i)), bits_of(middle[indices[static_cast<std::size_t>(i)]]));
    }
}

TYPED_TEST(PackTest, GathersNothingWhereInactive) {
    using T = scalar_t<TypeParam>;
    constexpr int kLanes = kLanesOf<TypeParam>;
    const std::vector<T> values = hostile_values<T>();
    for (const std::uint32_t pattern : mask_patterns<TypeParam>()) {
        std::array<std::int32_t, kLanes> indices;
        for (int i = 0; i < kLanes; ++i) {
            // Reading an inactive lane would touch an address 8 GiB or more away.
            constexpr auto kWild = std::numeric_limits<std::int32_t>::max();
            const std::int32_t wild = i % 2 == 0 ? kWild : -kWild;
            indices[static_cast<std::size_t>(i)] = (pattern >> i & 1u) != 0 ? i * 3 : wild;
        }
        const TypeParam pack =
            TypeParam::gather(values.data(), indices.data(), mask_t<TypeParam>::from_bits(pattern));
        for (int i = 0; i < kLanes; ++i) {
            const T expected = (pattern >> i & 1u) != 0 ? values[static_cast<std::size_t>(i) * 3] : T(0);
            EXPECT_EQ(bits_of(pack.lane(i)), bits_of(expected)) << "lane " << i << " of mask " << pattern;
        }
    }
    const std::array<std::int32_t, kLanes> zeros{};
    const TypeParam from_nowhere = TypeParam::gather(nullptr, zeros.data(), mask_t<TypeParam>(false));
    EXPECT_TRUE(all(from_nowhere == TypeParam(0)));
}

TYPED_TEST(PackTest, Arithmetic) {
    EXPECT_LANES_MATCH(a + b);
    EXPECT_LANES_MATCH(a - b);
    EXPECT_LANES_MATCH(a * b);
    EXPECT_LANES_MATCH(a / b);
    EXPECT_LANES_MATCH(-a);
    EXPECT_LANES_MATCH(a += b);
    EXPECT_LANES_MATCH(a -= b);
    EXPECT_LANES_MATCH(a *= b);
    EXPECT_LANES_MATCH(a /= b);
}

TYPED_TEST(PackTest, ArithmeticWithScalars) {
    using T = scalar_t<TypeParam>;
    EXPECT_LANES_MATCH(a + T(0.3L));
    EXPECT_LANES_MATCH(T(0.3L) - a);
    EXPECT_LANES_MATCH(T(0.3L) * a);
    EXPECT_LANES_MATCH(a / T(0.3L));
    EXPECT_LANES_MATCH(a *= T(0.3L));
    EXPECT_LANES_MATCH(a < T(1));
    EXPECT_LANES_MATCH(T(1) <= a);
    EXPECT_LANES_MATCH(max(a, T(0)));
}

TYPED_TEST(PackTest, Comparisons) {
    EXPECT_LANES_MATCH(a < b);
    EXPECT_LANES_MATCH(a <= b);
    EXPECT_LANES_MATCH(a > b);
    EXPECT_LANES_MATCH(a >= b);
    EXPECT_LANES_MATCH(a == b);
    EXPECT_LANES_MATCH(a != b);
    EXPECT_LANES_MATCH((a < b) & (b < c));
    EXPECT_LANES_MATCH((a < b) | !(b < c));
    EXPECT_LANES_MATCH((a < b) ^ (b < c));
}

TYPED_TEST(PackTest, Functions) {
    EXPECT_LANES_MATCH(sqrt(a));
    EXPECT_LANES_MATCH(floor(a));
    EXPECT_LANES_MATCH(max(a, b));
    EXPECT_LANES_MATCH(min(a, b));
    EXPECT_LANES_MATCH(is_finite(a));
    EXPECT_LANES_MATCH(reciprocal_power_of_two(a));
    EXPECT_LANES_MATCH(select(a < b, b, c));
}

TYPED_TEST(PackTest, FusedMultiplyAdd) {
    EXPECT_LANES_MATCH(fma(a, b, c));
    EXPECT_LANES_MATCH(fma(a, b, -c));
    EXPECT_LANES_MATCH(fma(-a, b, c));
    EXPECT_LANES_MATCH(fma(a, b, -(a * b)));
    EXPECT_LANES_MATCH(a * b - c);
}

TYPED_TEST(PackTest, DoublyRoundedProductIsNotFused) {
    using T = scalar_t<TypeParam>;
    const T x = 1 + std::numeric_limits<T>::epsilon();
    const TypeParam pack(x);
    const TypeParam product = pack * pack;
    EXPECT_TRUE(all(product - pack * pack == TypeParam(0)));
    EXPECT_TRUE(all(fma(pack, pack, -product) ==
                    TypeParam(std::numeric_limits<T>::epsilon() * std::numeric_limits<T>::epsilon())));
}

TYPED_TEST(PackTest, SignsAndSelectionsKeepEveryBitOfNaN) {
    using T = scalar_t<TypeParam>;
    constexpr Bits<T> kSign = Bits<T>{1} << (8 * sizeof(T) - 1);
    const std::vector<T> values = hostile_values<T>();
    for (std::size_t start = 0; start < values.size(); ++start) {
        const TypeParam a = strided_pack<TypeParam>(values, start, 1);
        const TypeParam b = strided_pack<TypeParam>(values, start, 6);
        for (int i = 0; i < kLanesOf<TypeParam>; ++i) {
            const Bits<T> bits = bits_of(a.lane(i));
            const Bits<T> other = bits_of(b.lane(i));
            EXPECT_EQ(bits_of(abs(a).lane(i)), bits & ~kSign);
            EXPECT_EQ(bits_of((-a).lane(i)), bits ^ kSign);
            EXPECT_EQ(bits_of(copysign(a, b).lane(i)), (bits & ~kSign) | (other & kSign));
            EXPECT_EQ(bits_of(select(b < a, a, b).lane(i)), b.lane(i) < a.lane(i) ? bits : other);
        }
    }
}

TYPED_TEST(PackTest, MasksAreSetsOfLanes) {
    using M = mask_t<TypeParam>;
    constexpr int kLanes = kLanesOf<TypeParam>;
    constexpr std::uint32_t kAllBits = kAllBitsOf<TypeParam>;
    EXPECT_EQ(M(true).bits(), kAllBits);
    EXPECT_EQ(M(false).bits(), 0u);
    EXPECT_EQ(M::from_bits(0xffffffffu).bits(), kAllBits);
    for (const std::uint32_t p : mask_patterns<TypeParam>()) {
        const M a = M::from_bits(p);
        EXPECT_EQ(a.bits(), p);
        EXPECT_EQ((!a).bits(), ~p & kAllBits);
        EXPECT_EQ(any(a), p != 0);
        EXPECT_EQ(all(a), p == kAllBits);
        EXPECT_EQ(all(!!a), p == kAllBits);
        for (const std::uint32_t q : mask_patterns<TypeParam>()) {
            const M b = M::from_bits(q);
            EXPECT_EQ((a & b).bits(), p & q);
            EXPECT_EQ((a | b).bits(), p | q);
            EXPECT_EQ((a ^ b).bits(), p ^ q);
            M c = a;
            EXPECT_EQ((c &= b).bits(), p & q);
            c = a;
            EXPECT_EQ((c |= b).bits(), p | q);
        }
        for (int i = 0; i < kLanes; ++i) {
            EXPECT_EQ(a.lane(i), (p >> i & 1u) != 0);
            M c = a;
            c.set_lane(i, true);
            EXPECT_EQ(c.bits(), p | std::uint32_t{1} << i);
            c.set_lane(i, false);
            EXPECT_EQ(c.bits(), p & ~(std::uint32_t{1} << i));
        }
    }
}

TYPED_TEST(PackTest, SelectsByMask) {
    using T = scalar_t<TypeParam>;
    for (const std::uint32_t pattern : mask_patterns<TypeParam>()) {
        const auto mask = mask_t<TypeParam>::from_bits(pattern);
        const TypeParam chosen = select(mask, TypeParam(1), std::numeric_limits<T>::quiet_NaN());
        EXPECT_EQ((chosen == T(1)).bits(), pattern);
    }
}

/// The operations on one lane have the same bits as alone while all other lanes hold NaN, infinities or denormals.
TYPED_TEST(PackTest, PoisonedNeighboursDoNotLeak) {
    using T = scalar_t<TypeParam>;
    const auto chain = [](auto a, auto b, auto c) {
        const auto scaled = reciprocal_power_of_two(abs(a)) * a;
        const auto root = sqrt(max(fma(scaled, scaled, b * b), min(c, a)));
        return select(is_finite(root) & (root > b), floor(root * c) / a - b, copysign(c, a));
    };
    const T a = T(-3.7L);
    const T b = T(0.6L);
    const T c = T(11.3L);
    const T expected = chain(a, b, c);
    using Limits = std::numeric_limits<T>;
    for (const T poison : {Limits::quiet_NaN(), Limits::signaling_NaN(), Limits::infinity(),
                           -Limits::infinity(), Limits::denorm_min(), Limits::max(), T(0)}) {
        for (int lane = 0; lane < kLanesOf<TypeParam>; ++lane) {
            TypeParam pa(poison), pb(poison), pc(poison);
            pa.set_lane(lane, a);
            pb.set_lane(lane, b);
            pc.set_lane(lane, c);
            EXPECT_EQ(bits_of(chain(pa, pb, pc).lane(lane)), bits_of(expected));
        }
    }
}

TYPED_TEST(PackTest, WorksInsideVectors) {
    using T = scalar_t<TypeParam>;
    const std::vector<T> values{T(0.1L), T(-2.5L), T(1e-30L), T(7), T(-1e18L), T(0.3L), T(1e9L)};
    const auto build = [](auto x, auto y, auto z) { return nusselt::Vec3<decltype(x)>{x, y, z}; };
    const auto unit_normal = [&](auto x, auto y, auto z) {
        return normalize(cross(build(x, y, z), build(y, z, x)));
    };
    const auto accumulated = [&](auto x, auto y, auto z) {
        auto sum = build(x, y, z) * y / z;
        sum += build(y, z, x);
        sum -= build(z, x, y);
        sum *= x;
        sum /= y;
        sum *= build(z, y, x);
        return sum;
    };
    const auto a = strided_pack<TypeParam>(values, 0, 1);
    const auto b = strided_pack<TypeParam>(values, 2, 3);
    const auto c = strided_pack<TypeParam>(values, 5, 4);
    const auto expect_the_same = [&](const auto& function) {
        const auto packed = function(a, b, c);
        for (int i = 0; i < kLanesOf<TypeParam>; ++i) {
            const auto expected = function(a.lane(i), b.lane(i), c.lane(i));
            EXPECT_EQ(bits_of(packed.x.lane(i)), bits_of(expected.x));
            EXPECT_EQ(bits_of(packed.y.lane(i)), bits_of(expected.y));
            EXPECT_EQ(bits_of(packed.z.lane(i)), bits_of(expected.z));
        }
    };
    expect_the_same(unit_normal);
    expect_the_same(accumulated);
}

/// The comparison itself must find errors: in the last lane only, of one unit in the last place, in the sign of a
/// zero, in the treatment of NaN, or from a fused operation.
TYPED_TEST(PackTest, ComparisonReportsMutants) {
    using T = scalar_t<TypeParam>;
    constexpr int kLanes = kLanesOf<TypeParam>;
    const auto last_lane_wrong = [](auto a, auto b, auto) {
        auto sum = a + b;
        if constexpr (std::is_same_v<decltype(a), TypeParam>) sum.set_lane(kLanes - 1, a.lane(kLanes - 1));
        return sum;
    };
    const auto one_ulp_wrong = [](auto a, auto b, auto) {
        if constexpr (std::is_same_v<decltype(a), TypeParam>)
            return a * (T(1) / b);
        else
            return a / b;
    };
    const auto zero_sign_wrong = [](auto a, auto, auto) {
        if constexpr (std::is_same_v<decltype(a), TypeParam>)
            return T(0) - a;
        else
            return -a;
    };
    const auto operands_swapped = [](auto a, auto b, auto) {
        if constexpr (std::is_same_v<decltype(a), TypeParam>)
            return max(b, a);
        else
            return max(a, b);
    };
    const auto not_fused = [](auto a, auto b, auto c) {
        if constexpr (std::is_same_v<decltype(a), TypeParam>)
            return a * b + c;
        else
            return fma(a, b, c);
    };
    EXPECT_NE(first_difference<TypeParam>(last_lane_wrong), std::nullopt);
    EXPECT_NE(first_difference<TypeParam>(one_ulp_wrong), std::nullopt);
    EXPECT_NE(first_difference<TypeParam>(zero_sign_wrong), std::nullopt);
    EXPECT_NE(first_difference<TypeParam>(operands_swapped), std::nullopt);
    EXPECT_NE(first_difference<TypeParam>(not_fused), std::nullopt);
}

} // namespace
