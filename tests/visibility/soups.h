#pragma once
/// Scenes of triangles and lights for the tests of visibility.

#include "scene/model/scene.h"

#include <random>

namespace nusselt::visibility_test {

/// Material 0 is there, material 1 with a probability, material 2 not at all.
inline constexpr std::uint32_t kFull = 0;
inline constexpr std::uint32_t kPartial = 1;
inline constexpr std::uint32_t kAbsent = 2;

scene::Scene make_empty_scene();

/// \param light index of a polygonal light, or -1
void add_triangle(scene::Scene& scene, const scene::Float3& a, const scene::Float3& b, const scene::Float3& c,
                  std::uint32_t material = kFull, std::int32_t light = -1);

/// Adds a rectangular light and its two triangles.
void add_light(scene::Scene& scene, const scene::Float3& corner, const scene::Float3& u,
               const scene::Float3& v);

/// The light of most tests: 2 by 1.5, in the plane z = 2, its triangles included.
void add_ceiling_light(scene::Scene& scene);

/// Triangles of very different sizes between -1 and 1 in x, y and z.
void add_soup(scene::Scene& scene, int count, std::mt19937& random);

/// Twelve triangles around a box, neighbours with vertices of their own.
void add_box(scene::Scene& scene, const scene::Float3& low, const scene::Float3& high);

/// Makes the triangles from one on to an object. Call in the order of the triangles.
void make_object(scene::Scene& scene, std::uint32_t first_triangle);

/// The scene with the triangles of its instances in the world, transformed in double precision.
scene::Scene without_instances(const scene::Scene& scene);

/// The scene with all lengths multiplied.
scene::Scene scaled(scene::Scene scene, float factor);

} // namespace nusselt::visibility_test
