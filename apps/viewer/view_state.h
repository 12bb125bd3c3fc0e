#pragma once
/// Settings of the user in the viewer.

#include "fly_camera.h"

#include "render/settings.h"
#include "render_vulkan/display_pass.h"
#include "viewer/lights/light_edits.h"

#include <array>
#include <cstddef>
#include <optional>

namespace nusselt::viewer {

/// One of the two images of a split screen.
enum class Side : std::size_t { left, right };

inline constexpr std::array kSides = {Side::left, Side::right};

// Limits for interactive use: beyond them, frames take too long or are all black or white.
inline constexpr int kMostFrameSamples = 64;
inline constexpr double kLargestExposure = 32; ///< [stops]

struct ViewState {
    FlyCamera camera;
    std::array<render::RenderSettings, 2> settings; ///< by Side; `samples` are those of a frame
    bool is_split = false;
    double wipe = 0.5; ///< the right image begins at this share of the width
    /// Whether frames are averaged; otherwise each frame is shown by itself, as in a game.
    bool accumulates = true;
    bool renders_reference = false; ///< with every frame one of the reference
    double exposure = 0;            ///< [stops]
    render_vulkan::ToneCurve tone_curve = render_vulkan::ToneCurve::none;
    render_vulkan::Shown shown = render_vulkan::Shown::image;
    /// The side of the squares of pixels that share a rendered pixel: 1 for the resolution of the film.
    int reduction = 1;
    LightEdits edits = {};
    std::optional<std::size_t> selected_light = {}; ///< index in LightEdits

    const render::RenderSettings& of(Side side) const { return settings[static_cast<std::size_t>(side)]; }
    render::RenderSettings& of(Side side) { return settings[static_cast<std::size_t>(side)]; }
};

// Settings that do not fit the new one become some that do.
void choose_technique(render::Technique technique, render::RenderSettings& settings);
void choose_strategies(render::Strategies strategies, render::RenderSettings& settings);
void choose_mis(render::Mis mis, render::RenderSettings& settings);

} // namespace nusselt::viewer
