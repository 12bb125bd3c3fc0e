#pragma once
/// Scenes that tests of line samples share.

#include "scenes.h"

namespace nusselt::render_test {

/// The size of images along each axis [pixels].
inline constexpr int kSize = 32;
/// Points per pixel and light.
inline constexpr int kSamples = 16;

/// One camera ray through the centre of each pixel; lines whatever the occluders.
render::RenderSettings line_settings(int lines);

/// The same with points.
render::RenderSettings point_settings();

/// A floor below a panel, and small triangles in between. They are black: seen almost edge-on by the light, they would be
/// bright in a few images out of many.
scene::Scene make_soup(int triangles, int size = kSize);

} // namespace nusselt::render_test
