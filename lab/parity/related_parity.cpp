// Parity of published methods, on lights for which they are made. On other lights, their errors are arbitrary in C++,
// too.

#include "lab/parity/parity.h"
#include "lab/parity/technique_parity.h"

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

template <class Pair>
std::vector<VariantVerdict> judge_ordinary_lights(const gpu::Device& device, const ParityEffort& effort) {
    const std::set<std::string> ordinary{"decentral", "central", "ordinary"};
    const auto is_judged = [&](const auto& lights) { return ordinary.count(lights.name) > 0; };
    const std::vector<Variant> variants = variants_for(device);
    const auto verdicts =
        judge_twins<Pair>(device, shaders_of<Pair>(variants), effort.lights / 10, is_judged);
    std::vector<VariantVerdict> results;
    for (std::size_t k = 0; k < variants.size(); ++k) results.push_back({variants[k], verdicts[k]});
    return results;
}

} // namespace

void add_related_cases(std::vector<ParityCase>& cases) {
    using Kinds = hostile::Join<hostile::PolygonKinds<4>, hostile::LineKinds>;
    Kinds().for_each([&]<class Kind> {
        if constexpr (!std::is_same_v<typename Kind::template Published<float>, hostile::Absent>)
            cases.push_back({"published method", name_of_pair<RelatedPair<Kind>>(),
                             judge_ordinary_lights<RelatedPair<Kind>>});
    });
}

} // namespace nusselt::parity
