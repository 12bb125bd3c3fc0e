// Parity for the remaining bounds on the number of vertices, each of which has its own sorting network, and for loops
// that are not marked with [[unroll]]. These cases take fewer lights.

#include "lab/parity/parity.h"
#include "lab/parity/technique_parity.h"

namespace nusselt::parity {

namespace {

/// Adds what breaks the contract to the excesses.
template <class Pair>
void add_contract(const ShaderPlatform& platform, const ParityEffort& effort, VariantVerdict& result) {
    const auto shader = shader_of<Pair>(result.variant);
    const std::string violation = first_violation<Pair>(platform, shader, effort.hostile_lights() / 10);
    if (!violation.empty()) result.verdict.excesses.push_back(violation);
}

/// Judges lights that use all vertex slots, and lights that are clipped.
template <class Pair>
std::vector<VariantVerdict> judge_bound(const ShaderPlatform& platform, const ParityEffort& effort) {
    constexpr int kBound = Pair::Traits::kVertexBound;
    const auto is_judged = [](const proof::PolygonClass& lights) {
        return lights.vertex_count == kBound ||
               (kBound > 4 && lights.name == std::string_view("crossing the horizon"));
    };
    const auto& classes = proof::polygon_classes();
    const auto judged = std::count_if(classes.begin(), classes.end(), is_judged);
    const int count = effort.lights_per_class() * static_cast<int>(judged);
    const std::vector<Variant> variants = platform.variants();
    const auto verdicts = judge_twins<Pair>(platform, shaders_of<Pair>(variants), count, is_judged);
    std::vector<VariantVerdict> results;
    for (std::size_t k = 0; k < variants.size(); ++k)
        add_contract<Pair>(platform, effort, results.emplace_back(VariantVerdict{variants[k], verdicts[k]}));
    return results;
}

template <class Pair>
std::vector<VariantVerdict> judge_rolled(const ShaderPlatform& platform, const ParityEffort& effort) {
    const auto shader = shader_of<Pair>(Variant::rolled);
    VariantVerdict result{Variant::rolled, judge_twin<Pair>(platform, shader, effort.lights / 2)};
    add_contract<Pair>(platform, effort, result);
    return {result};
}

} // namespace

void add_vertex_bound_cases(std::vector<ParityCase>& cases) {
    const auto add = [&]<class Kind> {
        using Pair = TechniquePair<Kind>;
        cases.push_back({"vertex bound", name_of_pair<Pair>(), judge_bound<Pair>});
    };
    using Kinds = hostile::TestedBy<ParitySuite, hostile::PolygonKinds<3>, hostile::PolygonKinds<5>,
                                    hostile::PolygonKinds<6>, hostile::PolygonKinds<7>>;
    Kinds().for_each(add);
    using Small = TechniquePair<hostile::PolygonProjectedSolidAngleKindOf<4>>;
    using Large = TechniquePair<hostile::PolygonProjectedSolidAngleKindOf<8>>;
    cases.push_back({"rolled loops", name_of_pair<Small>(), judge_rolled<Small>});
    cases.push_back({"rolled loops", name_of_pair<Large>(), judge_rolled<Large>});
}

} // namespace nusselt::parity
