#pragma once
/// The accuracy tables as a file, and as a baseline that later measurements must match.

#include "lab/accuracy/accuracy.h"
#include "lab/results/results.h"

#include <filesystem>

namespace nusselt::lab {

/// The rows, and the targets with their verdicts.
Results results_of(const AccuracyTable& table);

/// Reads the rows that to_json(results_of()) wrote.
/// \throws std::runtime_error naming the file if it cannot be read or is not such a table.
AccuracyTable read_accuracy_json(const std::filesystem::path& path);

/// How far a row may exceed the baseline. g++ 12, clang 14 and all instruction sets agree on every number, because
/// the code has the same operations everywhere. Other versions may differ: without FMA, float goes through double and
/// may round differently in one of 2^29 cases, and double and long double take arctangents from the standard library.
struct AccuracyMargin {
    double quantiles = 1.1; ///< factor on median, 99 % and 99.9 %
    double max = 1.5;       ///< factor on the largest error, which depends on a single light
    /// The same for long double. Processors of different vendors round the arctangents of their x87 units
    /// differently: for the same lights, the largest errors on AMD and Intel differed by factors of up to 2.7.
    double max_of_long_double = 3;
    /// Factor on the counts. A count of 0 must stay 0.
    double counts = 1.1;
};

/// Finds rows of the library's own methods that are worse than in the baseline, that are missing, or that the
/// baseline lacks.
/// \return a sentence for each; empty if all is well.
std::vector<std::string> compare_with_baseline(const AccuracyTable& baseline, const AccuracyTable& measured,
                                               const AccuracyMargin& margin = {});

} // namespace nusselt::lab
