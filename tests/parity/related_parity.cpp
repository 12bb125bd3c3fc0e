#include "related_parity.h"

#include "lab/parity/technique_parity.h"
#include "proof/tube_lights.h"
#include "related_twins.h"

#include <set>
#include <stdexcept>

namespace nusselt::parity {

namespace {

/// The published method that a technique replaces. Its twin has no invert(). The one for PolygonProjectedSolidAngle
/// follows chains of edges in C++ but sorts in GLSL. The order of sums may differ, so only errors can be compared.
template <class AnyKind>
struct ReplacedPair {
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

template <class Pair>
VariantShader related_shader(Variant variant) {
    return {find_twin(kRelatedTwinShaders, Pair::kName, Pair::Traits::kVertexBound), variant};
}

template <class Pair>
std::vector<VariantVerdict> judge_ordinary_lights(const ShaderPlatform& platform,
                                                  const ParityEffort& effort) {
    std::set<std::string> ordinary{"decentral", "central", "ordinary"};
    for (const proof::TubeLight& tube : proof::tube_lights()) ordinary.insert(tube.name);
    const auto is_judged = [&](const auto& lights) { return ordinary.count(lights.name) > 0; };
    const std::vector<Variant> variants = platform.variants();
    std::vector<VariantShader> shaders;
    for (const Variant variant : variants) shaders.push_back(related_shader<Pair>(variant));
    const auto verdicts = judge_twins<Pair>(platform, shaders, effort.lights / 10, is_judged);
    std::vector<VariantVerdict> results;
    for (std::size_t k = 0; k < variants.size(); ++k) results.push_back({variants[k], verdicts[k]});
    return results;
}

template <class Pair>
ParityCase case_of() {
    return {"published method", name_of_pair<Pair>(), judge_ordinary_lights<Pair>};
}

} // namespace

std::vector<ParityCase> related_cases() {
    std::vector<ParityCase> cases;
    using Kinds = hostile::Join<hostile::PolygonKinds<4>, hostile::LineKinds, hostile::CylinderKinds,
                                hostile::RoundKinds>;
    Kinds().for_each([&]<class Kind> {
        if constexpr (!std::is_same_v<typename Kind::template Published<float>, hostile::Absent>)
            cases.push_back(case_of<ReplacedPair<Kind>>());
        if constexpr (Kind::kIsRelated && !hostile::kIsExempt<Kind, ParitySuite>)
            cases.push_back(case_of<TechniquePair<Kind>>());
    });
    return cases;
}

} // namespace nusselt::parity
