#pragma once
/// Small integrals with known results. Their domain consists of cells in each of which the densities and the
/// integrand are constant, so the expectation of a heuristic is a finite sum.

#include <algorithm>
#include <cmath>
#include <vector>

#include <nusselt/estimate/mis.h>

namespace nusselt_test {

using Colour = nusselt::Vec3<double>;

inline Colour grey(double x) { return {x, x, x}; }

/// The largest difference among the channels.
inline double distance(const Colour& a, const Colour& b) {
    return std::max({std::fabs(a.x - b.x), std::fabs(a.y - b.y), std::fabs(a.z - b.z)});
}

/// A technique samples a cell with a probability that equals its density there.
template <int K>
struct MisModel {
    nusselt::MisTechniques<double, K> techniques;
    std::vector<nusselt::MisSample<double, K>> cells;
    std::vector<double> visibility;

    Colour integral() const {
        Colour sum = grey(0);
        for (std::size_t i = 0; i < cells.size(); ++i)
            for (const Colour& component : cells[i].component) sum = sum + visibility[i] * component;
        return sum;
    }
};

constexpr int kCells = 64;

/// Densities proportional to shape(i), with sum 1.
template <class Shape>
std::vector<double> density(const Shape& shape) {
    std::vector<double> values;
    double sum = 0;
    for (int i = 0; i < kCells; ++i) {
        values.push_back(shape(i));
        sum += values.back();
    }
    for (double& value : values) value /= sum;
    return values;
}

/// Cells with a smaller index are above the surface.
constexpr int kHorizon = 50;

/// The technique for the diffuse component. It is uniform above the surface and, like solid angle sampling, reaches a
/// little below.
inline std::vector<double> uniform_density() {
    return density([](int i) { return i < kHorizon + 6 ? 1.0 : 0.0; });
}
/// A lobe, which is zero in most of the cells above the surface.
inline std::vector<double> lobe_density(int centre, int width) {
    return density([=](int i) {
        const double x = static_cast<double>(i - centre) / width;
        return std::max(1 - x * x, 0.0);
    });
}

/// \param coefficients, counts of each technique.
template <int K>
MisModel<K> empty_model(const Colour (&coefficients)[K], const double (&counts)[K]) {
    MisModel<K> model{
        {}, std::vector<nusselt::MisSample<double, K>>(kCells), std::vector<double>(kCells, 1.0)};
    for (int k = 0; k < K; ++k) {
        model.techniques.samples[k] = counts[k];
        model.techniques.unshadowed[k] = coefficients[k];
        const auto p = k == 0 ? uniform_density() : k == 1 ? lobe_density(46, 15) : lobe_density(20, 5);
        for (int i = 0; i < kCells; ++i)
            model.cells[static_cast<std::size_t>(i)].pdf[k] = p[static_cast<std::size_t>(i)];
    }
    return model;
}

/// The components of the integrand are the densities times the coefficients.
template <int K>
MisModel<K> fitting_model(const Colour (&coefficients)[K], const double (&counts)[K]) {
    MisModel<K> model = empty_model(coefficients, counts);
    for (auto& cell : model.cells)
        for (int k = 0; k < K; ++k) cell.component[k] = cell.pdf[k] * coefficients[k];
    return model;
}

/// Neither the shapes nor the sizes of the components fit the densities. Each component is positive everywhere above
/// the surface and black below. A shadow ends in the middle of the first lobe.
template <int K>
MisModel<K> misfitting_model(const Colour (&coefficients)[K], const double (&counts)[K]) {
    MisModel<K> model = empty_model(coefficients, counts);
    for (int i = 0; i < kCells; ++i) {
        auto& cell = model.cells[static_cast<std::size_t>(i)];
        model.visibility[static_cast<std::size_t>(i)] = i < 44 ? 0.25 : 1.0;
        for (int k = 0; k < K; ++k) {
            const double above = i < kHorizon ? 1 : 0;
            const double shape = cell.pdf[k] * (1 + 0.3 * std::sin(0.7 * i + k)) + 0.002;
            cell.component[k] = above * shape * Colour{0.9, 0.5 + 0.2 * k, 0.3};
        }
    }
    return model;
}

/// Expectation of the sum over all samples of techniques J and above.
template <int J = 0, class Heuristic, int K>
Colour expectation(const Heuristic& heuristic, const MisModel<K>& model) {
    Colour sum = grey(0);
    for (std::size_t i = 0; i < model.cells.size(); ++i) {
        const auto& cell = model.cells[i];
        const auto estimate = heuristic.template estimate<J>(model.techniques, cell);
        sum = sum + model.techniques.samples[J] * cell.pdf[J] *
                        (model.visibility[i] * estimate.shadowed + estimate.constant);
    }
    if constexpr (J + 1 < K) sum = sum + expectation<J + 1>(heuristic, model);
    return sum;
}

/// Largest variance of a sample of techniques J and above.
template <int J = 0, class Heuristic, int K>
double largest_variance(const Heuristic& heuristic, const MisModel<K>& model) {
    Colour mean = grey(0), square = grey(0);
    for (std::size_t i = 0; i < model.cells.size(); ++i) {
        const auto& cell = model.cells[i];
        const auto estimate = heuristic.template estimate<J>(model.techniques, cell);
        const Colour share = model.visibility[i] * estimate.shadowed + estimate.constant;
        mean = mean + cell.pdf[J] * share;
        square = square + cell.pdf[J] * (share * share);
    }
    const double variance = distance(square, mean * mean);
    if constexpr (J + 1 < K)
        return std::max(variance, largest_variance<J + 1>(heuristic, model));
    else
        return variance;
}

} // namespace nusselt_test
