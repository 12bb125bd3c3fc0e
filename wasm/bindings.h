#pragma once
/// What the WebAssembly module exports. A technique has its number in the generated table, and one row or several, for
/// different lights. Lights and samples are columns in memory (light_columns.h, technique_row.h). Callers keep to the
/// sizes that these functions tell: nothing is checked.

extern "C" {

/// The row of a technique for lights with so many columns, or -1: it does not take such lights.
int nusselt_row(int technique, int columns) noexcept;
const char* nusselt_light(int row) noexcept;  ///< what the technique samples, as in techniques.json
int nusselt_random_numbers(int row) noexcept; ///< of a sample
int nusselt_group_size(int row) noexcept;     ///< of four prepared lights [bytes]

/// Prepares `groups` groups of four lights.
/// \param lights   columns
/// \param prepared memory for groups * nusselt_group_size() bytes, at a multiple of 16
void nusselt_prepare(int row, const float* lights, int columns, int groups, void* prepared) noexcept;

/// \name One result of each light in each of `rounds` rounds, and the measures of all lights.
/// @{
void nusselt_sample(int row, const void* prepared, int groups, int rounds, const float* u, float* wi,
                    float* pdf, float* p) noexcept;
void nusselt_pdf(int row, const void* prepared, int groups, int rounds, const float* wi, float* pdf) noexcept;
void nusselt_invert(int row, const void* prepared, int groups, int rounds, const float* wi,
                    float* u) noexcept;
void nusselt_measure(int row, const void* prepared, int groups, float* measure) noexcept;
/// @}
}
