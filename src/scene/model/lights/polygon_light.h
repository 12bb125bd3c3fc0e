#pragma once
/// Polygonal lights. Their surfaces are triangles of the scene.

#include "scene/model/lights/light_list.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

namespace nusselt::scene {

/// The corners of a polygonal light. Up to four are in place: scenes have millions of triangles and quads that emit.
class PolygonVertices {
public:
    static constexpr std::size_t kCapacity = 8;

    PolygonVertices() = default;
    PolygonVertices(std::initializer_list<Float3> vertices) { assign(vertices.begin(), vertices.end()); }
    PolygonVertices(const std::vector<Float3>& vertices) { assign(vertices.begin(), vertices.end()); }
    PolygonVertices(const PolygonVertices& other) { *this = other; }
    PolygonVertices(PolygonVertices&&) noexcept = default;
    PolygonVertices& operator=(PolygonVertices&&) noexcept = default;
    PolygonVertices& operator=(const PolygonVertices& other);
    ~PolygonVertices() = default;
    /// \throws std::length_error if these are too many
    template <class Iterator>
    void assign(Iterator begin, Iterator end) {
        size_ = 0;
        for (; begin != end; ++begin) push_back(*begin);
    }
    /// \throws std::length_error if it is full
    void push_back(const Float3& vertex);

    std::size_t size() const { return size_; }
    const Float3* begin() const { return many_ != nullptr ? many_->data() : few_.data(); }
    const Float3* end() const { return begin() + size_; }
    Float3* begin() { return many_ != nullptr ? many_->data() : few_.data(); }
    Float3* end() { return begin() + size_; }
    const Float3& operator[](std::size_t i) const { return begin()[i]; }
    Float3& operator[](std::size_t i) { return begin()[i]; }
    /// \throws std::out_of_range
    const Float3& at(std::size_t i) const;
    const Float3& back() const { return begin()[size_ - 1]; }

private:
    std::array<Float3, 4> few_ = {};
    std::uint32_t size_ = 0;
    std::unique_ptr<std::array<Float3, kCapacity>>
        many_; ///< all vertices once there have been more than four
};

/// A convex planar light of 3 to 8 vertices. It emits `radiance` to the side from which the vertices appear
/// counter-clockwise, or to both sides.
struct PolygonLight {
    std::uint32_t emitter = 0; ///< index into Scene::emitters
    std::int32_t texture = -1; ///< index into Scene::emission_textures, -1 for uniform radiance
    PolygonVertices vertices = {};
    Float3 radiance = {0, 0,
                       0}; ///< with a texture the mean over the area, with a profile that over directions
    bool two_sided = false;
    std::int32_t profile =
        -1; ///< index into Scene::emission_profiles, -1 for the same radiance in all directions
};

/// The area of one side [m^2].
double area(const PolygonLight& light);

template <>
struct LightKind<PolygonLight> {
    static constexpr std::string_view kName = "polygon";
    static constexpr std::string_view kNoun = "polygon";
    static constexpr std::string_view kPlural = "polygons";
    static constexpr bool kScalesEvenly = false;
    static constexpr bool kHasBrdfSamples = true;
    static constexpr EmissionQuantity kQuantity = kRadiance;
    static constexpr auto kEmission = &PolygonLight::radiance;
    static void add_to(const PolygonLight& light, Bounds& bounds);
    static void hash(const PolygonLight& light, ContentHash& hash);
    static Double3 flux_per_emission(const PolygonLight& light, double scene_radius);
    static void add_moment(const PolygonLight& light, Moment& moment);
    static bool is_valid(const PolygonLight& light);
    static void transform(PolygonLight& light, const Transform& transform);
    static bool same_shape(const PolygonLight& a, const PolygonLight& b);
    static const bool* two_sided(const PolygonLight& light);
    static void add_mesh(const PolygonLight& light, LightMesh& mesh);
    static void add_surface(const PolygonLight& light, LightSurface& surface);
    static double hit(const PolygonLight& light, const SightRay& ray);
    static std::string describe(std::span<const PolygonLight> lights, double scene_radius);
    static std::string rig_field(const PolygonLight& light);
};

} // namespace nusselt::scene
