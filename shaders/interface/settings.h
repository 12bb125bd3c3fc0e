#ifndef NUSSELT_INTERFACE_SETTINGS_H
#define NUSSELT_INTERFACE_SETTINGS_H
/// The settings that choose a pipeline, for C++ and GLSL alike. The enumerations of src/render/settings.h take their values
/// from here, and explain them.

#ifdef __cplusplus
namespace nusselt::interface {
#endif

// Numbers of specialisation constants after kFusedFmaConstant: what a scene has (shaders/passes/scene_kinds.glsl), ...
const int kInstancesConstant = 1;
const int kPartialConstant = 2;
const int kFrostbiteConstant = 3;
const int kPhongConstant = 4;
const int kTextureKindsConstant = 5;
// ... then settings, ...
const int kTechniqueConstant = 6;
const int kStrategiesConstant = 7;
const int kSamplerConstant = 8;
const int kBrdfConstant = 9;
const int kEmissionSamplingConstant = 10;
// ... then those of lights (shaders/interface/lights.h).
const int kFirstLightConstant = 11;

// Values of one setting are numbered from 0 without gaps.
const int kTechniqueArea = 0;
const int kTechniqueSolidAngle = 1;
const int kTechniqueClippedSolidAngle = 2;
const int kTechniqueProjectedSolidAngle = 3;
const int kTechniqueProjectedSolidAngleBiased = 4;
const int kTechniqueLtcAnalytic = 5;
const int kTechniqueCount = 6;

const int kStrategiesDiffuse = 0;
const int kStrategiesDiffuseLtc = 1;
const int kStrategiesDiffuseGgx = 2;
const int kStrategiesDiffuseGgxBounded = 3;
const int kStrategiesCount = 4;

const int kEmissionSamplingProduct = 0;
const int kEmissionSamplingMeasure = 1;
const int kEmissionSamplingCount = 2;

const int kMisBalance = 0;
const int kMisPower = 1;
const int kMisWeightedBalance = 2;
const int kMisClampedOptimal = 3;
const int kMisOptimal = 4;
const int kMisOneSample = 5;
const int kMisSeparate = 6;
const int kMisCount = 7;

const int kSamplerIndependent = 0;
const int kSamplerSobol = 1;
const int kSamplerJittered = 2;
const int kSamplerStratified = 3;
const int kSamplerZSobol = 4;
const int kSamplerBlueNoise = 5;
const int kSamplerCount = 6;

const int kBrdfMaterial = 0;
const int kBrdfLambert = 1;
const int kBrdfCount = 2;

#ifdef __cplusplus
} // namespace nusselt::interface
#endif

#endif
