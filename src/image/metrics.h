#pragma once
/// Metrics for the difference between an image and a reference.

#include "image/image.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nusselt::image {

/// A pixel with a channel that is NaN or infinite.
struct InvalidPixel {
    int x = 0;
    int y = 0;
    std::array<float, 3> rgb = {};
};

/// The invalid pixels of one image.
struct InvalidPixels {
    std::int64_t count = 0;          ///< pixels with at least one channel that is NaN or infinite
    std::int64_t nan_count = 0;      ///< those among them with at least one NaN
    std::vector<InvalidPixel> first; ///< at most kListedInvalidPixels, from top to bottom, left to right
};

inline constexpr std::size_t kListedInvalidPixels = 10;

/// Added to the squared reference in the denominators of the relative errors, so that black pixels count, but
/// do not dominate.
inline constexpr double kRelativeMseEpsilon = 0.01;

/// All averages run over the three channels of the pixels that are valid in both images, that of mrse over
/// these pixels. They are NaN if there are no such pixels.
struct Comparison {
    double mse = 0;           ///< mean of (a - b)^2
    double rmse = 0;          ///< square root of mse
    double relative_rmse = 0; ///< rmse / |mean_b|; 0 if rmse is 0, else infinite for a black reference
    double mae = 0;           ///< mean of |a - b|
    /// Mean of (a - b)^2 / (b^2 + kRelativeMseEpsilon), each channel on its own: errors in a channel where a
    /// saturated colour is dark count much (F. Rousselle et al. 2011, Adaptive Sampling and Reconstruction
    /// using Greedy Error Minimization, doi:10.1145/2024156.2024193).
    double rel_mse = 0;
    /// Mean over the pixels of |a - b|^2 / (|b|^2 + kRelativeMseEpsilon), colours as vectors: the hue of the
    /// reference does not matter.
    double mrse = 0;
    double mean_a = 0;
    double mean_b = 0;
    std::int64_t compared_pixels = 0; ///< valid in both images
    InvalidPixels invalid_a;
    InvalidPixels invalid_b;
};

/// Compares image a with a reference b in double precision.
/// \throws std::runtime_error  naming both sizes, if they differ
[[nodiscard]] Comparison compare(const Image& a, const Image& reference);

/// Share of pixels with a channel that differs from the reference by more than a tolerance. Values that are not finite
/// differ.
/// \param tolerance of the value in the reference.
/// \param darkest   where the reference is darker than this share of its mean, the tolerance is that of this share.
/// \throws std::runtime_error  naming both sizes, if they differ
[[nodiscard]] double differing_share(const Image& a, const Image& reference, double tolerance,
                                     double darkest);

/// \throws std::runtime_error  naming both sizes, if they differ
void require_same_size(const Image& a, const Image& reference);

/// Whether none of the three channels of the pixel that starts here is NaN or infinite.
[[nodiscard]] bool is_valid_pixel(const float* rgb);

} // namespace nusselt::image
