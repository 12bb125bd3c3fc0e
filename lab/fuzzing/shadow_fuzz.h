#pragma once
/// Checks the visibility of millions of line samples: whether light leaks through closed meshes, and whether
/// degenerate lights, points and occluders break the visible parts of lines.

#include "base/isa.h"
#include "proof/shadows/shadow_case.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// The interface of the units compiled per instruction set. Each function returns the defect of a case, or null.
struct ShadowChecks {
    const char* (*leak)(const proof::ShadowCase& test);         ///< for a point in a closed mesh
    const char* (*broken_parts)(const proof::ShadowCase& test); ///< for any case
};
template <base::Isa>
ShadowChecks shadow_checks();

struct ShadowFuzzSettings {
    std::uint64_t seed = 1;
    std::uint64_t first = 0;       ///< index of the first case
    std::uint64_t count = 625'000; ///< cases of each kind, with kLinesPerCase lines each
    int threads = 1;
};

/// A case with a defect.
struct ShadowReport {
    std::uint64_t index; ///< ShadowFuzzSettings::first of a run that finds it alone
    std::string text;
};

/// The results for one kind of case. Each case runs with denormal numbers and with denormals flushed to zero.
struct ShadowFuzzRow {
    std::string kind;
    std::uint64_t violations = 0;
    std::uint64_t triangles = 0;       ///< number of triangles in all cases
    std::vector<ShadowReport> reports; ///< the reports with the lowest indices
};

/// Called with the share of the work that is done, never by two threads at once.
using ShadowFuzzProgress = std::function<void(double)>;

/// Runs the checks on the cases of a seed. Cases only depend on their index and the seed, so the result does not
/// depend on the number of threads.
std::vector<ShadowFuzzRow> fuzz_shadows(const ShadowChecks& checks, const ShadowFuzzSettings& settings,
                                        const ShadowFuzzProgress& progress);

/// The checks, compiled for an instruction set.
/// \param isa as base::choose_isa()
/// \throws std::runtime_error for an instruction set that is unknown or that the CPU lacks
ShadowChecks choose_shadow_checks(const std::optional<std::string>& isa);

} // namespace nusselt::lab
