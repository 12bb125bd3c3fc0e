#include "lab/parity/parity.h"
#include "lab/parity/technique_parity.h"

namespace nusselt::parity {

namespace {

template <class Pair>
std::vector<VariantVerdict> judge_technique(const ShaderPlatform& platform, const ParityEffort& effort) {
    // Polygons are judged for two bounds on the number of vertices.
    const int count = hostile::kIsPolygon<typename Pair::Kind> ? effort.lights / 2 : effort.lights;
    const std::vector<Variant> variants = platform.variants();
    const auto verdicts = judge_twins<Pair>(platform, shaders_of<Pair>(variants), count);
    std::vector<VariantVerdict> results;
    for (std::size_t k = 0; k < variants.size(); ++k) results.push_back({variants[k], verdicts[k]});
    return results;
}

template <class Pair>
std::vector<VariantVerdict> judge_contract(const ShaderPlatform& platform, const ParityEffort& effort) {
    std::vector<VariantVerdict> results;
    for (const Variant variant : platform.variants()) {
        Verdict& verdict = results.emplace_back(VariantVerdict{variant, {}}).verdict;
        verdict.lights = effort.hostile_lights();
        const auto violation =
            first_violation<Pair>(platform, shader_of<Pair>(variant), effort.hostile_lights());
        if (!violation.empty()) verdict.excesses.push_back(violation);
    }
    return results;
}

} // namespace

void add_technique_cases(std::vector<ParityCase>& cases) {
    using Kinds = hostile::TestedBy<ParitySuite, hostile::KindsWithBounds<4, 8>>;
    Kinds().for_each([&]<class Kind> {
        if constexpr (!Kind::kIsRelated) {
            using Pair = TechniquePair<Kind>;
            cases.push_back({"technique", name_of_pair<Pair>(), judge_technique<Pair>});
            cases.push_back({"hostile lights", name_of_pair<Pair>(), judge_contract<Pair>});
        }
    });
}

} // namespace nusselt::parity
