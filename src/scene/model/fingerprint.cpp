#include "scene/model/fingerprint.h"

#include "scene/model/content_hash.h"
#include "scene/model/profiles/emission_profile.h"

#include <cstdio>
#include <string>
#include <type_traits>

// Members are listed by structured bindings: a new member does not compile until it is listed here.

namespace nusselt::scene {

template <>
inline constexpr bool kIsPlain<Triangle> = true;
template <>
inline constexpr bool kIsPlain<std::array<float, 12>> = true;

namespace {

class Fingerprint {
public:
    std::uint64_t value() const { return hash_.value(); }

    template <class... Values>
    void add_all(const Values&... values) {
        (add(values), ...);
    }

    template <class T>
    requires kIsPlain<T> void add(const T& value) {
        hash_.add_bytes(&value, sizeof value);
    }

    void add(const std::string& text) { hash_.add_bytes(text.data(), text.size()); }

    template <class T>
    void add(const std::vector<T>& values) {
        if constexpr (kIsPlain<T>) {
            hash_.add_bytes(values.data(), values.size() * sizeof(T));
        } else {
            add(values.size());
            for (const T& value : values) add(value);
        }
    }

    template <class T>
    void add(const std::optional<T>& value) {
        add(value.has_value());
        if (value) add(*value);
    }

    void add(const Texture& texture) {
        const auto& [name, width, height, texels, channels, wrap, filter, path] = texture;
        add_all(width, height, texels, channels, wrap, filter);
    }

    void add(const TextureUse& use) {
        const auto& [texture, scale, offset] = use;
        add_all(texture, scale, offset);
    }

    void add(const Material& material) {
        const auto& [name, model, diffuse, diffuse_texture, f0, f0_texture, roughness, roughness_texture,
                     exponent, alpha, alpha_texture, bump, bump_texture, bump_unit, normal_texture] =
            material;
        add_all(model, diffuse, diffuse_texture, f0, f0_texture, roughness, roughness_texture, exponent,
                alpha, alpha_texture, bump, bump_texture, bump_unit, normal_texture);
    }

    void add(const Emitter& emitter) { [[maybe_unused]] const auto& [name] = emitter; }

    void add(const Lights& lights) {
        for (const LightList& list : lights) {
            add(list.size());
            list.hash(hash_);
        }
    }

    void add(const TexturedEmission& emission) {
        const auto& [texture, coordinates, mean, part_begin, part_end, largest] = emission;
        const auto& [name, width, height, texels, path] = *texture;
        add_all(width, height, texels, mean);
        for (const Float2& at : coordinates) add(at);
    }

    void add(const Double3& v) { add_all(v.x, v.y, v.z); }

    void add(const std::shared_ptr<const Luminaire>& luminaire) {
        add(luminaire != nullptr);
        if (luminaire == nullptr) return;
        const auto& [vertical, horizontal, candelas] = luminaire->profile.table();
        add_all(vertical, horizontal, candelas);
    }

    void add(const ProfiledEmission& emission) {
        const auto& [profile, x_axis, z_axis, mean] = emission;
        const auto& [luminaire, spread, honeycomb, faces, round, lost] = *profile;
        add_all(luminaire, spread, honeycomb.along, honeycomb.across, x_axis, z_axis, mean, round.axis,
                round.area, faces.size());
        for (const LuminousFace& face : faces) add_all(face.normal, face.area);
    }

    void add(const std::shared_ptr<const EnvironmentMapTexels>& map) {
        const auto& [name, size, texels, mean, path, largest] = *map;
        add_all(size, texels, mean);
    }

    void add(const Object& object) {
        const auto& [name, first_triangle, triangle_count] = object;
        add_all(first_triangle, triangle_count);
    }

    void add(const Instance& instance) {
        const auto& [object, world_from_object] = instance;
        add_all(object, world_from_object);
    }

    void add(const Camera& camera) {
        const auto& [origin, origin_right, origin_down, corner, right, down] = camera;
        add_all(origin, origin_right, origin_down, corner, right, down);
    }

    void add(const PixelBounds& bounds) {
        const auto& [x_begin, y_begin, x_end, y_end] = bounds;
        add_all(x_begin, y_begin, x_end, y_end);
    }

    void add(const PixelFilter& filter) {
        const auto& [kind, radius_x, radius_y, sigma, b, c] = filter;
        add_all(kind, radius_x, radius_y, sigma, b, c);
    }

    void add(const Film& film) {
        const auto& [width, height, crop, filter, filename, pixel_samples] = film;
        add_all(width, height, crop, filter);
    }

    void add(const Scene& scene) {
        const auto& [positions, normals, uvs, triangles, triangle_material, triangle_light, objects,
                     instances, materials, textures, emitters, lights, emission_textures, emission_profiles,
                     luminaires, environment_maps, camera, film, files, warnings, radius] = scene;
        add_all(positions, normals, uvs, triangles, triangle_material, triangle_light, objects, instances,
                materials, textures, emitters, lights, emission_textures, emission_profiles, luminaires,
                environment_maps, camera, film, radius);
    }

private:
    ContentHash hash_;
};

} // namespace

std::string fingerprint(const Scene& scene) {
    Fingerprint result;
    result.add(scene);
    std::array<char, 17> text;
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(result.value()));
    return text.data();
}

} // namespace nusselt::scene
