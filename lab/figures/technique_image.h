#pragma once
/// Images by any technique of the registry, also by published methods that the renderer does not offer.

#include "image/image.h"
#include "render_cpu/renderer.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace nusselt::lab {

/// What the pixels of an image see, found once for all techniques. Camera rays go through the centres of pixels.
class TechniqueImages {
public:
    /// \param scene    with one light, a quadrilateral or a linear light, and without textures, bump maps and instances.
    ///                 Must outlive the object.
    /// \param renderer of the scene, must outlive the object
    /// \throws std::invalid_argument for other scenes
    TechniqueImages(const scene::Scene& scene, const render_cpu::Renderer& renderer);
    ~TechniqueImages();

    /// Direct light with one sample per pixel. Where the technique returns NaN or an infinity, so does the pixel.
    /// Random numbers are those of the renderer.
    /// \param technique class name out of techniques.json, for lights of this kind
    /// \throws std::invalid_argument for other techniques
    image::Image render(const std::string& technique, std::uint32_t seed) const;

private:
    struct Pixel;

    const scene::Scene& scene_;
    visibility::RayTracer tracer_;
    std::vector<Pixel> pixels_;
};

/// Whether the scene is one that TechniqueImages takes.
bool has_one_light(const scene::Scene& scene);

} // namespace nusselt::lab
