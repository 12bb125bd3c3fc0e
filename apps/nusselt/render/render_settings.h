#pragma once
/// Converts the options of `nusselt render` to settings of the renderer.

#include "render.h"

#include "render/settings.h"
#include "scene/model/scene.h"

namespace nusselt::app {

/// Adds --technique, --strategies, --emission-sampling, --mis, --visibility-estimate, --sampler, --brdf and --seed.
void add_sampling_options(CLI::App& command, RenderOptions& options);

/// \throws std::invalid_argument for values that the command line does not let through
render::RenderSettings make_settings(const RenderOptions& options);

/// Chooses the number of samples that the scene asks for, or 1, if the command line leaves it open. More than the
/// renderer can take become as many as it can.
/// \throws CLI::ValidationError if the camera rays do not divide it
void choose_samples(const RenderOptions& options, const scene::Film& film, render::RenderSettings& settings);

/// \throws CLI::ValidationError if choices that are possible by themselves do not fit together
void check_combination(const RenderOptions& options);

} // namespace nusselt::app
