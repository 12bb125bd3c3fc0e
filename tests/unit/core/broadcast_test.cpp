#include <gtest/gtest.h>

#include <nusselt/core/broadcast.h>
#include <nusselt/simd/pack.h>

namespace {

using namespace nusselt;
using detail::size_with_members;

template <class Real>
class Inner {
public:
    Inner() = default;
    explicit Inner(const Real& value) : value_(value) {}
    template <class Single>
    explicit Inner(const Inner<Single>& single) {
        broadcast_members<Real>(*this, single);
    }
    const Real& value() const { return value_; }

private:
    Real value_;

    friend struct nusselt::detail::Members;
    template <class Self, class Visit>
    static void members(Self& self, const Visit& visit) {
        visit(self.value_);
    }
};

/// Has one member of each kind that techniques have.
template <class Real>
class Outer {
public:
    Outer() = default;
    template <class Single>
    explicit Outer(const Outer<Single>& single) {
        broadcast_members<Real>(*this, single);
    }

    Real number;
    mask_t<Real> mask;
    Vec3<Real> vectors[2];
    Inner<Real> inner;

private:
    friend struct nusselt::detail::Members;
    template <class Self, class Visit>
    static void members(Self& self, const Visit& visit) {
        visit(self.number, self.mask, self.vectors, self.inner);
    }
};

TEST(BroadcastMembers, CopiesEverySortOfMemberToAllLanes) {
    Outer<float> single;
    single.number = 1;
    single.mask = true;
    single.vectors[0] = {2, 3, 4};
    single.vectors[1] = {5, 6, 7};
    single.inner = Inner<float>(8);
    const Outer<Pack<float, 4>> all(single);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(all.number.lane(i), 1);
        EXPECT_TRUE(all.mask.lane(i));
        EXPECT_EQ(all.vectors[0].y.lane(i), 3);
        EXPECT_EQ(all.vectors[1].z.lane(i), 7);
        EXPECT_EQ(all.inner.value().lane(i), 8);
    }
}

TEST(BroadcastMembers, ChangesThePrecision) {
    Outer<float> single;
    single.number = 0.5f;
    single.mask = false;
    single.vectors[0] = single.vectors[1] = {2, 3, 4};
    single.inner = Inner<float>(8);
    const Outer<double> wide(single);
    EXPECT_EQ(wide.number, 0.5);
    EXPECT_FALSE(wide.mask);
    EXPECT_EQ(wide.inner.value(), 8.0);
}

/// broadcast_members() compares the members at compile time and finds any member that is left out.
template <class Real>
void expect_each_member_to_count() {
    using Mask = mask_t<Real>;
    using Vectors = Vec3<Real>[2];
    constexpr std::size_t kSize = sizeof(Outer<Real>);
    EXPECT_EQ((size_with_members<Real, Mask, Vectors, Inner<Real>>()), kSize);
    EXPECT_NE((size_with_members<Mask, Vectors, Inner<Real>>()), kSize);
    EXPECT_NE((size_with_members<Real, Vectors, Inner<Real>>()), kSize);
    EXPECT_NE((size_with_members<Real, Mask, Inner<Real>>()), kSize);
    EXPECT_NE((size_with_members<Real, Mask, Vectors>()), kSize);
}

TEST(BroadcastMembers, ListThatLacksAMemberHasAnotherSize) {
    expect_each_member_to_count<float>();
    expect_each_member_to_count<double>();
    expect_each_member_to_count<long double>();
    expect_each_member_to_count<Pack<float, 4>>();
    expect_each_member_to_count<Pack<double, 4>>();
}

} // namespace
