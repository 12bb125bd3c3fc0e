#pragma once
/// The textures of polygonal lights, prepared for kernels.

#include "render_cpu/lights/polygon_records.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <memory>
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

    std::vector<std::unique_ptr<Prepared>> prepared_;
    std::vector<PolygonTexture> records_;
};

} // namespace nusselt::render_cpu
