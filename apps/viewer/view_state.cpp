#include "view_state.h"

#include <algorithm>

namespace nusselt::viewer {

namespace {

/// The first value of a list that fits.
template <class Values, class Fits>
auto first_that(const Values& values, const Fits& fits) {
    return *std::find_if(values.begin(), values.end(), fits);
}

} // namespace

void choose_technique(render::Technique technique, render::RenderSettings& settings) {
    settings.technique = technique;
    // All techniques can do without a second one.
    if (!allows(technique, settings.strategies)) settings.strategies = render::Strategies::diffuse;
}

void choose_strategies(render::Strategies strategies, render::RenderSettings& settings) {
    settings.strategies = strategies;
    if (!allows(settings.technique, strategies))
        settings.technique = render::Technique::projected_solid_angle;
    if (!allows(strategies, settings.mis))
        settings.mis =
            first_that(render::kMisHeuristics, [&](render::Mis mis) { return allows(strategies, mis); });
}

void choose_mis(render::Mis mis, render::RenderSettings& settings) {
    settings.mis = mis;
    if (allows(settings.strategies, mis)) return;
    settings.strategies = render::Strategies::diffuse_ltc;
    if (!allows(settings.technique, settings.strategies))
        settings.technique = render::Technique::projected_solid_angle;
}

} // namespace nusselt::viewer
