#pragma once
/// The textures of polygonal lights, prepared for kernels, once for all lights that show the same.

#include "render_cpu/lights/polygon_records.h"
#include "scene/model/scene.h"

#include <nusselt/core/vec.h>

#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace nusselt::render_cpu {

class PolygonTextures {
public:
    PolygonTextures();
    PolygonTextures(const PolygonTextures&) = delete;
    PolygonTextures& operator=(const PolygonTextures&) = delete;
    ~PolygonTextures();

    /// Prepares the texture of a light that has one. \returns the index of its record
    std::int32_t add(const scene::Scene& scene, const scene::PolygonLight& light);
    /// Valid until the next call of add().
    const PolygonTexture* records() const { return records_.data(); }

private:
    struct Prepared;
    using Texels = std::vector<Vec3<float>>;
    /// A texture and the radiance of a texel of 1.
    using TexelKey = std::tuple<const scene::EmissionTexture*, float, float, float>;
    /// Texels and the outline of a light in them.
    using LightKey = std::pair<const Texels*, std::vector<float>>;

    // Equal lights share what is prepared.
    std::map<TexelKey, Texels> texels_;
    std::map<LightKey, Prepared> prepared_;
    std::vector<PolygonTexture> records_;
};

} // namespace nusselt::render_cpu
