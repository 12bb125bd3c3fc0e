#pragma once
/// Scenes for tests of shadow rays.

#include "exact_shadow.h"
#include "soups.h"

#include <random>
#include <vector>

namespace nusselt::gpu_visibility_test {

/// A closed mesh around the origin, its radius between 0.7 and 1.3, in 2 * rings * sectors triangles; moved.
void add_bumpy_sphere(scene::Scene& scene, int rings, int sectors, const scene::Float3& centre,
                      std::mt19937& random, std::uint32_t material = visibility_test::kFull);

/// Triangles a thousand times as long as wide.
void add_needles(scene::Scene& scene, int count, std::mt19937& random);

/// Rays between random points of the cube that is twice as large as that of the soups.
std::vector<Ray> random_rays(std::size_t count, std::mt19937& random);

/// Rays from points near the centre through vertices, edges and the insides of triangles of the scene, and beyond.
std::vector<Ray> rays_through_triangles(const scene::Scene& scene, const scene::Float3& centre,
                                        std::mt19937& random);

/// Copies of the object: turned, mirrored, stretched, and one far away.
void add_instances(scene::Scene& scene, std::uint32_t object, std::mt19937& random);

} // namespace nusselt::gpu_visibility_test
