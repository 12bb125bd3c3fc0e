/// All techniques for lines.

#include "input.h"

namespace nusselt::fuzz {
namespace {

template <class T>
void check_all(Input& input) {
    const LineSegment<T> light = line<T>(input);
    const T u = input.random_number<T>();
    hostile::TestedBy<FuzzSuite, hostile::LineKinds>::for_each([&]<class Kind> { check<Kind, T>(light, u); });
    const LtcCoefficients<T> coefficients = lobe<T>(input);
    hostile::LineOnLobeKinds::for_each([&]<class Kind> { check<Kind, T>({light, coefficients}, u); });
}

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt::fuzz;
    check_in_float_or_double(data, size, []<class T>(Input& input) { check_all<T>(input); });
    return 0;
}
