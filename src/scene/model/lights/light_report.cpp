#include "scene/model/lights/light_report.h"

#include "scene/model/lights/light_text.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <numbers>
#include <ostream>

namespace nusselt::scene {

namespace {

/// The power in the strongest channel [W].
double power(const LightList& list, std::size_t i) {
    const Double3 radiance = to_double(list.radiance(i));
    return std::numbers::pi * list.emitting_area(i) * std::max({radiance.x, radiance.y, radiance.z});
}

/// Reports lights that cost as much time as others but contribute next to nothing.
void write_weak_lights(const LightList& list, std::ostream& stream) {
    constexpr double kWeak = 1e-6;
    double total = 0;
    for (std::size_t i = 0; i < list.size(); ++i) total += power(list, i);
    std::size_t weak = 0;
    for (std::size_t i = 0; i < list.size(); ++i) weak += power(list, i) < kWeak * total ? 1 : 0;
    if (weak == 0) return;
    stream << "  " << weak << " of the " << list.plural() << (weak == 1 ? " has" : " have") << " less than "
           << report_text(kWeak) << " of the power of all\n";
}

} // namespace

void write_light_report(const Scene& scene, std::ostream& stream) {
    const char* separator = "";
    for (const LightList& list : scene.lights) {
        stream << separator << list.size() << " " << list.name() << (list.size() == 1 ? " light" : " lights");
        separator = ", ";
    }
    stream << "\n";
    for (const LightList& list : scene.lights) {
        for (std::size_t begin = 0, end = 0; begin < list.size(); begin = end) {
            while (end < list.size() && list.emitter(end) == list.emitter(begin)) ++end;
            stream << "  " << scene.emitters[list.emitter(begin)].name << ": " << list.describe(begin, end)
                   << "\n";
        }
        write_weak_lights(list, stream);
    }
}

} // namespace nusselt::scene
