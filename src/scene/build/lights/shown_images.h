#pragma once
/// What polygonal lights show of images.

#include "scene/model/lights/textured_emission.h"

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace nusselt::scene {

/// Texture coordinates of a vertex.
struct TexturePoint {
    double x = 0, y = 0;

    bool operator==(const TexturePoint&) const = default;
};

/// What a polygon shows of an image.
struct ShownImage {
    TexturedEmission emission; ///< without a texture if the polygon has the mean everywhere
    bool is_far =
        false; ///< whether that is so because it shows too many repetitions of the edge of the image
};

/// Crops an image to a polygon. Where texture coordinates hardly change, the polygon shows the mean.
/// \param corners an affine function of the vertices, at most 8
ShownImage show_image(const std::shared_ptr<const EmissionTexture>& image,
                      std::span<const TexturePoint> corners);

/// The parts of images that lights of one scene showed last. Lights that show the same part share it, and it is prepared once:
/// many scenes have thousands of copies of one light. Threads may use it together.
class ShownImages {
public:
    /// As show_image().
    ShownImage show(const std::shared_ptr<const EmissionTexture>& image,
                    std::span<const TexturePoint> corners);

private:
    struct Entry {
        std::shared_ptr<const EmissionTexture> image;
        std::vector<TexturePoint> corners;
        ShownImage shown;
    };
    /// Null if it is not kept. The caller holds the lock.
    const Entry* find(const std::shared_ptr<const EmissionTexture>& image,
                      std::span<const TexturePoint> corners) const;

    /// So few that parts which no light keeps take little memory.
    static constexpr std::size_t kKept = 64;

    std::mutex mutex_;
    std::array<Entry, kKept> last_;
    std::size_t next_ = 0; ///< that is replaced
};

} // namespace nusselt::scene
