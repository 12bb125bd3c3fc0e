/// The rules of techniques for spheres, disks, ellipses and ellipsoids on hostile lights, for scalars and packs, and packs against
/// scalars.

#include <map>

#include <gtest/gtest.h>

#include "cones/hostile_cones.h"
#include "sampling/flush_denormals.h"

namespace nusselt_test {
namespace {

/// Collects what breaks, with the first example.
class Findings {
public:
    template <class Mask>
    void operator()(const Mask&, const std::string& text) {
        ++count_[text];
    }
    void expect_none() const {
        for (const auto& [text, count] : count_) ADD_FAILURE() << text << ": " << count << " times";
    }

private:
    std::map<std::string, int> count_;
};

template <class T>
void expect_rules(int count) {
    Findings findings;
    HostileRounds<T> lights(1);
    for (int i = 0; i < count; ++i)
        check_all_rules(lights(), [&](const auto& mask, const std::string& text) { findings(mask, text); });
    findings.expect_none();
}

TEST(HostileConeTest, ScalarsKeepTheRules) {
    expect_rules<float>(8'000);
    expect_rules<double>(2'000);
    expect_rules<long double>(500);
    const FlushDenormalsToZero flush;
    expect_rules<float>(4'000);
}

TEST(HostileConeTest, PacksKeepTheRules) {
    constexpr int kLanes = 8;
    Findings findings;
    HostileRounds<float> lights(2);
    for (int i = 0; i < 1'500; ++i) {
        HostileRound<float> each[kLanes];
        for (auto& light : each) light = lights();
        check_all_rules(in_lanes(each),
                        [&](const auto& mask, const std::string& text) { findings(mask, text); });
    }
    findings.expect_none();
}

template <template <class> class Light, class Make>
void expect_equal_lanes(const Make& make) {
    constexpr int kLanes = 8;
    using Real = nusselt::Pack<float, kLanes>;
    HostileRounds<float> lights(3);
    for (int i = 0; i < 400; ++i) {
        HostileRound<float> each[kLanes];
        for (auto& light : each) light = lights();
        const auto all = in_lanes(each);
        const nusselt::ConeProjectedSolidAngle<Real, Light> pack(make(all));
        const auto s = pack.sample(all.u);
        const auto inverse = pack.invert(s.wi);
        for (int k = 0; k < kLanes; ++k) {
            const nusselt::ConeProjectedSolidAngle<float, Light> scalar(make(each[k]));
            const auto one = scalar.sample(each[k].u);
            ASSERT_EQ(scalar.measure(), pack.measure().lane(k));
            ASSERT_EQ(one.pdf, s.pdf.lane(k));
            ASSERT_EQ(one.wi.x, s.wi.x.lane(k));
            ASSERT_EQ(one.wi.z, s.wi.z.lane(k));
            ASSERT_EQ(one.p.y, s.p.y.lane(k));
            ASSERT_EQ(scalar.invert(one.wi).x, inverse.x.lane(k));
            ASSERT_EQ(scalar.invert(one.wi).y, inverse.y.lane(k));
            // Broadcasts are the same light in all lanes.
            const nusselt::ConeProjectedSolidAngle<Real, Light> same(scalar);
            ASSERT_EQ(same.sample({Real(each[k].u.x), Real(each[k].u.y)}).wi.x.lane(kLanes - 1), one.wi.x);
        }
    }
}

TEST(HostileConeTest, LanesHaveTheBitsOfScalars) {
    expect_equal_lanes<nusselt::Disk>([](const auto& h) { return disk_of(h); });
    expect_equal_lanes<nusselt::Ellipsoid>([](const auto& h) { return ellipsoid_of(h); });
}

} // namespace
} // namespace nusselt_test
