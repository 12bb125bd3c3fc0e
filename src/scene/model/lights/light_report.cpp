#include "scene/model/lights/light_report.h"

#include "scene/model/lights/light_text.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <numbers>

namespace nusselt::scene {

namespace {

/// The power in the strongest channel [W].
double power(const LightList& list, std::size_t i) {
    const Double3 radiance = to_double(list.radiance(i));
    return std::numbers::pi * list.emitting_area(i) * std::max({radiance.x, radiance.y, radiance.z});
}

/// Reports lights that cost as much time as others but contribute next to nothing.
std::string weak_lights(const LightList& list) {
    constexpr double kWeak = 1e-6;
    double total = 0;
    for (std::size_t i = 0; i < list.size(); ++i) total += power(list, i);
    std::size_t weak = 0;
    for (std::size_t i = 0; i < list.size(); ++i) weak += power(list, i) < kWeak * total ? 1 : 0;
    if (weak == 0) return "";
    const std::string plural(list.plural());
    return "  " + std::to_string(weak) + " " + plural + " have less than " + report_text(kWeak) +
           " of the power of all " + plural + "\n";
}

} // namespace

std::string light_report(const Scene& scene) {
    std::string counts;
    std::string text;
    for (const LightList& list : scene.lights) {
        counts += (counts.empty() ? "" : ", ") + std::to_string(list.size()) + " " +
                  std::string(list.name()) + " lights";
        for (std::size_t begin = 0, end = 0; begin < list.size(); begin = end) {
            while (end < list.size() && list.emitter(end) == list.emitter(begin)) ++end;
            text += "  " + scene.emitters[list.emitter(begin)].name + ": " + list.describe(begin, end) + "\n";
        }
        text += weak_lights(list);
    }
    return counts + "\n" + text;
}

} // namespace nusselt::scene
