#pragma once
/// Reads image files as textures.

#include "scene/build/limits.h"
#include "scene/input/diagnostics.h"
#include "scene/model/scene.h"

#include <compare>
#include <filesystem>

namespace nusselt::scene {

/// The file to decode, and the curve for integers in it.
struct ImageRequest {
    /// 0 for the curve of sRGB, else the exponent that makes codes from 0 to 1 linear.
    using Encoding = double;
    static constexpr Encoding kSrgb = 0;
    static constexpr Encoding kLinear = 1;

    std::filesystem::path path;
    Encoding encoding = kSrgb;
    Location location; ///< of the first request
};

/// Decodes PNG (8 and 16 bits), JPEG, TGA and BMP by `encoding`, and HDR, EXR and PFM, which are linear. The format is
/// that of the contents, that of EXR and PFM follows from the extension. Results have 1, 3 or 4 channels; the fourth is
/// the (linear) alpha of files that have one which is not 1 everywhere. Negative texels, and those that are not finite,
/// become 0 with a warning. The alpha of EXR files is ignored. Throws SceneError with the reason; images that claim more
/// texels than their file holds, or more than the budget has left, are refused before memory is allocated for them.
Texture decode_image(const ImageRequest& request, SceneBudget& budget, Warnings& warnings);

} // namespace nusselt::scene
