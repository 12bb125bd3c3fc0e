#pragma once
/// Images by any technique of the registry, also by published methods that the renderer does not offer.

#include "image/image.h"
#include "image/planes.h"
#include "render_cpu/renderer.h"
#include "scene/model/scene.h"

#include <nusselt/core/vec.h>

#include <cstdint>
#include <string>
#include <vector>

namespace nusselt::lab {

/// The errors of one sample in each pixel, from left to right and top to bottom.
struct PixelErrors {
    /// Stands for pixels without a surface, or with no light above its horizon.
    static constexpr double kDark = -1;

    image::Plane backward; ///< 1 where a result is NaN or there is no sample
    image::Plane area;     ///< times the measure of the light: the error of the area up to the sample [sr]
};

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
    /// \param technique class name out of techniques.json, for lights of this kind, of a technique or of the published
    ///                  formulas that it replaces
    /// \throws std::invalid_argument for other techniques
    image::Image render(const std::string& technique, std::uint32_t seed) const;

    /// Backward errors of the samples of render() against the exact technique in long double.
    /// \throws std::invalid_argument see render()
    PixelErrors backward_errors(const std::string& technique, std::uint32_t seed) const;

private:
    struct Pixel;

    Vec2<float> random_numbers(std::size_t pixel, std::uint32_t seed) const;

    /// Calls visit(pixel, light of the scene, light in shading space, sample, kind of technique), in parallel.
    template <class Visit>
    void visit_samples(const std::string& technique, std::uint32_t seed, const Visit& visit) const;

    const scene::Scene& scene_;
    visibility::RayTracer tracer_;
    std::vector<Pixel> pixels_;
};

/// Whether the scene is one that TechniqueImages takes.
bool has_one_light(const scene::Scene& scene);

} // namespace nusselt::lab
