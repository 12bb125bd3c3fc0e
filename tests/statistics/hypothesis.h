#pragma once
/// Goodness-of-fit tests. A test of many samples returns a p-value: the probability that the samples of a correct
/// sampler deviate at least as much as these.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace nusselt_test {

/// Probability that a chi-square variable exceeds a value: the regularised upper incomplete gamma function.
inline double chi_square_p_value(double statistic, int degrees_of_freedom) {
    const double a = 0.5 * degrees_of_freedom;
    const double x = 0.5 * statistic;
    if (x <= 0) return 1;
    const double factor = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) { // power series of the lower function
        double term = 1 / a;
        double sum = term;
        for (int n = 1; term > 1e-17 * sum; ++n) {
            term *= x / (a + n);
            sum += term;
        }
        return 1 - factor * sum;
    }
    // Continued fraction, evaluated backwards.
    double fraction = 0;
    for (int n = 500; n >= 1; --n) fraction = n * (n - a) / (2 * n + 1 + x - a - fraction);
    return factor / (1 + x - a - fraction);
}

/// p-value of Pearson's test. Cells with few expected samples are pooled; a sample where exactly none is expected proves an
/// error.
inline double chi_square_test(const std::vector<double>& expected,
                              const std::vector<std::int64_t>& observed) {
    constexpr double kLeastExpected = 10;
    double statistic = 0;
    int cells = 0;
    double pooled_expected = 0;
    double pooled_observed = 0;
    const auto add = [&](double e, double o) {
        statistic += (o - e) * (o - e) / e;
        ++cells;
    };
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto count = static_cast<double>(observed[i]);
        if (expected[i] == 0 && count > 0) return 0;
        if (expected[i] >= kLeastExpected) {
            add(expected[i], count);
        } else {
            pooled_expected += expected[i];
            pooled_observed += count;
        }
    }
    if (pooled_expected >= kLeastExpected) {
        add(pooled_expected, pooled_observed);
    } else if (pooled_observed > pooled_expected + 5 * std::sqrt(kLeastExpected) + kLeastExpected) {
        return 0;
    }
    return chi_square_p_value(statistic, cells - 1);
}

/// p-value of the Kolmogorov-Smirnov test for values that should be uniform in [0, 1].
inline double kolmogorov_smirnov_test(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto count = static_cast<double>(values.size());
    double largest = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto rank = static_cast<double>(i);
        largest = std::max({largest, values[i] - rank / count, (rank + 1) / count - values[i]});
    }
    const double lambda = (std::sqrt(count) + 0.12 + 0.11 / std::sqrt(count)) * largest;
    if (lambda < 0.2) return 1;
    double sum = 0;
    for (int k = 1; k <= 100; ++k) {
        sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * lambda * lambda);
    }
    return std::clamp(sum, 0.0, 1.0);
}

/// Two-sided p-value of Student's t distribution. \param degrees_of_freedom even.
inline double student_t_p_value(double t, int degrees_of_freedom) {
    const double angle = std::atan(std::fabs(t) / std::sqrt(degrees_of_freedom));
    const double squared_cosine = std::cos(angle) * std::cos(angle);
    double term = std::sin(angle);
    double within = 0;
    for (int k = 0; 2 * k < degrees_of_freedom; ++k) {
        within += term;
        term *= squared_cosine * (2 * k + 1) / (2 * k + 2);
    }
    return std::max(1 - within, 0.0);
}

/// p-value of Student's test that an odd number of independent values have a mean within `slack` of an expected one.
inline double student_t_test(const std::vector<double>& values, double expected, double slack) {
    const auto count = static_cast<double>(values.size());
    double mean = 0;
    for (const double x : values) mean += x / count;
    double variance = 0;
    for (const double x : values) variance += (x - mean) * (x - mean) / (count - 1);
    const double off = std::max(std::fabs(mean - expected) - slack, 0.0);
    if (off == 0) return 1;
    if (variance == 0) return 0;
    return student_t_p_value(off / std::sqrt(variance / count), static_cast<int>(values.size()) - 1);
}

/// Tests the mean of many independent values against an expected one. Values that are not added count as zero.
class MeanTest {
public:
    void add(long double value) {
        sum_ += value;
        squares_ += value * value;
    }

    /// Two-sided p-value for a normally distributed mean.
    /// \param count number of all values, including zeros that were not added.
    /// \param slack variance that does not count as bias, relative to the square of the expected mean.
    double p_value(int count, long double expected, long double slack) const {
        const long double mean = sum_ / count;
        const long double variance = (squares_ / count - mean * mean) / count;
        const long double error = std::sqrt(variance + slack * expected * expected);
        return static_cast<double>(std::erfc(std::fabs(mean - expected) / error / std::sqrt(2.0L)));
    }

private:
    long double sum_ = 0;
    long double squares_ = 0;
};

/// Whether the smallest of several independent p-values is too small, at a significance level of 0.1 % for all tests
/// together (Šidák's correction). As seeds are fixed, a given sampler always passes or always fails.
/// A value that is not a number comes from an infinite estimate and is rejected, and so is a test of nothing.
///
/// One value decides that the answer is yes. The tests after it do not run, so that mutants cost little.
/// \param subjects   one for each test
/// \param p_value_of function of a subject
template <class Subjects, class PValue>
bool reject(const Subjects& subjects, const PValue& p_value_of) {
    const double limit = 1 - std::pow(1 - 1e-3, 1 / static_cast<double>(subjects.size()));
    return subjects.empty() || std::any_of(subjects.begin(), subjects.end(), [&](const auto& subject) {
               return !(p_value_of(subject) >= limit);
           });
}
inline bool reject(const std::vector<double>& p_values) {
    return reject(p_values, [](double p) { return p; });
}

/// Uniform random numbers in [0, 1) with the resolution of float.
class UniformFloats {
public:
    explicit UniformFloats(std::uint64_t seed) : engine_(seed) {}
    float operator()() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }

private:
    std::mt19937_64 engine_;
};

} // namespace nusselt_test
