#pragma once
/// Runs the timing program of lab/timing/scalar, which the build compiles with several compilers.

#include <filesystem>
#include <string>
#include <vector>

#include "lab/timing/sampler_timing.h"

namespace nusselt::lab {

/// What the build makes of lab/timing/scalar with one compiler.
struct ScalarProgram {
    std::string code; ///< compiler and options, such as "g++ -O2"
    std::string file; ///< name of the program in the folder of programs
};

/// The compilers, from the most common one on.
const std::vector<ScalarProgram>& scalar_programs();

/// The folder of the programs, beside the running program.
std::filesystem::path folder_of_scalar_programs();

/// Runs a program for polygons with 3 to 7 vertices and lines. Without ratios.
/// \param program path of the program.
/// \param code    goes into the rows.
/// \throws std::runtime_error if it is missing, fails, or prints anything but its format
std::vector<SamplerTiming> time_scalar_program(const std::filesystem::path& program, const std::string& code,
                                               int repetitions);

/// The rows for the text that a program writes with --json.
/// \throws std::runtime_error if it has another format
std::vector<SamplerTiming> scalar_rows_of(const std::string& json, const std::string& code);

} // namespace nusselt::lab
