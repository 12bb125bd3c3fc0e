#pragma once
/// Pictures of the difference between two images.

#include "image/image.h"
#include "image/planes.h"

namespace nusselt::image {

/// The scale at which signed_difference_image() shows most of the range: the 99th percentile over all pixels
/// of the largest |a - b| among the channels. If that is 0, the largest difference; if that is 0 as well, 1.
/// Pixels that are NaN or infinite in either image are left out.
/// \throws std::runtime_error  if the sizes differ
[[nodiscard]] double difference_scale(const Image& a, const Image& reference);

/// A false colour image of a - b, in linear RGB (so that writing it as PNG gives the intended colours). Shown
/// is, with its sign, the difference in that channel where it is largest, so that a shift of hue does not
/// cancel. Blue is negative (a is too dark), white is zero, red is positive (a is too bright). The colours
/// lie on two straight lines in Oklab with equal lightness on both sides, so that equal errors look equally
/// strong. Pixels that are NaN or infinite in either image are black.
/// \param scale  difference that gets the full colour, positive; beyond it the colour stays
/// \throws std::runtime_error  if the sizes differ
[[nodiscard]] Image signed_difference_image(const Image& a, const Image& reference, double scale);

/// |a - b| / scale in each channel. Pixels that are NaN or infinite in either image are black.
/// \param scale  difference that becomes 1, positive
/// \throws std::runtime_error  if the sizes differ
[[nodiscard]] Image absolute_difference_image(const Image& a, const Image& reference, double scale);

/// An error map in [0, 1] in false colours, in linear RGB: from black over purple, red and orange to a light
/// yellow. Lightness in Oklab grows linearly with the error.
[[nodiscard]] Image error_map_image(const Plane& map);

} // namespace nusselt::image
