#pragma once
/// Errors of images as a display shows them: values times 2^exposure, clamped to [0, 1], with the transfer
/// function of sRGB, not rounded to 8 bits.

#include "image/image.h"

namespace nusselt::image {

/// Peak signal to noise ratio: -10 log10(MSE of the displayed values), in decibels; the peak is 1.
/// \param exposure  in stops, finite
/// \returns infinity for equal images, NaN if no pixel is valid in both
/// \throws std::runtime_error  if the sizes differ
[[nodiscard]] double psnr(const Image& a, const Image& reference, double exposure = 0);

/// Mean structural similarity of Z. Wang et al. 2004, Image Quality Assessment: From Error Visibility to
/// Structural Similarity, doi:10.1109/TIP.2003.819861, with the constants of the paper: windows of 11 x 11
/// pixels with Gaussian weights (standard deviation 1.5), K1 = 0.01, K2 = 0.03, range 1; the mean is over all
/// windows inside the image. It works on the luma 0.299 R + 0.587 G + 0.114 B of the displayed values.
/// Pixels that are invalid in either image are black in both; windows around them are left out.
/// \param exposure  in stops, finite
/// \returns 1 for equal images; NaN for images of less than 11 pixels in width or height, or without any
///          window around a valid pixel
/// \throws std::runtime_error  if the sizes differ
[[nodiscard]] double ssim(const Image& a, const Image& reference, double exposure = 0);

} // namespace nusselt::image
