#include "lab/timing/sampler_timing_lights.h"

#include "proof/techniques/registry.h"
#include "proof/tube_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>

namespace nusselt::lab {

std::vector<TimedConfiguration> timed_configurations() {
    std::vector<TimedConfiguration> result;
    for (int n = 3; n <= 7; ++n) {
        const std::string vertices = ", " + std::to_string(n) + " vertices";
        result.push_back({"decentral" + vertices, LightKind::polygon, n, 0.5, 0.7, 0.3, false});
        result.push_back({"central" + vertices, LightKind::polygon, n, 1.0, 1.0, 0.5, true});
        result.push_back({"crossing the horizon" + vertices, LightKind::polygon, n, -0.1, 0.1, 0.4, false});
    }
    result.push_back({"decentral, 4 vertices", LightKind::polygon_on_lobe, 4, 0.5, 0.7, 0.3, false});
    result.push_back(
        {"crossing the horizon, 4 vertices", LightKind::polygon_on_lobe, 4, -0.1, 0.1, 0.4, false});
    for (const LightKind kind :
         {LightKind::line, LightKind::line_on_lobe, LightKind::cylinder, LightKind::cylinder_on_lobe}) {
        result.push_back({"above the horizon", kind, 2, 0.5, 0.7, 0.4, false});
        result.push_back({"crossing the horizon", kind, 2, -0.1, 0.1, 0.4, false});
    }
    return result;
}

void make_timed_lights(const TimedConfiguration& c, TimedLights& lights) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> uniform(0.0f, 0.9999f);
    std::normal_distribution<double> normal;
    const auto unit = [&](double x, double y, double z) {
        const double r = std::sqrt(x * x + y * y + z * z);
        return std::array{x / r, y / r, z / r};
    };
    for (int i = 0; i < kTimedLights; ++i) {
        const double height = c.lowest + (c.highest - c.lowest) * uniform(generator);
        const double azimuth = 2 * std::numbers::pi * uniform(generator);
        const double side = c.above_zenith ? 0.0 : std::sqrt(1 - height * height);
        const std::array centre{side * std::cos(azimuth), side * std::sin(azimuth), height};
        std::array a = unit(normal(generator), normal(generator), c.above_zenith ? 0 : normal(generator));
        std::array b = unit(normal(generator), normal(generator), normal(generator));
        if (c.above_zenith) b = {-a[1], a[0], 0};
        const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        b = unit(b[0] - along * a[0], b[1] - along * a[1], b[2] - along * a[2]);
        for (int j = 0; j < kLargestVertexCount; ++j) {
            const double angle = 2 * std::numbers::pi * std::min(j, c.vertex_count - 1) / c.vertex_count;
            for (int axis = 0; axis < 3; ++axis)
                lights.coordinates[j][axis][i] = static_cast<float>(
                    centre[axis] + c.radius * (std::cos(angle) * a[axis] + std::sin(angle) * b[axis]));
        }
        lights.radius[i] = static_cast<float>(c.radius / 4);
        const auto& lobe = proof::kGlossyLobe;
        const double entries[] = {lobe.m00, lobe.m02, lobe.m11, lobe.m20, lobe.m22, lobe.albedo};
        for (std::size_t k = 0; k < std::size(entries); ++k)
            lights.lobe[k][i] = static_cast<float>(entries[k]);
        for (auto& dimension : lights.u) dimension[i] = uniform(generator);
    }
}

double quantile(std::vector<double> values, double share) {
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

std::string competitor_of(const std::string& technique) {
    std::string competitor;
    hostile::KindsWithBounds<4>::for_each([&]<class Kind> {
        if (technique == Kind::kName) competitor = Kind::kCompetitorName;
    });
    return competitor;
}

} // namespace nusselt::lab
