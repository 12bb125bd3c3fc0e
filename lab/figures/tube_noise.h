#pragma once
/// Noise and cost of sampling closed cylinders, compared with rejection sampling (M. N. Gamito 2016).

#include "proof/tube_lights.h"

namespace nusselt::lab {

/// Relative standard deviations of the weight of one sample: importance over density, for an unoccluded light of constant
/// radiance.
struct TubeNoise {
    double solid_angle;           ///< CylinderSolidAngle, importance 1
    double projected_solid_angle; ///< CylinderProjectedSolidAngle, the cosine at the surface
    double lobe;                  ///< CylinderLtc, the density of kGlossyLobe
    double rejection_hits;        ///< share of the samples of CylinderRejectionGamito on the light
    double rejection;             ///< CylinderRejectionGamito, the cosine at the surface; misses weigh 0
};

/// Uses 2^16 points of Sobol's sequence, in double, and is deterministic.
TubeNoise measure_tube_noise(const proof::TubeLight& light);

/// Time for preparing the light and taking one sample with CylinderProjectedSolidAngle over that with
/// CylinderRejectionGamito: scalar code, float, one thread.
/// \param repetitions at least 1; both take turns, the median of the ratios counts.
double measure_tube_time_ratio(const proof::TubeLight& light, int repetitions);

} // namespace nusselt::lab
