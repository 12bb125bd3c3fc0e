#include "scene/model/lights/round_form.h"

#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>

namespace nusselt::scene {

namespace {

bool is_flat(const RoundLight& light) { return light.model == RoundModel::ellipse; }

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
    const Double3 axis[] = {to_double(light.u), to_double(light.v), to_double(light.w)};
    form.center = light.center;
    form.axis[0] = light.u;
    form.axis[1] = light.v;
    form.axis[2] = light.w;
    form.radius = static_cast<float>(semi_axes(light)[1]);
    form.radiance = light.radiance;
    form.emits_outwards = light.two_sided || light.model != RoundModel::hollow;
    form.emits_inwards = light.two_sided || light.model == RoundModel::hollow;
    form.shell = 1;
    form.normal = to_float(normalized(cross(axis[0], axis[1])));
    if (is_flat(light)) return form;
    const double volume = dot(axis[0], cross(axis[1], axis[2]));
    for (std::size_t i = 0; i < 3; ++i)
        form.inverse[i] = to_float((1 / volume) * cross(axis[(i + 1) % 3], axis[(i + 2) % 3]));
    return form;
}

Double3 in_unit_sphere(const RoundForm& form, const Float3& p) {
    const Double3 offset = to_double(p) - to_double(form.center);
    return {dot(to_double(form.inverse[0]), offset), dot(to_double(form.inverse[1]), offset),
            dot(to_double(form.inverse[2]), offset)};
}

/// The distance of the plane of a triangle from the centre, in the space of the unit sphere.
double plane_distance(const Scene& scene, const RoundForm& form, const Triangle& triangle) {
    Double3 p[3];
    for (std::size_t i = 0; i < 3; ++i) p[i] = in_unit_sphere(form, scene.positions[triangle.vertex[i]]);
    return std::fabs(dot(normalized(cross(p[1] - p[0], p[2] - p[0])), p[0]));
}

/// Shrinks the shells of lights that emit inwards into their surfaces.
/// \param first the number of the first form among all lights of the scene
void fit_shells(const Scene& scene, std::size_t first, std::vector<RoundForm>& forms) {
    const auto is_relevant = [](const RoundForm& form) {
        return form.emits_inwards != 0 &&
               (form.shape == RoundShape::sphere || form.shape == RoundShape::ellipsoid);
    };
    if (std::none_of(forms.begin(), forms.end(), is_relevant)) return;
    constexpr double kMargin = 1e-4; // for rounding, and because shadow rays have to end before the surface
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::int64_t index = std::int64_t{scene.triangle_light[i]} - static_cast<std::int64_t>(first);
        if (index < 0 || index >= static_cast<std::int64_t>(forms.size())) continue;
        RoundForm& form = forms[static_cast<std::size_t>(index)];
        if (!is_relevant(form)) continue;
        const double distance = plane_distance(scene, form, scene.triangles[i]);
        // Comparisons with NaN, of triangles without area, are false.
        if (distance * (1 - kMargin) < form.shell) form.shell = static_cast<float>(distance * (1 - kMargin));
    }
}

} // namespace

std::vector<RoundForm> round_forms(const Scene& scene) {
    std::vector<RoundForm> forms;
    std::size_t first = 0;
    for (const LightList& list : scene.lights) {
        if (dynamic_cast<const LightsOf<RoundLight>*>(&list) != nullptr) break;
        first += list.size();
    }
    for (const RoundLight& light : scene.lights.of<RoundLight>()) forms.push_back(make_form(light));
    fit_shells(scene, first, forms);
    return forms;
}

} // namespace nusselt::scene
