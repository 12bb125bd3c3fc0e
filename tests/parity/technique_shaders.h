#pragma once
/// Each technique with its shaders: for any device, and for those with a fused fma.

#include "experiments/accuracy_techniques.h"
#include "experiments/hostile/techniques.h"
#include "shaders/line_area_fused.h"
#include "shaders/line_area_split.h"
#include "shaders/line_clipped_solid_angle_fused.h"
#include "shaders/line_clipped_solid_angle_split.h"
#include "shaders/line_projected_solid_angle_fused.h"
#include "shaders/line_projected_solid_angle_split.h"
#include "shaders/line_solid_angle_fused.h"
#include "shaders/line_solid_angle_split.h"
#include "shaders/polygon_area_4_fused.h"
#include "shaders/polygon_area_4_split.h"
#include "shaders/polygon_area_8_fused.h"
#include "shaders/polygon_area_8_split.h"
#include "shaders/polygon_clipped_solid_angle_4_fused.h"
#include "shaders/polygon_clipped_solid_angle_4_split.h"
#include "shaders/polygon_clipped_solid_angle_8_fused.h"
#include "shaders/polygon_clipped_solid_angle_8_split.h"
#include "shaders/polygon_projected_solid_angle_4_fused.h"
#include "shaders/polygon_projected_solid_angle_4_split.h"
#include "shaders/polygon_projected_solid_angle_8_fused.h"
#include "shaders/polygon_projected_solid_angle_8_split.h"
#include "shaders/polygon_projected_solid_angle_biased_4_fused.h"
#include "shaders/polygon_projected_solid_angle_biased_4_split.h"
#include "shaders/polygon_projected_solid_angle_biased_8_fused.h"
#include "shaders/polygon_projected_solid_angle_biased_8_split.h"
#include "shaders/polygon_solid_angle_4_fused.h"
#include "shaders/polygon_solid_angle_4_split.h"
#include "shaders/polygon_solid_angle_8_fused.h"
#include "shaders/polygon_solid_angle_8_split.h"

#include <gtest/gtest.h>

#include <span>

namespace nusselt::parity {

/// \tparam AnyTraits of src/experiments/accuracy_techniques.h.
/// \tparam AnyKind   of src/experiments/hostile/techniques.h, the same technique.
template <class AnyTraits, class AnyKind, const auto& Split, const auto& Fused>
struct TechniquePair {
    using Traits = AnyTraits;
    using Kind = AnyKind;
    static constexpr std::span<const std::uint32_t> kSplit = Split;
    static constexpr std::span<const std::uint32_t> kFused = Fused;
};

// Named types, for the names of tests.
struct PolygonArea4 : TechniquePair<experiments::PolygonAreaTraits<4>, hostile::PolygonAreaKindOf<4>,
                                    shaders::kPolygonArea4Split, shaders::kPolygonArea4Fused> {};
struct PolygonArea8 : TechniquePair<experiments::PolygonAreaTraits<8>, hostile::PolygonAreaKindOf<8>,
                                    shaders::kPolygonArea8Split, shaders::kPolygonArea8Fused> {};
struct PolygonSolidAngle4
    : TechniquePair<experiments::PolygonSolidAngleTraits<4>, hostile::PolygonSolidAngleKindOf<4>,
                    shaders::kPolygonSolidAngle4Split, shaders::kPolygonSolidAngle4Fused> {};
struct PolygonSolidAngle8
    : TechniquePair<experiments::PolygonSolidAngleTraits<8>, hostile::PolygonSolidAngleKindOf<8>,
                    shaders::kPolygonSolidAngle8Split, shaders::kPolygonSolidAngle8Fused> {};
struct PolygonClippedSolidAngle4
    : TechniquePair<experiments::PolygonClippedSolidAngleTraits<4>,
                    hostile::PolygonClippedSolidAngleKindOf<4>, shaders::kPolygonClippedSolidAngle4Split,
                    shaders::kPolygonClippedSolidAngle4Fused> {};
struct PolygonClippedSolidAngle8
    : TechniquePair<experiments::PolygonClippedSolidAngleTraits<8>,
                    hostile::PolygonClippedSolidAngleKindOf<8>, shaders::kPolygonClippedSolidAngle8Split,
                    shaders::kPolygonClippedSolidAngle8Fused> {};
struct PolygonProjectedSolidAngle4
    : TechniquePair<experiments::PolygonProjectedSolidAngleTraits<4>,
                    hostile::PolygonProjectedSolidAngleKindOf<4>, shaders::kPolygonProjectedSolidAngle4Split,
                    shaders::kPolygonProjectedSolidAngle4Fused> {};
struct PolygonProjectedSolidAngle8
    : TechniquePair<experiments::PolygonProjectedSolidAngleTraits<8>,
                    hostile::PolygonProjectedSolidAngleKindOf<8>, shaders::kPolygonProjectedSolidAngle8Split,
                    shaders::kPolygonProjectedSolidAngle8Fused> {};
struct PolygonProjectedSolidAngleBiased4
    : TechniquePair<experiments::PolygonProjectedSolidAngleBiasedTraits<4>, hostile::PolygonBiasedKindOf<4>,
                    shaders::kPolygonProjectedSolidAngleBiased4Split,
                    shaders::kPolygonProjectedSolidAngleBiased4Fused> {};
struct PolygonProjectedSolidAngleBiased8
    : TechniquePair<experiments::PolygonProjectedSolidAngleBiasedTraits<8>, hostile::PolygonBiasedKindOf<8>,
                    shaders::kPolygonProjectedSolidAngleBiased8Split,
                    shaders::kPolygonProjectedSolidAngleBiased8Fused> {};
struct LineArea : TechniquePair<experiments::LineAreaTraits, hostile::LineAreaKind, shaders::kLineAreaSplit,
                                shaders::kLineAreaFused> {};
struct LineSolidAngle : TechniquePair<experiments::LineSolidAngleTraits, hostile::LineSolidAngleKind,
                                      shaders::kLineSolidAngleSplit, shaders::kLineSolidAngleFused> {};
struct LineClippedSolidAngle
    : TechniquePair<experiments::LineClippedSolidAngleTraits, hostile::LineClippedSolidAngleKind,
                    shaders::kLineClippedSolidAngleSplit, shaders::kLineClippedSolidAngleFused> {};
struct LineProjectedSolidAngle
    : TechniquePair<experiments::LineProjectedSolidAngleTraits, hostile::LineProjectedSolidAngleKind,
                    shaders::kLineProjectedSolidAngleSplit, shaders::kLineProjectedSolidAngleFused> {};

using TechniquePairs =
    testing::Types<PolygonArea4, PolygonArea8, PolygonSolidAngle4, PolygonSolidAngle8,
                   PolygonClippedSolidAngle4, PolygonClippedSolidAngle8, PolygonProjectedSolidAngle4,
                   PolygonProjectedSolidAngle8, PolygonProjectedSolidAngleBiased4,
                   PolygonProjectedSolidAngleBiased8, LineArea, LineSolidAngle, LineClippedSolidAngle,
                   LineProjectedSolidAngle>;

} // namespace nusselt::parity
