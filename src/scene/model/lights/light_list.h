#pragma once
/// Lights of any kind. Code that is not about a certain kind asks lists of lights, and the row of the kind answers: a
/// specialisation of LightKind.

#include "scene/model/float3.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nusselt::scene {

struct Bounds;
struct LightMesh;
struct LightSurface;
struct Moment;
struct SightRay;
struct Transform;
class ContentHash;

/// The quantity by which lights of a kind tell how bright they are. Light rigs have a field of this name.
struct EmissionQuantity {
    std::string_view name;
    std::string_view unit;
    bool operator==(const EmissionQuantity&) const = default;
};
inline constexpr EmissionQuantity kRadiance = {"radiance", "W/(sr m^2)"}; ///< of surfaces
inline constexpr EmissionQuantity kIntensity = {"intensity", "W/sr"};     ///< of points
inline constexpr EmissionQuantity kIrradiance = {"irradiance",
                                                 "W/m^2"}; ///< of parallel light, normal to its direction
inline constexpr EmissionQuantity kEmissionQuantities[] = {kRadiance, kIntensity, kIrradiance};

/// The row of a kind of light. `Light` is plain data with the member `emitter`, an index into Scene::emitters. The functions
/// of a row take one light, except for describe():
///
///     static constexpr std::string_view kName: as in "2 polygon lights";
///     static constexpr std::string_view kNoun: as in "is a tube";
///     static constexpr std::string_view kPlural: as in "2 polygons";
///     static constexpr bool kScalesEvenly: whether a transform must scale all axes alike;
///     static constexpr bool kHasBrdfSamples: whether samples of the BRDF can hit it;
///     static constexpr EmissionQuantity kQuantity: the quantity of its emission;
///     static constexpr Float3 Light::*kEmission: the member with its emission;
///     add_to(light, Bounds&), hash(light, ContentHash&);
///     Double3 flux_per_emission(light, double scene_radius): the power of all sides in each channel for an emission of 1;
///     add_moment(light, Moment&): weighted by areas; lights without area count as 1;
///     bool is_valid(light): whether renderers can work with its shape;
///     transform(Light&, transform): affine;
///     bool same_shape(light, light): whether both have the same place and shape;
///     const bool* two_sided(light): whether it emits to both sides, null for kinds with one side;
///     add_mesh(light, LightMesh&): what cameras see of it, nothing for surfaces of the scene;
///     add_surface(light, LightSurface&): its surface, only for kinds whose lights are surfaces of the scene;
///     double hit(light, SightRay): the parameter at which the ray meets it, infinite for a miss;
///     std::string describe(std::span<const Light>, double scene_radius): reports on lights of one emitter;
///     std::string rig_field(light): its shape as a field of a light rig, `"name": value`; empty if there is none.
template <class Light>
struct LightKind;

/// The lights of one kind.
class LightList {
public:
    virtual ~LightList() = default;
    virtual std::unique_ptr<LightList> copy() const = 0;
    /// A list of the same kind without lights.
    virtual std::unique_ptr<LightList> empty_list() const = 0;
    /// Takes the lights of another list of this kind.
    virtual void append(LightList&& others) = 0;
    /// Takes the memory for this many lights in all.
    virtual void reserve(std::size_t count) = 0;
    virtual void clear() = 0;

    virtual std::string_view name() const = 0;
    virtual std::string_view noun() const = 0;
    virtual std::string_view plural() const = 0;
    virtual bool scales_evenly() const = 0;
    virtual bool has_brdf_samples() const = 0;
    virtual const EmissionQuantity& quantity() const = 0;
    virtual std::size_t size() const = 0;
    virtual std::size_t bytes() const = 0;
    virtual void add_to(Bounds& bounds) const = 0;
    virtual void hash(ContentHash& hash) const = 0;
    virtual void add_to(Moment& moment) const = 0;
    virtual void transform(const Transform& transform) = 0;

    virtual const std::uint32_t& emitter(std::size_t i) const = 0;
    virtual const Float3& emission(std::size_t i) const = 0;
    /// \param scene_radius see Scene::radius
    virtual Double3 flux_per_emission(std::size_t i, double scene_radius) const = 0;
    virtual bool is_valid(std::size_t i) const = 0;
    /// Whether a light has the same kind, place and shape as one of another list.
    virtual bool same_shape(std::size_t i, const LightList& others, std::size_t k) const = 0;
    virtual const bool* two_sided(std::size_t i) const = 0;
    virtual void add_mesh(std::size_t i, LightMesh& mesh) const = 0;
    /// Whether lights of this kind are surfaces of the scene.
    virtual bool is_surface() const = 0;
    /// What rigs add to the scene for such a light.
    virtual void add_surface(std::size_t i, LightSurface& surface) const = 0;
    virtual double hit(std::size_t i, const SightRay& ray) const = 0;
    virtual std::string describe(std::size_t begin, std::size_t end, double scene_radius) const = 0;
    virtual std::string rig_field(std::size_t i) const = 0;
    /// Adds one of the lights to a list of the same kind.
    virtual void copy_to(LightList& others, std::size_t i) const = 0;

    std::uint32_t& emitter(std::size_t i) {
        return const_cast<std::uint32_t&>(std::as_const(*this).emitter(i));
    }
    Float3& emission(std::size_t i) { return const_cast<Float3&>(std::as_const(*this).emission(i)); }
    bool* two_sided(std::size_t i) { return const_cast<bool*>(std::as_const(*this).two_sided(i)); }
};

} // namespace nusselt::scene
