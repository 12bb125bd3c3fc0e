#pragma once
/// The settings that programs choose where users leave them open.

#include "render/settings.h"
#include "scene/model/scene.h"

namespace nusselt::render {

/// A technique for each component of the BRDF where both have one.
Strategies usual_strategies(Technique technique, BrdfChoice brdf);

/// The heuristic of RenderSettings, or the balance heuristic where that one is of no use.
Mis usual_mis(Strategies strategies);

/// The samples per pixel that the scene asks for, at most as many as the renderer takes; 1 if it leaves them open.
int usual_samples(const scene::Film& film);

} // namespace nusselt::render
