#pragma once
/// Closed triangle meshes, each with a point inside.

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <nusselt/core/trig.h>

#include "proof/hostile/lights.h"

NUSSELT_NAMESPACE_BEGIN
namespace shadows {

struct Mesh {
    std::vector<Vec3<double>> vertices;
    std::vector<std::array<int, 3>> triangles; ///< in either winding
    Vec3<double> inside{0, 0, 0};              ///< well away from the surface
};

/// An icosahedron whose triangles are divided into four `divisions` times.
inline Mesh make_icosphere(int divisions) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    Mesh mesh;
    for (const double a : {-1.0, 1.0})
        for (const double b : {-g, g}) {
            mesh.vertices.push_back(normalize(Vec3<double>{0, a, b}));
            mesh.vertices.push_back(normalize(Vec3<double>{a, b, 0}));
            mesh.vertices.push_back(normalize(Vec3<double>{b, 0, a}));
        }
    // The corners of each face are three mutual neighbours.
    const double side = 2 / std::sqrt(1 + g * g);
    const auto adjacent = [&](int i, int j) {
        const Vec3<double> d = mesh.vertices[i] - mesh.vertices[j];
        return std::abs(std::sqrt(dot(d, d)) - side) < 0.1;
    };
    for (int i = 0; i < 12; ++i)
        for (int j = i + 1; j < 12; ++j)
            for (int k = j + 1; k < 12; ++k)
                if (adjacent(i, j) && adjacent(j, k) && adjacent(i, k)) mesh.triangles.push_back({i, j, k});
    for (int pass = 0; pass < divisions; ++pass) {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int i, int j) {
            const auto [found, is_new] =
                middles.insert({std::minmax(i, j), static_cast<int>(mesh.vertices.size())});
            if (is_new) mesh.vertices.push_back(normalize(mesh.vertices[i] + mesh.vertices[j]));
            return found->second;
        };
        std::vector<std::array<int, 3>> divided;
        for (const auto& [a, b, c] : mesh.triangles) {
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            divided.insert(divided.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = divided;
    }
    return mesh;
}

/// A torus of radius 1 around the z-axis, with a tube of radius 0.4.
inline Mesh make_torus(int around, int tube) {
    Mesh mesh;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < tube; ++j) {
            const double a = 2 * kPi<double> * i / around;
            const double b = 2 * kPi<double> * j / tube;
            const double radius = 1 + 0.4 * std::cos(b);
            mesh.vertices.push_back({radius * std::cos(a), radius * std::sin(a), 0.4 * std::sin(b)});
            const int next_i = (i + 1) % around * tube, next_j = (j + 1) % tube;
            mesh.triangles.push_back({i * tube + j, next_i + j, next_i + next_j});
            mesh.triangles.push_back({i * tube + j, next_i + next_j, i * tube + next_j});
        }
    mesh.inside = {1, 0, 0};
    return mesh;
}

/// The surface of some cells of a grid, such as a box or an angular room, divided into squares.
/// \param cells     which of the 3 x 3 x 3 cells are inside, as bits x + 3 y + 9 z; cell 0 always is.
/// \param divisions squares along each edge of a cell.
inline Mesh make_cells(unsigned cells, int divisions) {
    const auto inside = [&](const std::array<int, 3>& c) {
        for (const int x : c)
            if (x < 0 || x > 2) return false;
        const int bit = c[0] + 3 * c[1] + 9 * c[2];
        return bit == 0 || (cells >> bit & 1u) != 0;
    };
    Mesh mesh;
    std::map<std::array<int, 3>, int> vertices;
    const auto vertex = [&](const std::array<int, 3>& at) {
        const auto [found, is_new] = vertices.insert({at, static_cast<int>(mesh.vertices.size())});
        if (is_new)
            mesh.vertices.push_back(
                {double(at[0]) / divisions, double(at[1]) / divisions, double(at[2]) / divisions});
        return found->second;
    };
    for (int cell = 0; cell < 27; ++cell) {
        const std::array<int, 3> c{cell % 3, cell / 3 % 3, cell / 9};
        for (int axis = 0; axis < 3 && inside(c); ++axis)
            for (const int side : {0, 1}) {
                std::array<int, 3> neighbour = c;
                neighbour[axis] += 2 * side - 1;
                if (inside(neighbour)) continue;
                for (int square = 0; square < divisions * divisions; ++square) {
                    int corner[4];
                    for (int k = 0; k < 4; ++k) {
                        std::array<int, 3> at;
                        at[axis] = (c[axis] + side) * divisions;
                        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                        at[u] = c[u] * divisions + square % divisions + (k == 1 || k == 2);
                        at[v] = c[v] * divisions + square / divisions + (k >= 2);
                        corner[k] = vertex(at);
                    }
                    mesh.triangles.push_back({corner[0], corner[1], corner[2]});
                    mesh.triangles.push_back({corner[0], corner[2], corner[3]});
                }
            }
    }
    mesh.inside = {0.5, 0.5, 0.5};
    return mesh;
}

/// Moves each vertex by at most `distance` in each coordinate.
inline void shake(Mesh& mesh, double distance, hostile::RandomSource& random) {
    for (Vec3<double>& v : mesh.vertices)
        v = v + Vec3<double>{random.between(-distance, distance), random.between(-distance, distance),
                             random.between(-distance, distance)};
}

/// A mesh of a few dozen to a thousand triangles.
inline Mesh make_closed_mesh(hostile::RandomSource& random) {
    switch (random.index(4)) {
    case 0: {
        const int divisions = random.index(4);
        Mesh mesh = make_icosphere(divisions);
        if (random.index(2) == 0) shake(mesh, 0.1 / (1 << divisions), random);
        return mesh;
    }
    case 1: {
        const int around = 4 + random.index(28), tube = 3 + random.index(12);
        Mesh mesh = make_torus(around, tube);
        if (random.index(2) == 0) shake(mesh, 0.3 / (around + tube), random);
        return mesh;
    }
    default: {
        const int divisions = 1 + random.index(4);
        const unsigned cells = random.index(2) == 0 ? 0 : static_cast<unsigned>(random.index(1 << 27));
        Mesh mesh = make_cells(cells, divisions);
        if (random.index(2) == 0) shake(mesh, 0.2 / divisions, random);
        return mesh;
    }
    }
}

} // namespace shadows
NUSSELT_NAMESPACE_END
