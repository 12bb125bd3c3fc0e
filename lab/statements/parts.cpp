#include "lab/statements/measurements.h"
#include "lab/timing/scalar/lights.h"

#include <nusselt/core/trig.h>
#include <nusselt/related/bitonic_network.h>
#include <nusselt/related/polygon_solid_angle_arvo.h>
#include <nusselt/sampling/polygon_solid_angle.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace nusselt::lab {

namespace {

/// The most vertices of a polygon with eight after clipping.
constexpr int kMostSorted = 9;

template <int M>
bool sorts(std::array<int, M> values) {
    sort_bitonic<M>([&](int low, int high) {
        int &a = values[static_cast<std::size_t>(low)], &b = values[static_cast<std::size_t>(high)];
        if (b < a) std::swap(a, b);
    });
    return std::is_sorted(values.begin(), values.end());
}

/// Calls visit(permutation) for all rotations of permutations of 0 to M - 1 that rise and then fall.
template <int M, class Visit>
void for_each_bitonic(const Visit& visit) {
    for (unsigned rising = 0; rising < 1u << (M - 1); ++rising) {
        std::array<int, M> values{};
        auto front = values.begin();
        auto back = values.end();
        for (int i = 0; i < M; ++i) {
            if (rising >> i & 1)
                *front++ = i;
            else
                *--back = i;
        }
        for (int i = 0; i < M; ++i) {
            visit(values);
            std::rotate(values.begin(), values.begin() + 1, values.end());
        }
    }
}

struct Sorting {
    int bitonic = 0, unsorted = 0; ///< numbers of sequences that rise and fall
    int most_vertices = 0;         ///< up to which all of these are sorted
};

template <int M>
void count_sorted(Sorting& sorting) {
    int unsorted = 0;
    for_each_bitonic<M>([&](const std::array<int, M>& values) {
        ++sorting.bitonic;
        unsorted += !sorts<M>(values);
    });
    sorting.unsorted += unsorted;
    if (unsorted == 0) sorting.most_vertices = M;
}

template <int... Offsets>
Sorting sorting_up_to_most(std::integer_sequence<int, Offsets...>) {
    Sorting sorting;
    (count_sorted<3 + Offsets>(sorting), ...);
    return sorting;
}

/// Of all permutations.
int unsorted_permutations_of_six() {
    std::array<int, 6> values{};
    std::iota(values.begin(), values.end(), 0);
    int unsorted = 0;
    do {
        unsorted += !sorts<6>(values);
    } while (std::next_permutation(values.begin(), values.end()));
    return unsorted;
}

/// Whether the azimuths of the vertices, in their order, rise and fall once. The zenith is outside.
bool has_bitonic_azimuths(const std::array<Vec3<double>, kMostCorners>& corners, int count) {
    Vec3<double> middle{0, 0, 0};
    for (int j = 0; j < count; ++j) middle = middle + corners[static_cast<std::size_t>(j)];
    const auto azimuth = [&](int j) {
        const Vec3<double>& v = corners[static_cast<std::size_t>(j % count)];
        return std::atan2(middle.x * v.y - middle.y * v.x, middle.x * v.x + middle.y * v.y);
    };
    int peaks = 0;
    for (int j = 0; j < count; ++j) peaks += azimuth(j) < azimuth(j + 1) && azimuth(j + 1) > azimuth(j + 2);
    return peaks == 1;
}

int polygons_without_bitonic_azimuths(int count) {
    std::mt19937 generator(1);
    int found = 0;
    for (int i = 0; i < count; ++i) {
        const int vertices = 3 + i % (kMostCorners - 2);
        found += !has_bitonic_azimuths(random_light(kDecentral, vertices, generator), vertices);
    }
    return found;
}

template <class Real>
double arctangent_error(int steps) {
    double largest = 0;
    for (int i = 0; i <= steps; ++i) {
        const long double angle = kPi<long double> * i / steps;
        const auto y = static_cast<Real>(std::sin(angle)), x = static_cast<Real>(std::cos(angle));
        const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        // The sine of pi is a rounding error of any sign.
        if (y < 0) continue;
        largest = std::max(largest, static_cast<double>(std::fabs(atan2_positive_fast(y, x) - exact)));
    }
    return largest;
}

/// Largest distance between the directions of both techniques for the same random numbers.
/// \param first of the vertices for Arvo's method.
template <int N>
double map_difference(int lights, int first) {
    std::mt19937 generator(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    double largest = 0;
    for (int i = 0; i < lights; ++i) {
        auto corners = random_light(i % 2 == 0 ? kDecentral : kCentral, N, generator);
        const PolygonSolidAngle<double, N> ours(make_polygon<N>(corners.data(), N));
        std::rotate(corners.begin(), corners.begin() + first, corners.begin() + N);
        const PolygonSolidAngleArvo<double, N> arvo(make_polygon<N>(corners.data(), N));
        for (int k = 0; k < 16; ++k) {
            const double x = uniform(generator);
            const Vec2<double> u{x, uniform(generator)};
            largest = std::max(largest, length(ours.sample(u).wi - arvo.direction(u)));
        }
    }
    return largest;
}

} // namespace

Findings measure_parts(Effort effort) {
    const int scale = effort == Effort::quick ? 1 : 10;
    const char* const kSorting = "polygons-sec-3.7-sorting";
    const Sorting sorting = sorting_up_to_most(std::make_integer_sequence<int, kMostSorted - 2>());
    Finding most =
        at_least(kSorting, "most vertices for which networks sort all sequences that rise and fall",
                 sorting.most_vertices, 8);
    most.published = "largest number of vertices";
    const int polygons = 10'000 * scale;

    const char* const kArctangent = "polygons-sec-6.4-arctangent";
    Finding arctangent = at_most(kArctangent, "largest error of our polynomial [rad]",
                                 arctangent_error<double>(100'000 * scale), 1.3e-5);
    arctangent.published = "largest error of the arctangent";

    const char* const kMap = "polygons-sec-5-same-map";
    const int lights = 1000 * scale;
    const std::string distance = "largest distance between directions of both for the same random numbers, ";
    return {
        {most,
         at_most(kSorting,
                 fmt::format("unsorted ones of {} such sequences of 3 to {} numbers", sorting.bitonic,
                             kMostSorted),
                 sorting.unsorted, 0),
         at_least(kSorting, "unsorted ones of all 720 permutations of six numbers",
                  unsorted_permutations_of_six(), 1),
         at_most(
             kSorting,
             fmt::format("polygons whose azimuths are no such sequence, of {} random convex ones", polygons),
             polygons_without_bitonic_azimuths(polygons), 0),
         arctangent,
         at_most(kArctangent, "the same in float [rad]", arctangent_error<float>(100'000 * scale), 1.3e-5),
         at_most(kMap, distance + fmt::format("{} triangles", lights), map_difference<3>(lights, 0), 1e-6),
         at_most(kMap, distance + fmt::format("{} quads", lights), map_difference<4>(lights, 0), 1e-6),
         at_most(kMap, distance + fmt::format("{} pentagons", lights), map_difference<5>(lights, 0), 1e-6),
         at_least(kMap, "the same if Arvo's method begins at the next vertex of quads",
                  map_difference<4>(lights, 1), 0.1)}};
}

} // namespace nusselt::lab
