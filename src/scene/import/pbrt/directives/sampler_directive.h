#pragma once
/// pbrt's sampler directive.

#include "scene/import/pbrt/syntax/parameters.h"

#include <optional>
#include <string_view>

namespace nusselt::scene {

/// The number of samples per pixel, if the directive gives one. All samplers of pbrt have it as "pixelsamples", but
/// "stratified" as the product of "xsamples" and "ysamples". A number that is not positive is ignored with a warning, as are
/// parameters without a meaning for the sampler.
std::optional<int> read_pixel_samples(std::string_view type, ParameterList& parameters, Warnings& warnings);

} // namespace nusselt::scene
