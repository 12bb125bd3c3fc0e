/// All techniques for lines.

#include "input.h"

namespace nusselt::fuzz {
namespace {

template <class T>
void check_all(Input& input) {
    const LineSegment<T> light = line<T>(input);
    const T u = input.random_number<T>();
    check<hostile::LineAreaKind, T>(light, u);
    check<hostile::LineSolidAngleKind, T>(light, u);
    check<hostile::LineClippedSolidAngleKind, T>(light, u);
    check<hostile::LineProjectedSolidAngleKind, T>(light, u);
    const LtcCoefficients<T> coefficients = lobe<T>(input);
    check<hostile::LineLtcKind, T>({light, coefficients}, u);
    check<hostile::LineClippedLtcKind, T>({light, coefficients}, u);
}

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt::fuzz;
    Input input(data, size);
    if (input.byte() % 2 == 0) {
        check_all<float>(input);
    } else {
        check_all<double>(input);
    }
    return 0;
}
