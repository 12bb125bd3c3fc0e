#pragma once
/// Statements of the papers that numbers decide, without scenes and images.

#include "lab/report/report.h"
#include "lab/report/run_settings.h"

#include <limits>
#include <string>
#include <vector>

namespace nusselt::lab {

/// A number that a statement implies, and the range where it has to be, ends included.
struct Finding {
    std::string item; ///< id of an item of published.json
    std::string quantity;
    double measured;
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    std::string published = {}; ///< the item's name for this number, if the paper states it
};

Finding at_most(std::string item, std::string quantity, double measured, double limit);
Finding at_least(std::string item, std::string quantity, double measured, double limit);
Finding between(std::string item, std::string quantity, double measured, double low, double high);

/// NaN does not hold.
bool holds(const Finding& finding);

/// What a set of statements found.
struct Findings {
    std::vector<Finding> all;
    std::vector<Table> tables = {};
    std::vector<Plot> plots = {};
    std::vector<Drawing> drawings = {};
};

/// Statements that are measured together.
struct StatementSet {
    std::string name; ///< on the command line
    std::string source;
    std::string description; ///< one sentence
    Findings (*measure)(Effort effort);
    Effort effort = Effort::full;
};

/// All sets. A new one is one more row in statement_sets.cpp.
const std::vector<StatementSet>& all_statement_sets();

inline StatementSet quick(StatementSet set) {
    set.effort = Effort::quick;
    return set;
}

struct StatementSetResult {
    StatementSet set;
    Findings findings;
};

StatementSetResult run_statement_set(const StatementSet& set, const RunSettings& settings,
                                     const ProgressText& progress);

Report report_of(const StatementSetResult& result);

} // namespace nusselt::lab
