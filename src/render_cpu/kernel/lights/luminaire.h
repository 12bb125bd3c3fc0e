#pragma once
/// Lookups of luminaires and profiles.

#include "render_cpu/kernel/lanes.h"
#include "render_cpu/lights/polygon_records.h"

#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The last of the entries but one that is not above a number; the first one if all are.
inline std::int32_t step_of(const float* increasing, std::int32_t count, float value) noexcept {
    const std::int32_t last = count - 2;
    if (last <= 0) return 0;
    // Most tables have equal steps. Then this is the entry, or the next one because of rounding; a search has to guess.
    const float share = (value - increasing[0]) / (increasing[count - 1] - increasing[0]);
    std::int32_t at = static_cast<std::int32_t>(min(max(share, 0.0f), 1.0f) * static_cast<float>(count - 1));
    if (at > last) at = last;
    while (at < last && increasing[at + 1] <= value) ++at;
    while (at > 0 && increasing[at] > value) --at;
    return at;
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

/// The share of radiance that a spread passes in a direction, to either side. The sine is the length of the part across the
/// normal: taken from the cosine, it would cancel for narrow spreads.
/// \param normal of the light at the point, \param away from it: unit, in the same frame
template <class R>
R spread_share(const render_cpu::ProfileRecord& profile, const Vec3<R>& normal,
               const Vec3<R>& away) noexcept {
    if (!(profile.inverse_slope > 0)) return R(1);
    const R along = dot(normal, away);
    const Vec3<R> across = away - along * normal;
    const R slope = sqrt(dot(across, across)) / max(abs(along), R(kTiny<float>));
    return max(R(1) - slope * R(profile.inverse_slope), R(0));
}

/// The luminance of a profile without spread, over the mean. \param w unit, in the frame of the profile
inline float relative_luminance(const render_cpu::ProfileRecord& profile, const Vec3<float>& w) noexcept {
    if (profile.luminaire.vertical == nullptr) return profile.inverse_mean;
    const float along = dot(to_vec(profile.round_axis), w);
    float visible = profile.round_area * sqrt(max(1 - along * along, 0.0f));
    for (std::int32_t i = 0; i < profile.face_count; ++i)
        visible += profile.faces[i].area * max(dot(to_vec(profile.faces[i].normal), w), 0.0f);
    return profile.inverse_mean * intensity_in(profile.luminaire, w) / max(visible, profile.least_area);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
