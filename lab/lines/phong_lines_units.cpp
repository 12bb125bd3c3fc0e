/// Compiled once per instruction set; see phong_lines_kernel.h.

#include "lab/lines/phong_lines_kernel.h"

#include <nusselt/line_samples/phong.h>
#include <nusselt/related/phong_line_billen.h>
#include <nusselt/simd/pack.h>

NUSSELT_NAMESPACE_BEGIN
namespace phong_lines {

using lab::kPhongLines;
using lab::PhongLines;

#if defined(__AVX512F__)
inline constexpr int kLanes = 16;
#elif defined(__AVX2__)
inline constexpr int kLanes = 8;
#else
inline constexpr int kLanes = 4;
#endif
using Lanes = Pack<float, kLanes>;
using Table = CosinePowerTable<float>;

inline Vec3<float> vector_at(const float (&v)[3][kPhongLines], int i) { return {v[0][i], v[1][i], v[2][i]}; }
inline Vec3<Lanes> vectors_at(const float (&v)[3][kPhongLines], int i) {
    return {Lanes::load(v[0] + i), Lanes::load(v[1] + i), Lanes::load(v[2] + i)};
}
inline LineSegment<float> line_at(const PhongLines& lines, int i) {
    return {vector_at(lines.p0, i), vector_at(lines.s, i), lines.length[i]};
}

inline void packed_quadrature(const PhongLines& lines, int exponent, float* result) {
    for (int i = 0; i < kPhongLines; i += kLanes)
        phong_integral(LineSegment<Lanes>{vectors_at(lines.p0, i), vectors_at(lines.s, i),
                                          Lanes::load(lines.length + i)},
                       vectors_at(lines.mirror, i), Lanes(static_cast<float>(exponent)))
            .store(result + i);
}

inline void quadrature(const PhongLines& lines, int exponent, float* result) {
    for (int i = 0; i < kPhongLines; ++i)
        result[i] =
            phong_integral(line_at(lines, i), vector_at(lines.mirror, i), static_cast<float>(exponent));
}

template <class CosinePower>
void published(const PhongLines& lines, int exponent, const CosinePower& power, float* result) {
    for (int i = 0; i < kPhongLines; ++i)
        result[i] = phong_integral_billen(line_at(lines, i), vector_at(lines.mirror, i), exponent, power);
}

inline void recursion(const PhongLines& lines, int exponent, float* result) {
    published(lines, exponent, CosinePowerRecursion<float>(exponent + 2), result);
}

inline Table& current_table() {
    static Table table(0);
    return table;
}
inline void tabulate(int exponent) { current_table() = Table(exponent + 2); }
inline void table(const PhongLines& lines, int exponent, float* result) {
    published(lines, exponent, current_table(), result);
}

} // namespace phong_lines
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

template <>
PhongEvaluation phong_evaluation<base::Isa::NUSSELT_UNIT_ISA>() {
    using namespace phong_lines;
    return {kLanes, packed_quadrature, quadrature, recursion, tabulate, table};
}

} // namespace nusselt::lab
