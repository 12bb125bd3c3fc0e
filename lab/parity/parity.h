#pragma once
/// Compares the techniques in GLSL, and the functions below them, with those in C++: on a device, errors may be at most
/// three times those of C++ in float. docs/testing.md#parity-with-the-gpu explains what is compared.

#include "lab/parity/parity_check.h"
#include "lab/parity/twin_shader.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace nusselt::parity {

/// How many lights and calls are compared. No tolerance depends on it.
struct ParityEffort {
    int lights = 100'000; ///< random lights for each technique, over all its classes; at least kFewestLights

    int hostile_lights() const { return lights / 5; }
    /// Of polygons with bounds of 3, 5, 6 and 7 vertices.
    int lights_per_class() const { return lights / 30; }
    std::size_t function_calls() const { return static_cast<std::size_t>(lights) / 5 * 6; }
    std::size_t random_calls() const { return static_cast<std::size_t>(lights); }
};

/// With fewer, a class of lights has too few errors for quantiles.
inline constexpr int kFewestLights = 10'000;

struct VariantVerdict {
    Variant variant;
    Verdict verdict;
};

/// A technique, or a group of functions.
struct ParityCase {
    std::string subject; ///< what is compared, such as "technique"
    std::string name;    ///< of the technique with its bound on the number of vertices, or of the functions
    /// Judges all variants of the shaders that give the right results on a platform.
    std::function<std::vector<VariantVerdict>(const ShaderPlatform&, const ParityEffort&)> judge;
};

/// All cases, in a fixed order.
std::vector<ParityCase> parity_cases();

/// Why a budget cannot be exceeded, because the error of C++ is at least a third of the largest possible error.
/// \param where as in Verdict::vacuous
/// \return null if no reason is known, so that the comparison would prove nothing
const char* reason_of_vacuous_budget(const std::string& where);

/// The cases of each subject, for parity_cases().
void add_technique_cases(std::vector<ParityCase>& cases);
void add_textured_cases(std::vector<ParityCase>& cases);
void add_textured_line_cases(std::vector<ParityCase>& cases);
void add_environment_cases(std::vector<ParityCase>& cases);
void add_windowed_cases(std::vector<ParityCase>& cases);
void add_vertex_bound_cases(std::vector<ParityCase>& cases);
void add_function_cases(std::vector<ParityCase>& cases);
void add_ltc_cases(std::vector<ParityCase>& cases);
void add_estimate_cases(std::vector<ParityCase>& cases);
void add_random_cases(std::vector<ParityCase>& cases);

} // namespace nusselt::parity
