/// All techniques for polygons.

#include "input.h"

namespace nusselt::fuzz {
namespace {

template <int N, class T>
void check_all(Input& input) {
    const ConvexPolygon<T, N> light = polygon<N, T>(input);
    const T x = input.random_number<T>();
    const Vec2<T> u{x, input.random_number<T>()};
    hostile::TestedBy<FuzzSuite, hostile::PolygonKinds<N>>::for_each(
        [&]<class Kind> { check<Kind, T>(light, u); });
    if constexpr (N == 4)
        hostile::RectangleKinds::for_each([&]<class Kind> { check<Kind, T>(Kind::from(light), u); });
    const LtcCoefficients<T> coefficients = lobe<T>(input);
    hostile::PolygonOnLobeKinds<N>::for_each([&]<class Kind> {
        // Some have a smaller bound on the number of vertices.
        if constexpr (Kind::kVertices == N) check<Kind, T>({light, coefficients}, u);
    });
}

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt::fuzz;
    Input input(data, size);
    switch (input.byte() % 3) {
    case 0:
        check_all<4, float>(input);
        break;
    case 1:
        check_all<4, double>(input);
        break;
    default:
        check_all<8, float>(input);
    }
    return 0;
}
