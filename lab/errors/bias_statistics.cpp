#include "lab/errors/bias_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace nusselt::lab {

namespace {

/// Relative to the mean: what single precision may shift it by.
constexpr double kRounding = 1e-5;

constexpr double kSignificance = 1e-3;

/// Averages of cells, three channels for each, from left to right and top to bottom.
std::vector<double> averages(const image::Image& image, int side) {
    const int columns = (image.width - 1) / side + 1;
    const int rows = (image.height - 1) / side + 1;
    std::vector<double> sums(3 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    std::vector<int> counts(sums.size() / 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto cell = static_cast<std::size_t>(y / side * columns + x / side);
            const auto pixel = static_cast<std::size_t>(y * image.width + x);
            ++counts[cell];
            for (std::size_t c = 0; c < 3; ++c)
                sums[3 * cell + c] += static_cast<double>(image.pixels[3 * pixel + c]);
        }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i / 3];
    return sums;
}

/// Relative to the mean over the image. A cell that next to no sample sees lit has no normal noise.
constexpr double kDark = 0.01;

/// A normal variable that is as unlikely as one of Student's distribution (Wallace 1959).
double normal_from_student(double t, double freedom) {
    const double z = std::sqrt(freedom * std::log1p(t * t / freedom)) * (8 * freedom + 1) / (8 * freedom + 3);
    return std::copysign(z, t);
}

/// The difference of two means with their variances.
struct Difference {
    double value = 0;
    double reference = 0;
    double variance[2] = {0, 0};
    double freedom[2] = {0, 0}; ///< of the variances

    /// Adds an independent difference.
    void add(const Difference& other) {
        value += other.value;
        reference += other.reference;
        for (int k = 0; k < 2; ++k) {
            variance[k] += other.variance[k];
            freedom[k] = other.freedom[k];
        }
    }

    void append_score(std::vector<double>& scores) const {
        const double sum = variance[0] + variance[1];
        const double rounding = kRounding * std::fabs(reference);
        if (sum == 0 && std::fabs(value) <= rounding) return;
        if (sum == 0) {
            scores.push_back(std::copysign(std::numeric_limits<double>::infinity(), value));
            return;
        }
        // Welch and Satterthwaite.
        const double welch =
            sum * sum / (variance[0] * variance[0] / freedom[0] + variance[1] * variance[1] / freedom[1]);
        scores.push_back(normal_from_student(value / std::sqrt(sum + rounding * rounding), welch));
    }
};

double largest_magnitude(const std::vector<double>& values) {
    double largest = 0;
    for (const double value : values)
        largest =
            std::max(largest, std::isnan(value) ? std::numeric_limits<double>::infinity() : std::fabs(value));
    return largest;
}

/// Probability of a normal variable at least as far from 0, for the most extreme one of several.
double p_value(double z, double tests) { return tests * std::erfc(std::fabs(z) / std::sqrt(2.0)); }

} // namespace

void CellStatistics::add(const image::Image& frame) {
    const std::vector<double> values = averages(frame, side_);
    mean_.resize(values.size());
    squares_.resize(values.size());
    ++frames_;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double deviation = values[i] - mean_[i];
        mean_[i] += deviation / frames_;
        squares_[i] += deviation * (values[i] - mean_[i]);
    }
}

double CellStatistics::variance_of_mean(std::size_t i) const {
    return squares_[i] / (frames_ - 1.0) / frames_;
}

std::vector<double> CellStatistics::z_scores(const CellStatistics& other) const {
    std::vector<double> scores;
    const double cells = static_cast<double>(mean_.size() / 3);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        double average = 0;
        for (std::size_t i = channel; i < mean_.size(); i += 3) average += other.mean_[i] / cells;
        Difference dark;
        for (std::size_t i = channel; i < mean_.size(); i += 3) {
            const Difference difference{mean_[i] - other.mean_[i],
                                        other.mean_[i],
                                        {variance_of_mean(i), other.variance_of_mean(i)},
                                        {frames_ - 1.0, other.frames_ - 1.0}};
            if (other.mean_[i] < kDark * average)
                dark.add(difference);
            else
                difference.append_score(scores);
        }
        dark.append_score(scores);
    }
    return scores;
}

bool BiasTest::passes() const {
    // Too small a sum of squares is no sign of bias.
    const double worst = std::min({p_value(frame, 3), p_value(largest_cell, std::max(cells, 1)),
                                   chi_square > 0 ? p_value(chi_square, 0.5) : 1.0});
    return worst > kSignificance / 3;
}

void BiasStatistics::add(const image::Image& frame) {
    pixels_.add(frame);
    cells_.add(frame);
    frame_.add(frame);
}

BiasTest BiasStatistics::compare(const BiasStatistics& reference) const {
    BiasTest test;
    test.frame = largest_magnitude(frame_.z_scores(reference.frame_));
    const std::vector<double> cells = cells_.z_scores(reference.cells_);
    test.cells = static_cast<int>(cells.size());
    test.largest_cell = largest_magnitude(cells);
    double squares = 0;
    for (const double z : cells) squares += z * z;
    // The variance of a squared normal variable is 2. The three channels of a cell may be equal up to a factor.
    const double count = std::max(1.0, static_cast<double>(cells.size()));
    test.chi_square = (squares - count) / std::sqrt(6 * count);
    const std::vector<double> pixels = pixels_.z_scores(reference.pixels_);
    const auto beyond =
        std::count_if(pixels.begin(), pixels.end(), [](double z) { return std::fabs(z) > 3; });
    test.pixels_beyond_three =
        static_cast<double>(beyond) / std::max(1.0, static_cast<double>(pixels.size()));
    return test;
}

} // namespace nusselt::lab
