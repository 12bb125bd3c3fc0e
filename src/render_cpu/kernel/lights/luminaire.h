#pragma once
/// Lookups of luminaires and profiles.

#include "render_cpu/kernel/lanes.h"
#include "render_cpu/lights/polygon_records.h"

#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The last of the entries but one that is not above a number; the first one if all are.
inline std::int32_t step_of(const float* increasing, std::int32_t count, float value) noexcept {
    std::int32_t low = 0;
    std::int32_t high = count - 1;
    while (high - low > 1) {
        const std::int32_t middle = (low + high) / 2;
        if (increasing[middle] <= value)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/// The intensity in a direction of unit length, in the frame of the luminaire.
inline float intensity_in(const render_cpu::LuminaireTable& table, const Vec3<float>& w) noexcept {
    const float vertical = atan2_positive(sqrt(w.x * w.x + w.y * w.y), w.z);
    const float* const v = table.vertical;
    // Comparisons with NaN are false.
    if (!(vertical >= v[0] && vertical <= v[table.vertical_count - 1])) return 0;
    const float half_turn = atan2_positive(abs(w.y), w.x);
    float horizontal = w.y > 0 ? 2 * kPi<float> - half_turn : half_turn;
    const float* const h = table.horizontal;
    if (horizontal < h[0]) horizontal += 2 * kPi<float>;
    const std::int32_t i = step_of(v, table.vertical_count, vertical);
    const std::int32_t j = step_of(h, table.horizontal_count, horizontal);
    const float s = (vertical - v[i]) / (v[i + 1] - v[i]);
    const float t = min((horizontal - h[j]) / (h[j + 1] - h[j]), 1.0f);
    const float* const row = table.intensity + static_cast<std::ptrdiff_t>(j) * table.vertical_count + i;
    const float* const next = row + table.vertical_count;
    return (1 - t) * ((1 - s) * row[0] + s * row[1]) + t * ((1 - s) * next[0] + s * next[1]);
}

/// The axes of a profile and the normal of its polygon, in any frame.
template <class R>
struct ProfileAxes {
    Vec3<R> x, y, z, normal;
};

/// The axes in world space.
inline ProfileAxes<float> axes_of(const render_cpu::PolygonProfile& profile) noexcept {
    return {to_vec(profile.x_axis), to_vec(profile.y_axis), to_vec(profile.z_axis), to_vec(profile.normal)};
}

/// The radiance in a direction over its mean. \param away unit, from the light, in the frame of the axes
inline float relative_radiance(const render_cpu::PolygonProfile& profile, const ProfileAxes<float>& axes,
                               const Vec3<float>& away) noexcept {
    float value = profile.inverse_mean;
    if (profile.inverse_slope > 0) {
        const float along = dot(axes.normal, away);
        const Vec3<float> across = away - along * axes.normal;
        const float slope = sqrt(dot(across, across)) / max(abs(along), kTiny<float>);
        value *= max(1 - slope * profile.inverse_slope, 0.0f);
    }
    if (profile.luminaire.vertical == nullptr || !(value > 0)) return value;
    const Vec3<float> w{dot(axes.x, away), dot(axes.y, away), dot(axes.z, away)};
    float visible = 0;
    for (std::int32_t i = 0; i < profile.face_count; ++i)
        visible += profile.faces[i].area * max(dot(to_vec(profile.faces[i].normal), w), 0.0f);
    return value * intensity_in(profile.luminaire, w) / max(visible, profile.least_area);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
