#pragma once
/// Search for the light and random number where an iteration ends farthest from the exact result, as far as
/// long double knows it: C. Peters 2021, BRDF Importance Sampling for Linear Lights, Sec. 3.4, and BRDF
/// Importance Sampling for Polygonal Lights, Sec. 3.6.
///
/// A start is the worst of some random cases, from which Nelder-Mead climbs in double precision, since long
/// double is slower by two orders of magnitude (there is no instruction for its fma). A start that beats all
/// before it climbs on in long double, and only the result in long double counts.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// A case by its natural parameters, and its backward error.
struct WorstCase {
    std::vector<long double> parameters; ///< as WorstCaseTarget::parameter_names; empty: none yet
    long double error = 0;
};

/// The summit that a start reached in double precision, in coordinates of the search.
struct Summit {
    std::vector<double> coordinates; ///< empty if no random case was allowed
    double error = 0;
};

/// A technique, and the lights to search.
struct WorstCaseTarget {
    std::string name;
    std::string description;
    std::vector<std::string> parameter_names;
    /// The bound in the documentation, which no start may exceed.
    long double bound;
    /// The climb of one start. Depends on nothing but seed and index.
    std::function<Summit(std::uint64_t seed, std::uint64_t index)> climb;
    /// Climbs on in long double.
    std::function<WorstCase(const Summit& summit)> refine;
    /// Backward error of a case in long double.
    std::function<long double(const std::vector<long double>& parameters)> error;
};

/// "lines", "lines-2": projected solid angle of lines after three and two steps. "polygons", "small-polygons": decentral sectors
/// with a projected solid angle of at least 1e-2 and 1e-7 after two steps. "biased": the same as "polygons"
/// after none. The biased technique also has arctangents with errors of 1e-5; they are left out here, so that
/// the error is that of the method.
const std::vector<WorstCaseTarget>& worst_case_targets();

/// \throws std::invalid_argument if there is no target of that name
const WorstCaseTarget& worst_case_target(const std::string& name);

/// The search for one target. The result depends on the seed and the number of starts, not on the number of
/// threads nor on how the starts are split over calls of run() and over resumed searches.
class WorstCaseSearch {
public:
    WorstCaseSearch(const WorstCaseTarget& target, std::uint64_t seed) : target_(&target), seed_(seed) {}

    /// Continues a search of the same seed. The error is evaluated again: the technique may have changed since.
    /// \param starts     that were made.
    /// \param parameters of the worst case, as WorstCase has them.
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
