/// All techniques for cylinders.

#include "input.h"

namespace nusselt::fuzz {
namespace {

template <class T>
void check_all(Input& input) {
    const LineSegment<T> axis = line<T>(input);
    const Cylinder<T> light{axis, std::fabs(input.coordinate<T>())};
    const T x = input.random_number<T>();
    const Vec2<T> u{x, input.random_number<T>()};
    hostile::TestedBy<FuzzSuite, hostile::CylinderKinds>::for_each(
        [&]<class Kind> { check<Kind, T>(light, u); });
    const LtcCoefficients<T> coefficients = lobe<T>(input);
    hostile::CylinderOnLobeKinds::for_each([&]<class Kind> { check<Kind, T>({light, coefficients}, u); });
}

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt::fuzz;
    check_in_float_or_double(data, size, []<class T>(Input& input) { check_all<T>(input); });
    return 0;
}
