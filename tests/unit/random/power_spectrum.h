#pragma once
/// Spectra of images that repeat in both directions.

#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace nusselt::test {

/// The mean power of the frequencies of a square image in a ring, relative to white noise with the variance of the image.
/// For independent pixels, the ratio is a mean of independent exponential variables of mean 1, one for each pair of
/// opposite frequencies.
/// \param values of side * side pixels, row by row.
/// \param low, high radii of the ring [cycles per pixel]; the constant part never counts.
inline double relative_power(const std::vector<double>& values, std::size_t side, double low, double high) {
    std::vector<std::complex<double>> waves(side);
    for (std::size_t i = 0; i < side; ++i)
        waves[i] =
            std::polar(1.0, -2 * 3.14159265358979323846 * static_cast<double>(i) / static_cast<double>(side));
    const auto transform = [&](const std::vector<std::complex<double>>& rows) {
        // Each row, and the result transposed.
        std::vector<std::complex<double>> result(rows.size());
        for (std::size_t row = 0; row < side; ++row)
            for (std::size_t k = 0; k < side; ++k)
                for (std::size_t i = 0; i < side; ++i)
                    result[k * side + row] += rows[row * side + i] * waves[i * k % side];
        return result;
    };
    const auto spectrum = transform(transform({values.begin(), values.end()}));
    double all = 0, in_ring = 0;
    int count = 0;
    for (std::size_t y = 0; y < side; ++y) {
        for (std::size_t x = 0; x < side; ++x) {
            if (x == 0 && y == 0) continue;
            const double power = std::norm(spectrum[y * side + x]);
            all += power;
            const auto along = [side](std::size_t k) {
                return static_cast<double>(k <= side / 2 ? k : side - k) / static_cast<double>(side);
            };
            const double frequency = std::hypot(along(x), along(y));
            if (frequency < low || frequency >= high) continue;
            in_ring += power;
            ++count;
        }
    }
    return in_ring / count / (all / static_cast<double>(side * side - 1));
}

} // namespace nusselt::test
