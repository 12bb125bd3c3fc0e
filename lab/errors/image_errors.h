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
    std::int64_t invalid_pixels = 0;
};

/// Collects frames. Pixels that are NaN or infinite count as invalid, and nowhere else.
class ImageErrorSums {
public:
    /// \param reference, outside_penumbrae, insets must outlive the object.
    /// \param outside_penumbrae whether the pixels, from left to right and top to bottom, are.
    ImageErrorSums(const image::Image& reference, const std::vector<bool>& outside_penumbrae,
                   const std::vector<Inset>& insets);

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
    Sums frame_, outside_;
    std::vector<Sums> in_insets_;
    std::int64_t invalid_pixels_ = 0;
};

/// Mean over all pixels and channels of two images of one size.
double mean_square_difference(const image::Image& a, const image::Image& b);

/// Mean over all pixels and channels.
double mean_radiance(const image::Image& image);

} // namespace nusselt::lab
