#pragma once
/// Errors of images against a reference, over all frames of a variant.

#include "image/image.h"
#include "lab/figures/image_comparison.h"

#include <cstdint>
#include <vector>

namespace nusselt::lab {

/// The errors of the whole image or of an inset.
struct RegionErrors {
    double rmse = 0;
    double rmse_clamped = 0;  ///< see Measure::rmse_clamped
    double relative_rmse = 0; ///< over the mean radiance of the reference in the region
    double relative_bias = 0; ///< difference of the mean radiances, over that of the reference
};

struct ImageErrors {
    RegionErrors frame;
    std::vector<RegionErrors> insets;  ///< in the order of ImageComparison::insets
    double rmse_outside_penumbrae = 0; ///< see Measure::rmse_outside_penumbrae
    double rmse_in_penumbrae = 0;      ///< see Measure::rmse_in_penumbrae
    double rmse_blurred = 0;           ///< see Measure::rmse_blurred; NaN without a blur
    std::int64_t invalid_pixels = 0;
};

/// An image after a Gaussian blur: what is left of its errors are low frequencies. At the border, the pixels that there are
/// count. Pixels that are NaN or infinite make their surroundings so.
/// \param deviation standard deviation of the Gaussian [pixels], > 0.
image::Image blurred(const image::Image& image, double deviation);

/// Collects frames. Pixels that are NaN or infinite count as invalid, and nowhere else.
class ImageErrorSums {
public:
    /// \param reference, outside_penumbrae, insets must outlive the object.
    /// \param outside_penumbrae whether the pixels, from left to right and top to bottom, are.
    /// \param blur standard deviation of the Gaussian for ImageErrors::rmse_blurred [pixels]; 0: none.
    ImageErrorSums(const image::Image& reference, const std::vector<bool>& outside_penumbrae,
                   const std::vector<Inset>& insets, double blur = 0);

    /// \param frame of the size of the reference.
    void add(const image::Image& frame);

    /// Means over what was added; NaN where nothing was.
    ImageErrors errors() const;

private:
    struct Sums {
        double squares = 0;
        double clamped_squares = 0;
        double differences = 0;
        double reference = 0;
        double count = 0; ///< of channels

        void add(const Sums& part);
        RegionErrors errors() const;
    };

    const image::Image& reference_;
    const std::vector<bool>& outside_penumbrae_;
    const std::vector<Inset>& insets_;
    double blur_;
    image::Image blurred_reference_; ///< empty without a blur
    Sums frame_, outside_, inside_;
    double blurred_squares_ = 0; ///< mean over an image, summed over frames
    int frames_ = 0;
    std::vector<Sums> in_insets_;
    std::int64_t invalid_pixels_ = 0;
};

/// Mean over all pixels and channels of two images of one size.
double mean_square_difference(const image::Image& a, const image::Image& b);

/// Mean over all pixels and channels.
double mean_radiance(const image::Image& image);

} // namespace nusselt::lab
