#pragma once
/// FLIP, an estimate of the difference that people see when they alternate between two images:
/// - P. Andersson et al. 2020, FLIP: A Difference Evaluator for Alternating Images, doi:10.1145/3406183
/// - P. Andersson et al. 2021, Visualizing Errors in Rendered High Dynamic Range Images, doi:10.2312/egs.20211015

#include "image/image.h"
#include "image/planes.h"

namespace nusselt::image {

/// A screen of 3840 pixels and 0.7 m width at a distance of 0.7 m, the default of the papers.
inline constexpr double kFlipPixelsPerDegree = 67.0206432765823;

/// The larger, the wider the filters: 1000 would see details of a 15th of a pixel on an ordinary screen.
inline constexpr double kFlipMaxPixelsPerDegree = 1000;

/// FLIP of two displayed images, per pixel in [0, 1]: linear values are multiplied by 2^exposure and clamped to
/// [0, 1]. Pixels that are invalid (NaN or infinite) in either image are black in both.
/// \param pixels_per_degree  of the field of vision, in (0, kFlipMaxPixelsPerDegree]
/// \param exposure           in stops, finite
/// \throws std::runtime_error  if the sizes differ
[[nodiscard]] Plane flip(const Image& a, const Image& reference,
                         double pixels_per_degree = kFlipPixelsPerDegree, double exposure = 0);

/// Exposures in stops at which hdr_flip() looks.
struct FlipExposures {
    double first = 0;
    double last = 0;
    int count = 2; ///< equidistant, with the first and the last
};

/// The range of exposures of the paper: from that where the brightest pixel of the reference is mapped to 0.85
/// by the tone mapping to that where the median luminance is. Luminances are clamped to [2^-24, 2^16], so that
/// black references have a range as well. Invalid pixels are left out.
[[nodiscard]] FlipExposures flip_exposures(const Image& reference);

/// The largest FLIP of the images after exposure and tone mapping with an approximation of ACES
/// (K. Narkowicz 2016, https://knarkowicz.wordpress.com/2016/01/06/aces-filmic-tone-mapping-curve/), over the
/// exposures. Negative values become 0, values above 2^16 that.
/// \throws std::runtime_error  if the sizes differ
[[nodiscard]] Plane hdr_flip(const Image& a, const Image& reference, const FlipExposures& exposures,
                             double pixels_per_degree = kFlipPixelsPerDegree);

/// Mean of a map over the pixels that are valid in both images, NaN if there are none.
[[nodiscard]] double mean_of_valid(const Plane& map, const Image& a, const Image& reference);

} // namespace nusselt::image
