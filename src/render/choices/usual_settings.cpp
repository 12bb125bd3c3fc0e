#include "render/choices/usual_settings.h"

#include <algorithm>

namespace nusselt::render {

Strategies usual_strategies(Technique technique, BrdfChoice brdf) {
    const auto both = Strategies::diffuse_ltc;
    const bool useful = brdf == BrdfChoice::material;
    return useful && allows(technique, both) ? both : Strategies::diffuse;
}

Mis usual_mis(Strategies strategies) {
    const Mis usual = RenderSettings().mis;
    return allows(strategies, usual) ? usual : Mis::balance;
}

int usual_samples(const scene::Film& film) { return std::min(film.pixel_samples.value_or(1), kMaxSamples); }

} // namespace nusselt::render
