// Parity of published methods, on lights for which they are made. On other lights, their errors are arbitrary in C++,
// too.

#include "technique_parity.h"

#include <set>

namespace nusselt::parity {

namespace {

/// The published method that a technique replaces. Its twin has no invert(). The one for PolygonProjectedSolidAngle
/// follows chains of edges in C++ but sorts in GLSL. The order of sums may differ, so only errors can be compared.
template <class AnyKind>
struct RelatedPair {
    using Kind = AnyKind;
    using Traits = proof::Judged<Kind>;
    static constexpr const char* kName = Kind::kPublishedName;
    static constexpr Images kImages = Images::same;
    using Outputs = typename Twin<Traits>::Outputs;

    static Outputs outputs_of(const typename Twin<Traits>::Input& in) {
        const typename Traits::template Plain<float> technique(in.light);
        const LightSample<float> sample = technique.sample(in.u);
        return {sample, sample.pdf, {}, technique.measure()};
    }
    static void judge(const proof::Case<Traits, float>& c, bool dark, const Outputs& out, Errors& errors) {
        judge_sample(c, dark, out.sample, out.measure, errors);
    }
};

/// The pairs of all techniques that replace a published method.
template <class... Kinds>
auto related_pairs(hostile::KindList<Kinds...>) {
    const auto list = []<class Kind>(const Kind*) {
        using Published = typename Kind::template Published<float>;
        if constexpr (std::is_same_v<Published, hostile::Absent>)
            return hostile::KindList<>();
        else
            return hostile::KindList<RelatedPair<Kind>>();
    };
    return hostile::Join<decltype(list(static_cast<const Kinds*>(nullptr)))...>();
}
template <class... Pairs>
testing::Types<Pairs...> types_of(hostile::KindList<Pairs...>);

template <class Pair>
class RelatedParity : public GpuTest {};
using Techniques =
    decltype(types_of(related_pairs(hostile::Join<hostile::PolygonKinds<4>, hostile::LineKinds>())));
TYPED_TEST_SUITE(RelatedParity, Techniques, PairNames);

TYPED_TEST(RelatedParity, IsAsAccurateAsCppOnOrdinaryLights) {
    const std::set<std::string> ordinary{"decentral", "central", "ordinary"};
    const int count = random_lights() / 10;
    const auto is_judged = [&](const auto& lights) { return ordinary.count(lights.name) > 0; };
    const auto shaders = shaders_for<TypeParam>(this->device());
    for (const Verdict& verdict : judge_twins<TypeParam>(this->device(), shaders, count, is_judged)) {
        EXPECT_GE(verdict.lights, count);
        expect_parity(verdict);
    }
}

} // namespace

} // namespace nusselt::parity
