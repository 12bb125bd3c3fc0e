#pragma once
/// Time until line samples are as exact as point samples.

#include "lab/errors/noise_curve.h"
#include "scene/model/scene.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

namespace nusselt::lab {

struct LineEfficiencySettings {
    render::RenderSettings points; ///< all other settings, with LightSamples::points
    render::LineSettings lines; ///< except for their number and for the choice where there are many occluders
    int most_points = 1024;     ///< per shading point and light, in powers of two from kFewestPoints
    int most_lines = 256;       ///< likewise, from 1
    int rounds = 5;             ///< of kSeedsPerRound images of each kind; all kinds take turns
    int threads = 1;            ///< of the renderer
};

inline constexpr int kFewestPoints = 4;
inline constexpr int kSeedsPerRound = 2;

/// Times are those that the program's threads run, over their number: what else the machine does has little influence.
struct LineEfficiency {
    NoiseCurve points;
    NoiseCurve lines;  ///< ManyOccluders::lines
    NoiseCurve choice; ///< ManyOccluders::points; by the number of lines where there are not many
    double mean = 0;   ///< radiance, over pixels and channels, of all images with the most points
};

/// \param progress called before each round with its number, from 0
/// \throws std::invalid_argument, std::runtime_error see Renderer::render()
LineEfficiency measure_line_efficiency(const render_cpu::Renderer& renderer, base::Isa isa,
                                       const LineEfficiencySettings& settings,
                                       const std::function<void(int round)>& progress);

/// Times until images are as exact as those of so many points [s].
struct EqualErrorRow {
    int points = 0;
    double variance = 0;
    double points_seconds = 0;
    double lines_seconds = 0;
    double choice_seconds = 0;
    /// The largest number of lines is not enough.
    bool lines_are_extrapolated = false, choice_is_extrapolated = false;

    double lines_over_points() const { return lines_seconds / points_seconds; }
    /// The time of the choice over that of the better of lines and points.
    double loss() const { return choice_seconds / std::min(points_seconds, lines_seconds); }
};

/// One row for each number of points. Where a single line is exact enough, its time counts: fewer lines do not exist.
std::vector<EqualErrorRow> equal_error_rows(const LineEfficiency& efficiency);

/// The fewest points that lines beat in time to the same error, if they beat all larger numbers too. Rows in which lines
/// are extrapolated do not count.
std::optional<int> crossover(const std::vector<EqualErrorRow>& rows);

/// The largest EqualErrorRow::loss(), of rows without extrapolation; 0 if there is none.
double largest_loss(const std::vector<EqualErrorRow>& rows);

/// Gives all surfaces a specular component of this roughness, with a reflectance of 0.04 at normal incidence.
void make_glossy(scene::Scene& scene, float roughness);

} // namespace nusselt::lab
