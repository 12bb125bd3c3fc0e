// Parity for the remaining bounds on the number of vertices, each of which has its own sorting network, and for loops
// that are not marked with [[unroll]]. These tests use fewer lights.

#include "technique_parity.h"

namespace nusselt::parity {

namespace {

/// As many as for each class with a bound of four.
int lights_per_class() { return nusselt_test::at_effort(3'300, 33'000); }

template <class Pair>
class VertexBounds : public GpuTest {};
using Techniques = PairsOf<hostile::PolygonKinds<3>, hostile::PolygonKinds<5>, hostile::PolygonKinds<6>,
                           hostile::PolygonKinds<7>>;
TYPED_TEST_SUITE(VertexBounds, Techniques, PairNames);

/// Judges lights that use all vertex slots, and lights that are clipped.
TYPED_TEST(VertexBounds, IsAsAccurateAsCpp) {
    constexpr int kBound = TypeParam::Traits::kVertexBound;
    const auto is_judged = [](const proof::PolygonClass& lights) {
        return lights.vertex_count == kBound ||
               (kBound > 4 && lights.name == std::string_view("crossing the horizon"));
    };
    const auto& classes = proof::polygon_classes();
    const auto judged = std::count_if(classes.begin(), classes.end(), is_judged);
    const int count = lights_per_class() * static_cast<int>(judged);
    const auto shaders = shaders_for<TypeParam>(this->device());
    for (const Verdict& verdict : judge_twins<TypeParam>(this->device(), shaders, count, is_judged))
        expect_parity(verdict);
    for (const auto shader : shaders)
        EXPECT_EQ(first_violation<TypeParam>(this->device(), shader, hostile_lights() / 10), "");
}

class RolledLoops : public GpuTest {};

TEST_F(RolledLoops, AreAsAccurateAsCpp) {
    const auto judge = [&](auto pair) {
        using Pair = decltype(pair);
        const auto shader = shader_of<Pair>(Variant::rolled);
        expect_parity(judge_twin<Pair>(device(), shader, random_lights_of<Pair>()));
        EXPECT_EQ(first_violation<Pair>(device(), shader, hostile_lights() / 10), "");
    };
    judge(TechniquePair<hostile::PolygonProjectedSolidAngleKindOf<4>>());
    judge(TechniquePair<hostile::PolygonProjectedSolidAngleKindOf<8>>());
}

} // namespace

} // namespace nusselt::parity
