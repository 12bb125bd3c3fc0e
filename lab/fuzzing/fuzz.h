#pragma once
/// Runs techniques on millions of hostile lights and checks their contract (proof/hostile/contract.h).

#include "lab/fuzzing/fuzz_kernel.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

struct FuzzSettings {
    std::vector<std::string> techniques; ///< class names; all techniques if empty
    std::uint64_t seed = 1;
    std::uint64_t first = 0; ///< index of the first configuration
    std::uint64_t count = 10'000'000;
    int threads = 1;
};

/// A configuration for which a technique broke its contract.
struct FuzzReport {
    std::uint64_t index; ///< FuzzSettings::first of a run that finds it alone
    bool flushed;        ///< whether it was found with denormals flushed to zero
    std::string text;    ///< the defect, and the light, random numbers and outputs as literals
};

/// The results of one technique, with denormal numbers and with denormals flushed to zero.
struct FuzzRow {
    std::string technique; ///< class name
    FuzzLight light;
    std::uint64_t violations = 0;
    double nanoseconds = 0;          ///< time per configuration and thread, without that for making the light
    std::vector<FuzzReport> reports; ///< the reports with the lowest indices in each mode
};

/// Called with the share of the work that is done, never by two threads at once.
using FuzzProgress = std::function<void(double)>;

/// Runs techniques on the configurations of a seed, each once with denormal numbers and once with flush-to-zero.
/// Configurations only depend on their index and the seed, so the result does not depend on the number of threads.
/// \tparam T float, double or long double
/// \throws std::invalid_argument if a technique is not in the table
template <class T>
std::vector<FuzzRow> fuzz(const FuzzTable<T>& table, const FuzzSettings& settings,
                          const FuzzProgress& progress);

/// Runs the techniques of the library in the packs of an instruction set. Long double has no packs.
/// \param scalar "float", "double" or "longdouble"
/// \param isa    as base::choose_isa()
/// \throws std::runtime_error for an instruction set that is unknown or that the CPU lacks
std::vector<FuzzRow> fuzz_library(const std::string& scalar, const std::optional<std::string>& isa,
                                  const FuzzSettings& settings, const FuzzProgress& progress);

/// Class names of the techniques of the library.
std::vector<std::string> fuzz_technique_names();

/// "quadrilaterals", "octagons", "lines", "cylinders" or "ellipsoids".
std::string name_of(FuzzLight light);

} // namespace nusselt::lab
