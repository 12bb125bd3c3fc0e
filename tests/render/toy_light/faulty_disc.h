#pragma once
/// Discs whose row of the table of kinds is wrong in one place, to show that tests notice.

#include "disc.h"

#include "scene/model/bounds.h"
#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"

#include <limits>
#include <string>

namespace nusselt::scene {

/// The member of the row that is wrong.
enum class Fault {
    bounds,
    hash,
    flux,
    moment,
    validity,
    transform,
    same_shape,
    sides,
    mesh,
    hit,
    description,
    rig_field
};

template <Fault fault>
struct FaultyDisc : DiscLight {};

template <Fault fault>
struct LightKind<FaultyDisc<fault>> : LightKind<DiscLight> {
    using Right = LightKind<DiscLight>;

    static void add_to(const DiscLight& light, Bounds& bounds) {
        if constexpr (fault == Fault::bounds)
            bounds.add(to_double(light.center));
        else
            Right::add_to(light, bounds);
    }
    static void hash(const DiscLight& light, ContentHash& hash) {
        if constexpr (fault == Fault::hash)
            hash.add(light.center);
        else
            Right::hash(light, hash);
    }
    static Double3 flux_per_emission(const DiscLight& light, double scene_radius) {
        const double wrong = light.radius;
        return fault == Fault::flux ? Double3{wrong, wrong, wrong}
                                    : Right::flux_per_emission(light, scene_radius);
    }
    static void add_moment(const DiscLight& light, Moment& moment) {
        if constexpr (fault == Fault::moment)
            moment.add(1, {});
        else
            Right::add_moment(light, moment);
    }
    static bool is_valid(const DiscLight& light) {
        return fault == Fault::validity || Right::is_valid(light);
    }
    static void transform(DiscLight& light, const Transform& transform) {
        if constexpr (fault != Fault::transform) Right::transform(light, transform);
    }
    static bool same_shape(const DiscLight& a, const DiscLight& b) {
        return fault == Fault::same_shape || Right::same_shape(a, b);
    }
    /// Has a second side that emits nothing.
    static const bool* two_sided(const DiscLight& light) {
        static bool is_two_sided = false;
        return fault == Fault::sides ? &is_two_sided : Right::two_sided(light);
    }
    static void add_mesh(const DiscLight& light, LightMesh& mesh) {
        if constexpr (fault != Fault::mesh) Right::add_mesh(light, mesh);
    }
    static double hit(const DiscLight& light, const SightRay& ray) {
        return fault == Fault::hit ? std::numeric_limits<double>::infinity() : Right::hit(light, ray);
    }
    static std::string describe(std::span<const FaultyDisc<fault>> lights, double scene_radius) {
        const DiscLight& first = lights.front();
        return fault == Fault::description ? "" : Right::describe(std::span(&first, 1), scene_radius);
    }
    static std::string rig_field(const DiscLight& light) {
        return fault == Fault::rig_field ? "disc" : Right::rig_field(light);
    }
};

} // namespace nusselt::scene
