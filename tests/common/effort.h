#pragma once
/// The amount of work of the tests. Sample sizes follow from the effort, and significances and quantiles from the
/// sample sizes; tolerances do not depend on it.

namespace nusselt_test {

enum class Effort {
    quick, ///< sufficient to prove a change: `make test`
    full,  ///< finds rarer errors: `make test-full`
};

/// The value of the environment variable NUSSELT_TEST_EFFORT, "quick" or "full"; quick where it is not set.
/// \throws std::runtime_error for any other value.
Effort effort();

/// One of two sample sizes.
template <class T>
T at_effort(T quick, T full) {
    return effort() == Effort::full ? full : quick;
}

} // namespace nusselt_test
