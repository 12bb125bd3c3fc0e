#include "lab/tubes/tube_settings.h"

namespace nusselt::lab {

render::RenderSettings sampled_tubes(int samples) {
    render::RenderSettings settings;
    settings.strategies = render::Strategies::diffuse_ltc;
    settings.mis = render::Mis::weighted_balance;
    settings.samples = samples;
    settings.sample_order = render::SampleOrder::sobol;
    settings.pixel_position = render::PixelPosition::center;
    return settings;
}

render::RenderSettings analytic_tubes() {
    render::RenderSettings settings;
    settings.technique = render::Technique::ltc_analytic;
    settings.samples = 1;
    settings.pixel_position = render::PixelPosition::center;
    return settings;
}

} // namespace nusselt::lab
