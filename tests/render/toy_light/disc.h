#pragma once
/// A kind of light for tests: round, one-sided, sampled by its area. It shows what another kind takes: this folder, and a
/// row in the table of kernels.

#include "render_cpu/lights/light_kernel.h"
#include "scene/model/lights/lights.h"
#include "scene/model/scene.h"

#include <vector>

namespace nusselt::scene {

/// Emits to the side of its normal.
struct DiscLight {
    std::uint32_t emitter = 0;
    Float3 center = {0, 0, 0};
    Float3 normal = {0, 0, 1}; ///< unit
    float radius = 0;
    Float3 radiance = {0, 0, 0};
};

template <>
struct LightKind<DiscLight> {
    static constexpr std::string_view kName = "disc";
    static constexpr std::string_view kNoun = "disc";
    static constexpr std::string_view kPlural = "discs";
    static constexpr bool kScalesEvenly = true;
    static constexpr bool kHasBrdfSamples = false;
    static void add_to(const DiscLight& light, Bounds& bounds);
    static void hash(const DiscLight& light, ContentHash& hash);
    static double emitting_area(const DiscLight& light);
    static void add_moment(const DiscLight& light, Moment& moment);
    static bool is_valid(const DiscLight& light);
    static void transform(DiscLight& light, const Transform& transform);
    static bool same_shape(const DiscLight& a, const DiscLight& b);
    static const bool* two_sided(const DiscLight& light);
    static void add_mesh(const DiscLight& light, LightMesh& mesh);
    static double hit(const DiscLight& light, const SightRay& ray);
    static std::string describe(std::span<const DiscLight> lights);
    static std::string rig_field(const DiscLight& light);
};

} // namespace nusselt::scene

namespace nusselt::render_cpu {

// In disc_kernel.cpp.
LightCode disc_code(LaneCount<4>), disc_code(LaneCount<8>), disc_code(LaneCount<16>);

inline scene::DiscLight disc_record(const scene::DiscLight& light) { return light; }

/// The kernels of the renderer and that of discs.
inline std::vector<LightKernel> kernels_with_discs() {
    std::vector<LightKernel> kernels(light_kernels().begin(), light_kernels().end());
    kernels.push_back({make_record_array<scene::DiscLight, disc_record>,
                       {disc_code(LaneCount<4>()), disc_code(LaneCount<8>()), disc_code(LaneCount<16>())}});
    return kernels;
}

} // namespace nusselt::render_cpu
