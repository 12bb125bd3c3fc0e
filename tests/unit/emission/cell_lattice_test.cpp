/// Tests of the lattice of closed forms against Lambert's formula for each cell alone.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "emission/textured_lights.h"
#include "ltc/lobes.h"

namespace nusselt_test {
namespace {

using nusselt::CellLattice;
using nusselt::Ltc;
using nusselt::NearestFilter;
using nusselt::Vec2;
template <class T>
using Plane = nusselt::TexturePlane<T>;

const SquareTexture<double>& white() {
    static const SquareTexture<double> texture(16, [](int, int) { return 1; });
    return texture;
}

template <class T, int n>
std::vector<T> angles_of(const Plane<T>& plane, const nusselt::TexturedLight<T, n>& light) {
    std::vector<T> result(n * n);
    CellLattice<T, n>(plane, light).find_angles(result.data());
    return result;
}

template <int n>
long double reference(const Plane<double>& plane, const nusselt::TexturedLight<double, n>& light, int cell) {
    const double x = cell % n, y = cell / n;
    const auto part = light.outline.part_in({x / n, y / n}, {(x + 1) / n, (y + 1) / n});
    if (part.count == 0) return 0;
    Vec2<long double> corners[12];
    for (int k = 0; k < part.count; ++k) corners[k] = nusselt::broadcast<long double>(part.corner[k]);
    return projected_solid_angle(nusselt::polygon_in<12>(converted<long double>(plane), corners, part.count));
}

/// Planes at the distance of their size, most of them cut by the horizon, with sides that are not perpendicular.
std::vector<Plane<double>> close_planes() {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::vector<Plane<double>> planes;
    for (int k = 0; k < 20; ++k) {
        double c[9];
        for (double& x : c) x = normal(random);
        planes.push_back(
            nusselt::make_texture_plane<double>({c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}));
    }
    // The horizon is a line of the lattice, an edge, or parallel to one; the plane is horizontal or below.
    planes.push_back(nusselt::make_texture_plane<double>({-1, 1, -0.5}, {2, 0, 0}, {0, 0, 1}));
    planes.push_back(nusselt::make_texture_plane<double>({-1, 1, 0}, {2, 0, 0}, {0, 0, 1}));
    planes.push_back(nusselt::make_texture_plane<double>({-1, 1, -0.3}, {2, 0, 0}, {0, 0.2, 1}));
    planes.push_back(nusselt::make_texture_plane<double>({-1, 1, -0.3}, {0, 0.2, 1}, {2, 0, 0}));
    planes.push_back(nusselt::make_texture_plane<double>({-1, -1, 0.3}, {2, 0, 0}, {0, 2, 0}));
    planes.push_back(nusselt::make_texture_plane<double>({-1, -1, -0.3}, {2, 0, 0}, {0, 2, 0}));
    return planes;
}

template <int n>
void expect_lambert() {
    for (const auto& outline : outlines<double>()) {
        const StoredLight<double, n> stored(NearestFilter(), white().view(), outline);
        int lit = 0;
        for (const Plane<double>& plane : close_planes()) {
            const std::vector<double> angles = angles_of(plane, stored.light);
            for (int cell = 0; cell < n * n; ++cell) {
                if (stored.light.cover[cell] == 0) continue;
                const long double expected = reference(plane, stored.light, cell);
                ASSERT_NEAR(angles[static_cast<std::size_t>(cell)], expected, 2e-13 + 1e-11 * expected)
                    << cell;
                lit += expected > 0;
            }
        }
        EXPECT_GT(lit, 100);
    }
}

TEST(CellLattice, IsLambertsFormulaForEachCell) {
    expect_lambert<8>();
    expect_lambert<16>();
}

TEST(CellLattice, HoldsInTheCosineSpaceOfLobes) {
    const StoredLight<double, 8> stored(NearestFilter(), white().view(), unit_square<double>());
    for (const NamedLobe& lobe : wide_lobes()) {
        nusselt::LtcCoefficients<double> c{};
        c.m00 = static_cast<double>(lobe.coefficients.m00);
        c.m02 = static_cast<double>(lobe.coefficients.m02);
        c.m11 = static_cast<double>(lobe.coefficients.m11);
        c.m20 = static_cast<double>(lobe.coefficients.m20);
        c.m22 = static_cast<double>(lobe.coefficients.m22);
        const nusselt::LobeCells<double> measure{Ltc<double>(c)};
        for (const Plane<double>& plane : close_planes()) {
            const std::vector<double> angles = angles_of(measure.image_of(plane), stored.light);
            for (int cell = 0; cell < 64; ++cell) {
                const Vec2<double> low{cell % 8 / 8.0, cell / 8 / 8.0};
                const auto light = rectangle_in(plane, low, {low.x + 0.125, low.y + 0.125});
                const double expected = projected_solid_angle(to_cosine_space(light, measure.ltc));
                ASSERT_NEAR(angles[static_cast<std::size_t>(cell)], expected, 1e-12 + 1e-9 * expected)
                    << lobe.name;
            }
        }
    }
}

/// Relative errors of float for lights of size 1, whose cells are small and far: the budgets are three times what was found.
TEST(CellLattice, KeepsDigitsAtAllDistances) {
    const StoredLight<double, 16> stored(NearestFilter(), white().view(), unit_square<double>());
    const SquareTexture<float> texture(16, [](int, int) { return 1; });
    const StoredLight<float, 16> single(NearestFilter(), texture.view(), unit_square<float>());
    struct Budget {
        double distance, rms;
    };
    for (const Budget& budget :
         {Budget{0.5, 1e-5}, {2.1, 6e-5}, {3, 4e-5}, {30, 3e-6}, {300, 3e-6}, {1e5, 3e-6}}) {
        double squares = 0;
        int count = 0;
        for (const Plane<double>& plane : views_of_unit_square(budget.distance, 50)) {
            const double scale = 1 / budget.distance;
            const Plane<double> scaled{scale * plane.corner, scale * plane.side_x, scale * plane.side_y,
                                       plane.normal};
            const std::vector<float> angles = angles_of(converted<float>(scaled), single.light);
            for (int cell = 0; cell < 256; ++cell) {
                // Rounded planes have another horizon: cells next to it say nothing.
                const Vec2<double> low{cell % 16 / 16.0, cell / 16 / 16.0};
                if (plane.point_at(low).z < 0.1 || plane.point_at({low.x + 0.0625, low.y + 0.0625}).z < 0.1)
                    continue;
                const auto expected = static_cast<double>(reference(scaled, stored.light, cell));
                const double error = angles[static_cast<std::size_t>(cell)] / expected - 1;
                squares += error * error;
                ++count;
            }
        }
        const double rms = std::sqrt(squares / count);
        RecordProperty("rms at " + std::to_string(budget.distance), std::to_string(rms));
        EXPECT_LT(rms, budget.rms) << budget.distance;
        EXPECT_GT(count, 2000);
    }
}

/// Where rounding exceeds the angle, as next to the plane of the light, a cell keeps a weight.
TEST(CellLattice, LeavesNoCellWithoutWeight) {
    const SquareTexture<float> texture(16, [](int, int) { return 1; });
    const StoredLight<float, 16> single(NearestFilter(), texture.view(), unit_square<float>());
    for (const float height : {1e-2f, 1e-4f, 1e-6f, 1e-8f}) {
        const auto plane = nusselt::make_texture_plane<float>({-0.3f, height, 0.1f}, {1, 0, 0}, {0, 0, 1});
        for (const float angle : angles_of(plane, single.light)) {
            ASSERT_GT(angle, 0) << height;
            ASSERT_LT(angle, 3.15f) << height;
        }
    }
}

} // namespace
} // namespace nusselt_test
