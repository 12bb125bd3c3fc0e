#pragma once
/// Searches for the light and random number for which an iteration ends farthest from the exact result, which is
/// known up to the precision of long double: C. Peters 2021, BRDF Importance Sampling for Linear Lights, Sec. 3.4,
/// and BRDF Importance Sampling for Polygonal Lights, Sec. 3.6.
///
/// Each start takes the worst of some random cases, from which Nelder-Mead climbs in double precision. Long double is
/// slower by two orders of magnitude, because it has no fma instruction. Only if a start beats all before it does it
/// climb on in long double, and only that result counts.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// A case, given by its natural parameters, and its backward error.
struct WorstCase {
    std::vector<long double> parameters; ///< see WorstCaseTarget::parameter_names; empty: no case yet
    long double error = 0;
};

/// The summit that a start reached in double precision, in the coordinates of the search.
struct Summit {
    std::vector<double> coordinates; ///< empty if no random case was allowed
    double error = 0;
};

/// A technique and the lights among which to search.
struct WorstCaseTarget {
    std::string name;
    std::string description;
    std::vector<std::string> parameter_names;
    /// The bound in the documentation, which no start may exceed.
    long double bound;
    /// The climb of one start. It depends only on the seed and the index.
    std::function<Summit(std::uint64_t seed, std::uint64_t index)> climb;
    /// Climbs on in long double.
    std::function<WorstCase(const Summit& summit)> refine;
    /// Backward error of a case in long double.
    std::function<long double(const std::vector<long double>& parameters)> error;
};

/// "lines", "lines-1": projected solid angle of lines after two steps and one. "polygons", "small-polygons":
/// decentral sectors with a projected solid angle of at least 1e-2 and 1e-7 after two steps. "biased": the same as
/// "polygons" after none. The biased technique also has arctangents with errors of 1e-5. Here they are exact, so that the
/// error is that of the method. "published-lines" and so on: the same after two steps of the published iterations.
const std::vector<WorstCaseTarget>& worst_case_targets();

/// \throws std::invalid_argument if there is no target of that name
const WorstCaseTarget& worst_case_target(const std::string& name);

/// The search for one target. The result depends on the seed and the number of starts, but neither on the number of
/// threads nor on how the starts are divided among calls of run() and resumed searches.
class WorstCaseSearch {
public:
    WorstCaseSearch(const WorstCaseTarget& target, std::uint64_t seed) : target_(&target), seed_(seed) {}

    /// Continues a search with the same seed. Evaluates the error again, because the technique may have changed.
    /// \param starts     number of starts so far.
    /// \param parameters those of the worst case, as in WorstCase.
    /// \throws std::invalid_argument for a wrong number of parameters
    void resume(std::uint64_t starts, const std::vector<long double>& parameters);

    /// Makes more starts, in parallel on the threads of the current TBB arena.
    void run(std::uint64_t more_starts);

    const WorstCaseTarget& target() const { return *target_; }
    std::uint64_t starts() const { return starts_; }
    const WorstCase& worst() const { return worst_; }

private:
    const WorstCaseTarget* target_;
    std::uint64_t seed_;
    std::uint64_t starts_ = 0;
    WorstCase worst_;
};

} // namespace nusselt::lab
