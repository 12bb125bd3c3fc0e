#pragma once
/// Tables of the noise of one light on a plane, computed without images.

#include "lab/report/report.h"
#include "lab/report/run_settings.h"
#include "render/settings.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// Two samples of the light, one from each technique where there are two.
struct NoiseEstimator {
    std::string label;
    render::Strategies strategies;
    render::Mis mis = render::Mis::clamped_optimal;
    double visibility_estimate = 0.5;
};

/// A grey surface with the Frostbite BRDF.
struct NoiseSurface {
    std::string name;
    double albedo; ///< of the diffuse component
    double f0;
};

/// Standard deviation of the reflected radiance over its mean at each shading point.
struct Noise {
    double in_highlight = 0; ///< root mean square over shading points where a mirror would show the light
    double on_plane = 0;     ///< root mean square over all shading points
    double largest = 0;
};

/// The largest noise at one angle over all roughnesses.
struct NoiseLimit {
    double Noise::*noise;
    std::string estimator;
    std::string surface;
    double angle;
    double limit;
};

/// A horizontal square light of side 1 m at a height of 1 m above a plane, which the eye sees from far away. Shading points
/// fill a square of the plane around the centre of the highlight: the point where a mirror would show the centre of the
/// light.
struct NoiseTable {
    std::string name; ///< on the command line
    std::string source;
    std::string description; ///< one sentence
    std::vector<NoiseSurface> surfaces;
    std::vector<double> roughnesses; ///< perceptual
    std::vector<double> angles;      ///< between the normal and the direction to the eye [degrees]
    std::vector<NoiseEstimator> estimators;
    std::vector<NoiseLimit> limits;
    double extent = 4;  ///< side of the square of shading points [m]
    int points = 16;    ///< along both sides of the square, at least 4
    int samples = 1024; ///< estimates for each shading point, at least 2
};

const std::vector<NoiseTable>& all_noise_tables();

/// A quarter of the shading points, and of the estimates for each.
NoiseTable quick(NoiseTable table);

struct NoiseRow {
    const NoiseSurface* surface = nullptr;
    const NoiseEstimator* estimator = nullptr;
    double roughness = 0;
    std::vector<Noise> noise; ///< for each angle
};

struct NoiseTableResult {
    const NoiseTable* table = nullptr;
    std::vector<NoiseRow> rows;
    std::vector<ExpectationResult> expectations;
};

/// Measures on as many threads as the settings have. Deterministic.
NoiseTableResult run_noise_table(const NoiseTable& table, const RunSettings& settings,
                                 const ProgressText& progress);

/// The table and numbers.
Report report_of(const NoiseTableResult& result);

} // namespace nusselt::lab
