#include "scene/model/lights/polygon_light.h"

#include "scene/model/bounds.h"
#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/lights/light_text.h"
#include "scene/model/number_text.h"
#include "scene/model/polygon.h"
#include "scene/model/transform.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace nusselt::scene {

namespace {

using Kind = LightKind<PolygonLight>;

std::vector<Double3> corners(const PolygonLight& light) {
    std::vector<Double3> result;
    for (const Float3& p : light.vertices) result.push_back(to_double(p));
    return result;
}

} // namespace

void PolygonVertices::push_back(const Float3& vertex) {
    if (size_ == kCapacity) throw std::length_error("polygonal lights have at most 8 vertices");
    if (size_ == few_.size() && many_ == nullptr) {
        many_ = std::make_unique<std::array<Float3, kCapacity>>();
        std::copy(few_.begin(), few_.end(), many_->begin());
    }
    begin()[size_++] = vertex;
}

PolygonVertices& PolygonVertices::operator=(const PolygonVertices& other) {
    if (this != &other) assign(other.begin(), other.end());
    return *this;
}

const Float3& PolygonVertices::at(std::size_t i) const {
    if (i >= size_) throw std::out_of_range("vertex of a polygonal light");
    return begin()[i];
}

double area(const PolygonLight& light) { return 0.5 * length(area_vector(corners(light))); }

void Kind::add_to(const PolygonLight& light, Bounds& bounds) {
    for (const Float3& p : light.vertices) bounds.add(to_double(p));
}

// A new member does not compile until it is listed here.
void Kind::hash(const PolygonLight& light, ContentHash& hash) {
    const auto& [emitter, texture, vertices, radiance, two_sided, profile] = light;
    hash.add(emitter, texture, profile);
    hash.add(vertices.size());
    for (const Float3& vertex : vertices) hash.add(vertex);
    hash.add(radiance, two_sided);
}

Double3 Kind::flux_per_emission(const PolygonLight& light, double /*scene_radius*/) {
    return lambertian_flux((light.two_sided ? 2 : 1) * area(light));
}

void Kind::add_moment(const PolygonLight& light, Moment& moment) {
    const std::vector<Double3> p = corners(light);
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
        moment.add(0.5 * length(cross(p[i] - p[0], p[i + 1] - p[0])), (1.0 / 3) * (p[0] + p[i] + p[i + 1]));
}

/// Renderers normalise normals in float.
bool Kind::is_valid(const PolygonLight& light) {
    const auto& p = light.vertices;
    if (!std::all_of(p.begin(), p.end(), is_valid_coordinate)) return false;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
        const Double3 normal =
            cross(to_double(p[i]) - to_double(p[0]), to_double(p[i + 1]) - to_double(p[0]));
        if (!(dot(normal, normal) >= static_cast<double>(std::numeric_limits<float>::min()))) return false;
    }
    return true;
}

void Kind::transform(PolygonLight& light, const Transform& transform) {
    for (Float3& p : light.vertices) p = to_float(transform_point(transform, to_double(p)));
}

bool Kind::same_shape(const PolygonLight& a, const PolygonLight& b) {
    return std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end());
}

const bool* Kind::two_sided(const PolygonLight& light) { return &light.two_sided; }

void Kind::add_mesh(const PolygonLight& /*light*/, LightMesh& /*mesh*/) {}

void Kind::add_surface(const PolygonLight& light, LightSurface& surface) {
    const auto count = static_cast<std::uint32_t>(light.vertices.size());
    surface.positions.assign(light.vertices.begin(), light.vertices.end());
    surface.normals.assign(count, {0, 0, 0});
    surface.uvs.assign(count, {0, 0});
    for (std::uint32_t i = 1; i + 1 < count; ++i) surface.triangles.push_back({{0, i, i + 1}});
}

double Kind::hit(const PolygonLight& light, const SightRay& ray) {
    constexpr double kMiss = std::numeric_limits<double>::infinity();
    const std::vector<Double3> p = corners(light);
    // Newell's normal is right also where three corners are on a line.
    Double3 normal;
    for (std::size_t i = 0; i < p.size(); ++i) normal = normal + cross(p[i], p[(i + 1) % p.size()]);
    const double t = dot(p[0] - ray.origin, normal) / dot(ray.direction, normal);
    if (!(t > 0)) return kMiss;
    const Double3 at = ray.origin + t * ray.direction;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Double3 edge = p[(i + 1) % p.size()] - p[i];
        if (dot(cross(edge, at - p[i]), normal) < 0) return kMiss;
    }
    return t;
}

std::string Kind::describe(std::span<const PolygonLight> lights, double /*scene_radius*/) {
    double sum = 0;
    Double3 emitted = {0, 0, 0};
    std::size_t vertices = 0;
    for (const PolygonLight& light : lights) {
        sum += area(light);
        emitted = emitted + area(light) * to_double(light.radiance);
        vertices += light.vertices.size();
    }
    const PolygonLight& first = lights.front();
    // The polygons of one surface show different parts of an image.
    const Float3 radiance = to_float((1 / sum) * emitted);
    const double sides = first.two_sided ? 2 : 1;
    return (lights.size() > 1 ? std::to_string(lights.size()) + " polygons, " : "") +
           std::to_string(vertices) + " vertices, " + report_text(sum) + " m^2, " +
           (first.texture >= 0 ? "textured, " : "") +
           (first.texture >= 0 || first.profile >= 0 ? "mean radiance " : "radiance ") +
           report_text(radiance) + " W/(sr m^2), " + (first.two_sided ? "two-sided, " : "") +
           power_text(lambertian_flux(sides * sum), radiance);
}

std::string Kind::rig_field(const PolygonLight& light) {
    // Importers merge what readers of rigs might not take for one polygon.
    if (find_polygon_defect(corners(light))) return "";
    std::string text;
    for (const Float3& p : light.vertices) text += (text.empty() ? "[" : ", ") + triple_text(p);
    return "\"polygon\": " + text + "]";
}

} // namespace nusselt::scene
