#pragma once
/// Handles at a light by which the mouse moves and turns it along and about the axes of the world, and its outline.

#include "picking.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace nusselt::viewer {

enum class HandleAction { move, turn };

/// An arrow along an axis of the world, or a ring about it.
struct Handle {
    HandleAction action = HandleAction::move;
    std::size_t axis = 0; ///< x, y or z

    bool operator==(const Handle&) const = default;
};

inline constexpr std::array kHandles = {Handle{HandleAction::move, 0}, Handle{HandleAction::move, 1},
                                        Handle{HandleAction::move, 2}, Handle{HandleAction::turn, 0},
                                        Handle{HandleAction::turn, 1}, Handle{HandleAction::turn, 2}};

/// Lines of the image.
using FilmLines = std::vector<std::pair<FilmPosition, FilmPosition>>;

/// The handles of a light, equally large in the image at any distance.
struct LightHandles {
    /// \param width of the film [pixels]
    LightHandles(const scene::Double3& center_of_light, const scene::Camera& camera, double width);

    /// Where the handle is seen; empty behind the camera.
    FilmLines lines(const Handle& handle, const scene::Camera& camera) const;
    /// The handle at a place of the image. \param tolerance [pixels]
    std::optional<Handle> at(FilmPosition position, const scene::Camera& camera, double tolerance) const;

    scene::Double3 center;
    double length = 0; ///< of an arrow [m]; 0 if the light is behind the camera
};

/// How far the mouse drags an arrow along its axis [m]; zero where that cannot be said.
scene::Double3 drag_along(std::size_t axis, const scene::Double3& center, const scene::Camera& camera,
                          FilmPosition from, FilmPosition to);
/// The rotation by which a ring follows the mouse, as LightEdit::turn.
scene::Double3 turn_about(std::size_t axis, const scene::Double3& center, const scene::Camera& camera,
                          FilmPosition from, FilmPosition to);

/// The edges of the parts of a light, or their outlines if they are round.
FilmLines outline(const scene::Lights& parts, const scene::Camera& camera);

} // namespace nusselt::viewer
