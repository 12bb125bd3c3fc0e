#include "lab/timing/sampler_timing_lights.h"

#include "proof/techniques/registry.h"
#include "proof/tube_lights.h"

#include <algorithm>
#include <iterator>
#include <random>

namespace nusselt::lab {

static_assert(kLargestVertexCount == kMostCorners);

std::vector<TimedConfiguration> timed_configurations() {
    std::vector<TimedConfiguration> result;
    const auto add = [&](LightKind kind, const LightClass& lights, int n) {
        const std::string vertices = is_polygon(kind) ? ", " + std::to_string(n) + " vertices" : "";
        result.push_back({lights.name + vertices, kind, n, lights});
    };
    for (int n = 3; n <= 7; ++n)
        for (const LightClass& lights : {kDecentral, kCentral, kCrossing}) add(LightKind::polygon, lights, n);
    for (const LightClass& lights : {kDecentral, kCrossing}) add(LightKind::polygon_on_lobe, lights, 4);
    for (const LightKind kind :
         {LightKind::line, LightKind::line_on_lobe, LightKind::cylinder, LightKind::cylinder_on_lobe})
        for (const LightClass& lights : {kLineAbove, kCrossing}) add(kind, lights, 2);
    for (const LightKind kind : {LightKind::round, LightKind::round_on_lobe})
        for (const LightClass& lights : {kLineAbove, kCrossing}) add(kind, lights, 4);
    return result;
}

void make_timed_lights(const TimedConfiguration& c, unsigned seed, TimedLights& lights) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> uniform(0.0f, 0.9999f);
    const auto put = [](float(&columns)[3][kTimedLights], int i, const Vec3<double>& v) {
        columns[0][i] = static_cast<float>(v.x);
        columns[1][i] = static_cast<float>(v.y);
        columns[2][i] = static_cast<float>(v.z);
    };
    for (int i = 0; i < kTimedLights; ++i) {
        const Vec3<double> normal = random_normal(generator);
        const Vec3<double> point = 10.0 * random_normal(generator);
        const auto frame = Frame<double>::from_normal(normal);
        const auto corners = random_light(c.lights, c.vertex_count, generator);
        put(lights.normal, i, normal);
        put(lights.point, i, point);
        for (int j = 0; j < kLargestVertexCount; ++j) {
            const Vec3<double>& corner = corners[static_cast<std::size_t>(j)];
            put(lights.coordinates[j], i, corner);
            put(lights.world[j], i, point + frame.to_world(corner));
        }
        lights.radius[i] = static_cast<float>(c.lights.radius / 4);
        const auto& lobe = proof::kGlossyLobe;
        const double entries[] = {lobe.m00, lobe.m02, lobe.m11, lobe.m20, lobe.m22, lobe.albedo};
        for (std::size_t k = 0; k < std::size(entries); ++k)
            lights.lobe[k][i] = static_cast<float>(entries[k]);
        for (auto& dimension : lights.u) dimension[i] = uniform(generator);
    }
}

std::string competitor_of(const std::string& technique) {
    std::string competitor;
    hostile::KindsWithBounds<4>::for_each([&]<class Kind> {
        if (technique == Kind::kName) competitor = Kind::kCompetitorName;
    });
    return competitor;
}

} // namespace nusselt::lab
