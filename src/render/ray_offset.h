#pragma once
/// Where shadow rays start: so far from a surface, along its geometric normal on the side of the eye, that rounding errors
/// do not put them behind it.

namespace nusselt::render {

/// This share of the scene's radius ...
inline constexpr float kOffsetPerRadius = 1e-5f;
/// ... plus this share of the largest coordinate, which bounds rounding errors of positions. The shaders have both once more
/// (shaders/passes/surface.glsl).
inline constexpr float kOffsetPerCoordinate = 1e-6f;

} // namespace nusselt::render
