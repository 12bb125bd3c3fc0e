#include "scene/model/lights/round/round_form.h"

#include "scene/model/lights/round/round_axes.h"

#include <cmath>

namespace nusselt::scene {

namespace {

/// Whether the semi-diameters are perpendicular and equally long, up to the rounding of transforms.
bool is_circular(const RoundLight& light) {
    constexpr double kTolerance = 1e-6;
    const Double3 u = to_double(light.u), v = to_double(light.v), w = to_double(light.w);
    const double square = dot(u, u);
    const auto is_small = [&](double x) { return std::fabs(x) <= kTolerance * square; };
    if (!is_small(dot(v, v) - square) || !is_small(dot(u, v))) return false;
    return is_flat(light) || (is_small(dot(w, w) - square) && is_small(dot(u, w)) && is_small(dot(v, w)));
}

RoundForm make_form(const RoundLight& light) {
    RoundForm form{};
    const bool is_round = is_circular(light);
    form.shape = is_flat(light) ? (is_round ? RoundShape::disk : RoundShape::ellipse)
                                : (is_round ? RoundShape::sphere : RoundShape::ellipsoid);
    const RoundAxes axes(light);
    form.center = light.center;
    form.axis[0] = light.u;
    form.axis[1] = light.v;
    form.axis[2] = light.w;
    form.radius = static_cast<float>(semi_axes(light)[1]);
    form.radiance = light.radiance;
    form.emits_outwards = light.two_sided || light.model != RoundModel::hollow;
    form.emits_inwards = light.two_sided || light.model == RoundModel::hollow;
    form.normal = to_float(normalized(axes.cofactor[2]));
    if (is_flat(light)) return form;
    for (std::size_t i = 0; i < 3; ++i) form.inverse[i] = to_float(axes.inverse_row(i));
    return form;
}

} // namespace

std::vector<RoundForm> round_forms(const Scene& scene) {
    std::vector<RoundForm> forms;
    for (const RoundLight& light : scene.lights.of<RoundLight>()) forms.push_back(make_form(light));
    return forms;
}

} // namespace nusselt::scene
