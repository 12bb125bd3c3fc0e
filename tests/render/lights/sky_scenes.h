#pragma once
/// Floors below skies, and what they reflect, for tests of environments.

#include "render/settings.h"
#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

namespace nusselt::render_test {

/// Columns and rows of the images.
inline constexpr int kSkyPixels = 16;

/// The unit direction of a point of the square (Clarberg 2008), by the formulas of the paper.
scene::Double3 square_direction(double x, double y);

/// Sets the mean over all directions.
void set_mean(scene::EnvironmentMapTexels& map);

/// A map of radiance(direction), a Float3, at the centres of texels.
template <class Radiance>
scene::EnvironmentMapTexels make_sky_map(int size, const Radiance& radiance) {
    scene::EnvironmentMapTexels map{"map", size, {}, {}};
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i)
            map.texels.push_back(radiance(square_direction((i + 0.5) / size, (j + 0.5) / size)));
    set_mean(map);
    return map;
}

/// Adds an environment as an emitter of its own. \param map its radiance; null for that of the light everywhere
void add_sky(scene::Scene& scene, scene::EnvironmentLight light,
             const scene::EnvironmentMapTexels* map = nullptr);

/// Independent samples at the centres of pixels.
render::RenderSettings centred(int samples);

struct PixelMean {
    double value = 0;
    double error = 0;     ///< standard deviation of the value
    double deviation = 0; ///< standard deviation of a pixel
};

/// Of the green channel over all pixels, which have the same expectation.
PixelMean render_green(const scene::Scene& scene, const render::RenderSettings& settings);

/// Whether both means are the same up to five standard deviations.
bool agree(const PixelMean& a, const PixelMean& b);

} // namespace nusselt::render_test
