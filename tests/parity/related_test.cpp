// Published methods, on lights that they are made for. On others they err arbitrarily in C++, too.

#include "technique_parity.h"

#include <set>

namespace nusselt::parity {

namespace {

/// A competitor of the technique that the traits describe. Its twin has no invert().
template <class AnyTraits>
struct RelatedPair {
    using Traits = AnyTraits;
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

// Named types, for the names of tests.
struct PolygonSolidAnglePeters : RelatedPair<proof::PolygonSolidAngleTraits<4>> {
    static constexpr const char* kName = "PolygonSolidAnglePeters";
};
/// The one in C++ follows chains of edges where the twin sorts: they may take sums in different order, so that only
/// errors can be compared.
struct PolygonProjectedSolidAnglePeters : RelatedPair<proof::PolygonProjectedSolidAngleTraits<4>> {
    static constexpr const char* kName = "PolygonProjectedSolidAnglePeters";
};
struct LineProjectedSolidAnglePeters : RelatedPair<proof::LineProjectedSolidAngleTraits> {
    static constexpr const char* kName = "LineProjectedSolidAnglePeters";
};

template <class Pair>
class RelatedParity : public GpuTest {};
using Techniques =
    testing::Types<PolygonSolidAnglePeters, PolygonProjectedSolidAnglePeters, LineProjectedSolidAnglePeters>;
TYPED_TEST_SUITE(RelatedParity, Techniques);

TYPED_TEST(RelatedParity, IsAsAccurateAsCppOnOrdinaryLights) {
    const std::set<std::string> ordinary{"decentral", "central", "ordinary"};
    const int count = random_lights() / 10;
    for (const Variant variant : variants_for(this->device())) {
        const Verdict verdict =
            judge_twin<TypeParam>(this->device(), shader_of<TypeParam>(variant), count,
                                  [&](const auto& lights) { return ordinary.count(lights.name) > 0; });
        EXPECT_GE(verdict.lights, count);
        expect_parity(verdict);
    }
}

} // namespace

} // namespace nusselt::parity
