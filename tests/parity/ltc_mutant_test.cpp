// The parity tests must reject a wrong technique for linearly transformed cosines.

#include "lab/parity/technique_parity.h"
#include "mutant.h"
#include "platform_test.h"

namespace nusselt::parity {

namespace {

class LtcMutant : public PlatformTest {
protected:
    /// \tparam Clipped, Unclipped kinds of techniques, of which the second one poses as the first one.
    /// \param untouched a class of lights above the horizon, which need no clipping.
    template <class Clipped, class Unclipped>
    void expect_that_clipping_is_missed(const std::string& untouched) const {
        const auto wrong = wherever_it_runs(shader_of<TechniquePair<Unclipped>>(Variant::split).shader);
        for (const auto& [variant, excesses] :
             excesses_of_each(wrong, judge_twins<TechniquePair<Clipped>>(platform(), wrong, kMutantLights))) {
            SCOPED_TRACE(name_of(variant));
            const auto count_of = [&](const std::string& begin) {
                return std::count_if(excesses.begin(), excesses.end(),
                                     [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
            };
            EXPECT_GT(count_of("crossing the horizon:"), 0);
            EXPECT_EQ(count_of(untouched), 0) << "lights above the horizon need no clipping";
        }
    }
};

TEST_F(LtcMutant, MissingClippingIsFound) {
    expect_that_clipping_is_missed<hostile::PolygonClippedLtcKindOf<4>, hostile::PolygonLtcKindOf<4>>(
        "decentral:");
}

TEST_F(LtcMutant, MissingClippingOfEllipsoidsIsFound) {
    expect_that_clipping_is_missed<hostile::EllipsoidClippedLtcKind, hostile::EllipsoidLtcKind>("above:");
}

} // namespace

} // namespace nusselt::parity
