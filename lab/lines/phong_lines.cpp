#include "lab/lines/phong_lines.h"

#include "base/stopwatch.h"
#include "lab/lines/phong_lines_kernel.h"
#include "proof/hostile/lights.h"
#include "proof/median.h"

#include <nusselt/line_samples/phong.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nusselt::lab {

namespace {

struct Case {
    PhongLines parts;
    double part_integral[kPhongLines], line_integral[kPhongLines];
};

PhongEvaluation evaluation_for(base::Isa isa) {
    return base::dispatch(isa, []<base::Isa chosen> { return phong_evaluation<chosen>(); });
}

/// The integral in long double over 16 pieces, which is far more precise than the functions under test.
double reference(const LineSegment<long double>& line, const Vec3<long double>& mirror, int exponent) {
    constexpr int kPieces = 16;
    long double sum = 0;
    for (int i = 0; i < kPieces; ++i) {
        const long double length = line.length / kPieces;
        sum += phong_integral(
            LineSegment<long double>{fma(static_cast<long double>(i) * length, line.s, line.p0), line.s,
                                     length},
            mirror, static_cast<long double>(exponent));
    }
    return static_cast<double>(sum);
}

void put(float (&columns)[3][kPhongLines], int i, const Vec3<float>& v) {
    columns[0][i] = v.x;
    columns[1][i] = v.y;
    columns[2][i] = v.z;
}

void make_case(int exponent, Case& result) {
    hostile::RandomSource random(1, static_cast<std::uint64_t>(exponent));
    for (int i = 0; i < kPhongLines; ++i) {
        const Vec3<double> begin{random.between(-2, 2), random.between(-2, 2), random.between(0.2, 2)};
        const Vec3<double> end{random.between(-2, 2), random.between(-2, 2), random.between(0.2, 2)};
        const auto at = [&](double share) { return begin + share * (end - begin); };
        const Vec3<float> mirror = normalize(broadcast<float>(at(random.uniform())));
        const double a = random.uniform();
        const double b = random.uniform();
        const LineSegment<float> part =
            make_line(broadcast<float>(at(std::min(a, b))), broadcast<float>(at(std::max(a, b))));
        put(result.parts.p0, i, part.p0);
        put(result.parts.s, i, part.s);
        put(result.parts.mirror, i, mirror);
        result.parts.length[i] = part.length;
        const LineSegment<long double> exact{broadcast<long double>(part.p0), broadcast<long double>(part.s),
                                             part.length};
        const auto whole = make_line(broadcast<long double>(begin), broadcast<long double>(end));
        const Vec3<long double> exact_mirror = broadcast<long double>(mirror);
        result.part_integral[i] = reference(exact, exact_mirror, exponent);
        result.line_integral[i] = reference(whole, exact_mirror, exponent);
    }
}

/// One method in the making.
struct Series {
    void (*run)(const PhongLines&, int exponent, float* result);
    PhongMethod* method;
    std::vector<double> nanoseconds = {};
};

void time_once(const Case& lines, int exponent, Series& series) {
    float result[kPhongLines];
    const base::Stopwatch stopwatch;
    series.run(lines.parts, exponent, result);
    series.nanoseconds.push_back(1e9 * stopwatch.seconds() / kPhongLines);
}

void judge(const Case& lines, int exponent, Series& series) {
    float result[kPhongLines];
    series.run(lines.parts, exponent, result);
    std::vector<double> errors;
    for (int i = 0; i < kPhongLines; ++i)
        errors.push_back(std::fabs(static_cast<double>(result[i]) - lines.part_integral[i]) /
                         lines.line_integral[i]);
    *series.method = {proof::median(series.nanoseconds), proof::median(errors),
                      *std::max_element(errors.begin(), errors.end())};
}

} // namespace

PhongLineComparison compare_phong_lines(int exponent, int repetitions, base::Isa isa) {
    const PhongEvaluation evaluation = evaluation_for(isa);
    static Case lines;
    make_case(exponent, lines);
    evaluation.tabulate(exponent);

    PhongLineComparison comparison;
    comparison.lanes = evaluation.lanes;
    Series series[] = {{evaluation.packed_quadrature, &comparison.packed_quadrature},
                       {evaluation.quadrature, &comparison.quadrature},
                       {evaluation.table, &comparison.table},
                       {evaluation.recursion, &comparison.recursion}};
    for (int k = 0; k < repetitions; ++k)
        for (Series& s : series) time_once(lines, exponent, s);
    for (Series& s : series) judge(lines, exponent, s);
    return comparison;
}

} // namespace nusselt::lab
