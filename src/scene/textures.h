#pragma once
/// Texture directives and image files.

#include "scene/parameters.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::scene {

enum class TexelEncoding { srgb, linear };

/// Which file to decode and how: texel <- max(0, 1 - scale * texel) if inverted, else the texel as it is.
struct ImageRequest {
    std::filesystem::path path;
    TexelEncoding encoding = TexelEncoding::srgb;
    bool inverted = false;
    float inverted_scale = 1;
    Location location; ///< of the directive that asked first
};

/// Decodes TGA, JPEG, PNG and BMP (8 bits; sRGB to linear by table) and Radiance HDR (linear).
/// Throws SceneError with the reason.
Texture decode_image(const ImageRequest& request);

/// What a texture reduces to: a colour, multiplied by an image if `image` is not -1.
struct TextureValue {
    Float3 factor = {1, 1, 1};
    int image = -1; ///< index of an ImageRequest
};

/// The named textures of a scene.
class TextureTable {
public:
    /// Reduces a Texture directive; docs/materials.md has the rules.
    /// \param image_path  of the file that the parameter "filename" names; unused if there is none
    void define(const std::string& name, std::string_view texture_class, ParameterList& parameters,
                const std::filesystem::path& image_path, Warnings& warnings);

    /// Throws SceneError at `location` if there is no texture of this name.
    const TextureValue& value(const std::string& name, const Location& location) const;
    const std::vector<ImageRequest>& requests() const { return requests_; }

private:
    TextureValue reduce_image(const std::string& name, ParameterList& parameters,
                              const std::filesystem::path& path, Warnings& warnings);
    TextureValue reduce_scale(ParameterList& parameters, Warnings& warnings) const;
    TextureValue reduce_mix(ParameterList& parameters, Warnings& warnings) const;
    TextureValue reduce_checkerboard(ParameterList& parameters, Warnings& warnings) const;
    TextureValue input(std::string_view name, float fallback, ParameterList& parameters,
                       Warnings& warnings) const;
    int request_index(const ImageRequest& request);

    std::map<std::string, TextureValue, std::less<>> values_;
    std::vector<ImageRequest> requests_;
};

} // namespace nusselt::scene
