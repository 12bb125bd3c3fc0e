// The remaining bounds on the number of vertices, each of which has a sorting network of its own, and loops that are
// not unrolled: with fewer lights.

#include "technique_parity.h"

namespace nusselt::parity {

namespace {

// Named types, for the names of tests.
struct PolygonArea {
    template <int N>
    using Pair = PolygonAreaPair<N>;
};
struct PolygonSolidAngle {
    template <int N>
    using Pair = PolygonSolidAnglePair<N>;
};
struct PolygonClippedSolidAngle {
    template <int N>
    using Pair = PolygonClippedSolidAnglePair<N>;
};
struct PolygonProjectedSolidAngle {
    template <int N>
    using Pair = PolygonProjectedSolidAnglePair<N>;
};
struct PolygonProjectedSolidAngleBiased {
    template <int N>
    using Pair = PolygonProjectedSolidAngleBiasedPair<N>;
};

/// As many as of each class with a bound of four.
int lights_per_class() { return nusselt_test::at_effort(3'300, 33'000); }

template <class Technique>
class VertexBounds : public GpuTest {
protected:
    /// Lights that fill all slots, and lights that are clipped.
    template <int N>
    void judge_bound() const {
        using Pair = typename Technique::template Pair<N>;
        for (const Variant variant : variants_for(device())) {
            const auto shader = shader_of<Pair>(variant);
            const auto is_judged = [](const proof::PolygonClass& lights) {
                return lights.vertex_count == N ||
                       (N > 4 && lights.name == std::string_view("crossing the horizon"));
            };
            const auto& classes = proof::polygon_classes();
            const auto judged = std::count_if(classes.begin(), classes.end(), is_judged);
            expect_parity(
                judge_twin<Pair>(device(), shader, lights_per_class() * static_cast<int>(judged), is_judged));
            EXPECT_EQ(first_violation<Pair>(device(), shader, hostile_lights() / 10), "");
        }
    }
};
using Techniques = testing::Types<PolygonArea, PolygonSolidAngle, PolygonClippedSolidAngle,
                                  PolygonProjectedSolidAngle, PolygonProjectedSolidAngleBiased>;
TYPED_TEST_SUITE(VertexBounds, Techniques);

TYPED_TEST(VertexBounds, OfThreeIsAsAccurateAsCpp) { this->template judge_bound<3>(); }
TYPED_TEST(VertexBounds, OfFiveIsAsAccurateAsCpp) { this->template judge_bound<5>(); }
TYPED_TEST(VertexBounds, OfSixIsAsAccurateAsCpp) { this->template judge_bound<6>(); }
TYPED_TEST(VertexBounds, OfSevenIsAsAccurateAsCpp) { this->template judge_bound<7>(); }

class RolledLoops : public GpuTest {};

TEST_F(RolledLoops, AreAsAccurateAsCpp) {
    const auto judge = [&](auto pair) {
        using Pair = decltype(pair);
        const auto shader = shader_of<Pair>(Variant::rolled);
        expect_parity(judge_twin<Pair>(device(), shader, random_lights_of<Pair>()));
        EXPECT_EQ(first_violation<Pair>(device(), shader, hostile_lights() / 10), "");
    };
    judge(PolygonProjectedSolidAnglePair<4>());
    judge(PolygonProjectedSolidAnglePair<8>());
}

} // namespace

} // namespace nusselt::parity
