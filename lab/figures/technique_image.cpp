#include "lab/figures/technique_image.h"

#include "lab/figures/pixel_centres.h"
#include "proof/techniques/registry.h"

#include <nusselt/bsdf/frostbite.h>
#include <nusselt/bsdf/phong.h>
#include <nusselt/estimate/backward_error.h>
#include <nusselt/line_samples/triangle_shadow.h>
#include <nusselt/ltc/ltc.h>
#include <nusselt/random/light_random.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace nusselt::lab {

namespace {

using Vector = Vec3<float>;
using Quad = ConvexPolygon<float, 4>;
using Line = LineSegment<float>;

Vector vector(const scene::Float3& v) { return {v.x, v.y, v.z}; }

/// Lights with less above the horizon are dark, as in the accuracy tables.
constexpr long double kSmallestMeasure = 1e-12L;

/// A light of the scene in the form that techniques take, in world space.
Quad shape_of(const scene::PolygonLight& light) {
    Vector vertices[4];
    for (std::size_t i = 0; i < 4; ++i) vertices[i] = vector(light.vertices[i]);
    return make_polygon<4>(vertices, 4);
}
Line shape_of(const scene::LineLight& light) { return make_line(vector(light.start), vector(light.end)); }

/// The emission towards a point, in the unit of a density: radiance, or radiance times the radius of a linear light.
Vector emission(const scene::PolygonLight& light, const Vector& point) {
    const Quad shape = shape_of(light);
    const bool is_in_front = dot(shape.normal, point - shape.vertex[0]) > 0;
    return light.two_sided || is_in_front ? vector(light.radiance) : Vector{0, 0, 0};
}
Vector emission(const scene::LineLight& light, const Vector& /*point*/) {
    return light.radius * vector(light.radiance);
}

/// Calls visit.operator()<Kind, Technique>() for the technique of a name, or for the published formulas of that name.
template <class List, class Visit>
void visit_technique(const std::string& name, const Visit& visit) {
    bool is_found = false;
    List::for_each([&]<class Kind> {
        using Published = typename Kind::template Published<float>;
        if (name == Kind::kName) {
            is_found = true;
            visit.template operator()<Kind, typename Kind::template Technique<float>>();
        } else if constexpr (!std::is_same_v<Published, hostile::Absent>) {
            if (name != Kind::kPublishedName) return;
            is_found = true;
            visit.template operator()<Kind, Published>();
        }
    });
    if (!is_found) throw std::invalid_argument("no technique of this name takes the light: " + name);
}

void put(const Vector& radiance, std::size_t pixel, image::Image& image) {
    const float channels[] = {radiance.x, radiance.y, radiance.z};
    std::copy_n(channels, 3, &image.pixels[3 * pixel]);
}

template <class Light>
struct KindsOf;
template <>
struct KindsOf<scene::PolygonLight> {
    using Type = hostile::Join<hostile::PolygonKinds<4>, hostile::RectangleKinds>;
};
template <>
struct KindsOf<scene::LineLight> {
    using Type = hostile::LineKinds;
};

} // namespace

/// The surface in a pixel, or the light where the camera sees it.
struct TechniqueImages::Pixel {
    bool is_surface = false;
    Vector radiance = {0, 0, 0}; ///< of the light, or black
    Vector position = {0, 0, 0};
    Vector shadow_offset = {0, 0, 0}; ///< from there to where shadow rays start
    Frame<float> frame = {};
    Vector wo = {0, 0, 0}; ///< in shading space
    const scene::Material* material = nullptr;

    Vector reflected(const Vector& wi) const {
        if (!(wi.z > 0)) return {0, 0, 0};
        const Vector albedo = vector(material->diffuse);
        if (material->model == scene::BrdfModel::lambert) return (wi.z / kPi<float>)*albedo;
        const Vector f0 = vector(material->f0);
        if (material->model == scene::BrdfModel::phong)
            return wi.z * LambertPhong<float>{{albedo}, {wo, f0, material->exponent}}.eval(wi);
        return wi.z * Frostbite<float>(wo, albedo, f0, material->roughness).eval(wi);
    }
};

bool has_one_light(const scene::Scene& scene) {
    if (scene.lights.size() != 1 || !scene.textures.empty() || !scene.instances.empty()) return false;
    const auto& polygons = scene.lights.of<scene::PolygonLight>();
    const auto& lines = scene.lights.of<scene::LineLight>();
    return polygons.empty() ? lines[0].model == scene::TubeModel::linear : polygons[0].vertices.size() == 4;
}

TechniqueImages::TechniqueImages(const scene::Scene& scene, const render_cpu::Renderer& renderer)
    : scene_(scene), tracer_(renderer.visibility().tracer()) {
    if (!has_one_light(scene))
        throw std::invalid_argument(
            "images by any technique need a scene with a quadrilateral or a linear light alone");
    const auto width = static_cast<std::size_t>(scene.film.width);
    const auto height = static_cast<std::size_t>(scene.film.height);
    pixels_.resize(width * height);
    tbb::parallel_for(std::size_t{0}, pixels_.size(), [&](std::size_t i) {
        const PixelCentre seen =
            see_centre(scene, tracer_, static_cast<int>(i % width), static_cast<int>(i / width));
        Pixel& pixel = pixels_[i];
        if (seen.line >= 0) pixel.radiance = vector(scene.lights.of<scene::LineLight>()[0].radiance);
        if (seen.triangle < 0) return;
        const auto triangle = static_cast<std::size_t>(seen.triangle);
        if (scene.triangle_light[triangle] >= 0) {
            pixel.radiance = emission(scene.lights.of<scene::PolygonLight>()[0], seen.origin);
            return;
        }
        const Vector wo = -normalize(seen.direction);
        pixel.is_surface = true;
        pixel.position = seen.position;
        pixel.shadow_offset = shadow_ray_offset(scene, seen);
        pixel.frame = shading_frame(seen.normal, wo);
        pixel.wo = pixel.frame.to_local(wo);
        pixel.material = &scene.materials[scene.triangle_material[triangle]];
    });
}

TechniqueImages::~TechniqueImages() = default;

Vec2<float> TechniqueImages::random_numbers(std::size_t i, std::uint32_t seed) const {
    const auto width = static_cast<std::size_t>(scene_.film.width);
    return light_random<float>(Sampler::independent, seed, static_cast<std::uint32_t>(i % width),
                               static_cast<std::uint32_t>(i / width), 0, 1, 0);
}

template <class Visit>
void TechniqueImages::visit_samples(const std::string& technique, std::uint32_t seed,
                                    const Visit& visit) const {
    const auto sample_light = [&]<class Light>(const Light& light) {
        const auto world = shape_of(light);
        visit_technique<typename KindsOf<Light>::Type>(technique, [&]<class Kind, class Technique> {
            tbb::parallel_for(std::size_t{0}, pixels_.size(), [&](std::size_t i) {
                if (!pixels_[i].is_surface) return;
                const auto shape = Kind::from(to_shading_space(world, pixels_[i].position, pixels_[i].frame));
                const Technique sampler(shape);
                const Vec2<float> u = random_numbers(i, seed);
                if constexpr (hostile::kTakesPairs<Kind>)
                    visit(i, light, shape, sampler.sample(u), Kind());
                else
                    visit(i, light, shape, sampler.sample(u.x), Kind());
            });
        });
    };
    const auto& polygons = scene_.lights.of<scene::PolygonLight>();
    if (polygons.empty())
        sample_light(scene_.lights.of<scene::LineLight>()[0]);
    else
        sample_light(polygons[0]);
}

image::Image TechniqueImages::render(const std::string& technique, std::uint32_t seed) const {
    image::Image image = image::make_image(scene_.film.width, scene_.film.height);
    const visibility::PacketTracer<4>& tracer = tracer_;
    // The same rays as those of the renderer.
    const auto is_visible = [&](const Pixel& pixel, const Vector& to_light) {
        const Vector& offset = pixel.shadow_offset;
        visibility::RayPacket<4> rays = {};
        put_ray(pixel.position + offset, to_light - offset, kShadowEnd<float>, rays);
        return tracer.occluded(tracer_.context, 1, rays) == 0;
    };

    visit_samples(technique, seed,
                  [&](std::size_t i, const auto& light, const auto&, const auto& sample, const auto&) {
                      const Pixel& pixel = pixels_[i];
                      Vector radiance = {0, 0, 0};
                      if (!std::isfinite(dot(sample.wi, sample.wi) + sample.pdf)) {
                          const float nan = std::numeric_limits<float>::quiet_NaN();
                          radiance = {nan, nan, nan};
                      } else if (sample.pdf > 0) {
                          const Vector reflected = pixel.reflected(sample.wi);
                          if (reflected.x + reflected.y + reflected.z > 0 &&
                              is_visible(pixel, pixel.frame.to_world(sample.p)))
                              radiance = (1 / sample.pdf) * (reflected * emission(light, pixel.position));
                      }
                      put(radiance, i, image);
                  });
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        if (!pixels_[i].is_surface) put(pixels_[i].radiance, i, image);
    return image;
}

PixelErrors TechniqueImages::backward_errors(const std::string& technique, std::uint32_t seed) const {
    using Exact = long double;
    const image::Plane dark = {scene_.film.width, scene_.film.height,
                               std::vector<double>(pixels_.size(), PixelErrors::kDark)};
    PixelErrors errors = {dark, dark};
    visit_samples(technique, seed,
                  [&]<class Kind>(std::size_t i, const auto&, const auto& shape, const auto& sample, Kind) {
                      const typename Kind::template Reference<Exact> exact(broadcast<Exact>(shape));
                      const Exact measure = exact.measure();
                      if (!(measure > kSmallestMeasure)) return;
                      const Vec2<Exact> u = broadcast<Exact>(random_numbers(i, seed));
                      const Vec3<Exact> wi = normalize(broadcast<Exact>(sample.wi));
                      Exact error = 0;
                      if constexpr (hostile::kTakesPairs<Kind>)
                          error = backward_error(exact, u, wi);
                      else
                          error = backward_error(exact, u.x, wi);
                      // If the zenith is in the light, 0 and 1 are the same azimuth.
                      if (Kind::kCyclic) error = std::min(error, 1 - error);
                      // Nothing explains a result that is NaN or no sample at all.
                      if (!(sample.pdf > 0) || !(error <= 1)) error = 1;
                      errors.backward.values[i] = static_cast<double>(error);
                      errors.area.values[i] = static_cast<double>(error * measure);
                  });
    return errors;
}

} // namespace nusselt::lab
