#pragma once
/// A test that finds out whether a renderer has the right mean, from images with independent random numbers.

#include "image/image.h"

#include <cstddef>
#include <vector>

namespace nusselt::lab {

/// Mean and variance over frames of the averages of the square cells of an image, each colour channel for itself.
class CellStatistics {
public:
    /// \param side of the cells in pixels, at least 1; those at the right and at the bottom may be smaller.
    explicit CellStatistics(int side) : side_(side) {}

    /// \param frame of the same size as those before.
    void add(const image::Image& frame);

    /// The distance between the means of two renderers in standard deviations, for each cell and channel: Welch's t,
    /// brought to a normal distribution. Cells without noise are left out unless they differ. Cells darker than a
    /// hundredth of the image are taken together. Differences below 1e-5 of the mean are taken for rounding.
    /// \param other with cells of the same side, of images of the same size; both with at least two frames.
    std::vector<double> z_scores(const CellStatistics& other) const;

private:
    /// \param i cell and channel, an index into mean_.
    double variance_of_mean(std::size_t i) const;

    int side_;
    int frames_ = 0;
    std::vector<double> mean_;
    std::vector<double> squares_; ///< sum of squared deviations from the mean
};

/// Statistics that are approximately normal if the means agree: standard deviations from what is to be expected.
struct BiasTest {
    double frame = 0;        ///< the largest one of the channels of the mean over the image
    double largest_cell = 0; ///< the largest one of cells of 16 x 16 pixels
    double chi_square = 0;   ///< sum of squares over these cells
    int cells = 0;           ///< their number, times channels
    double pixels_beyond_three =
        0; ///< share of pixels; 0.0027 if their noise were normal. Not tested: it is not.

    /// Whether all of them are as likely as 1 in 1000, after correction for the number of tests.
    bool passes() const;
};

/// Collects frames of one renderer.
class BiasStatistics {
public:
    void add(const image::Image& frame);

    /// \param reference statistics of a renderer that is known to be right, see CellStatistics::z_scores().
    BiasTest compare(const BiasStatistics& reference) const;

private:
    CellStatistics pixels_{1};
    CellStatistics cells_{16};
    CellStatistics frame_{1 << 20};
};

} // namespace nusselt::lab
