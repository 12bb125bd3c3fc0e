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

using TechniquePairs = testing::Types<
    TechniquePair<experiments::PolygonAreaTraits<4>, hostile::PolygonAreaKindOf<4>,
                  shaders::kPolygonArea4Split, shaders::kPolygonArea4Fused>,
    TechniquePair<experiments::PolygonAreaTraits<8>, hostile::PolygonAreaKindOf<8>,
                  shaders::kPolygonArea8Split, shaders::kPolygonArea8Fused>,
    TechniquePair<experiments::PolygonSolidAngleTraits<4>, hostile::PolygonSolidAngleKindOf<4>,
                  shaders::kPolygonSolidAngle4Split, shaders::kPolygonSolidAngle4Fused>,
    TechniquePair<experiments::PolygonSolidAngleTraits<8>, hostile::PolygonSolidAngleKindOf<8>,
                  shaders::kPolygonSolidAngle8Split, shaders::kPolygonSolidAngle8Fused>,
    TechniquePair<experiments::PolygonClippedSolidAngleTraits<4>, hostile::PolygonClippedSolidAngleKindOf<4>,
                  shaders::kPolygonClippedSolidAngle4Split, shaders::kPolygonClippedSolidAngle4Fused>,
    TechniquePair<experiments::PolygonClippedSolidAngleTraits<8>, hostile::PolygonClippedSolidAngleKindOf<8>,
                  shaders::kPolygonClippedSolidAngle8Split, shaders::kPolygonClippedSolidAngle8Fused>,
    TechniquePair<experiments::PolygonProjectedSolidAngleTraits<4>,
                  hostile::PolygonProjectedSolidAngleKindOf<4>, shaders::kPolygonProjectedSolidAngle4Split,
                  shaders::kPolygonProjectedSolidAngle4Fused>,
    TechniquePair<experiments::PolygonProjectedSolidAngleTraits<8>,
                  hostile::PolygonProjectedSolidAngleKindOf<8>, shaders::kPolygonProjectedSolidAngle8Split,
                  shaders::kPolygonProjectedSolidAngle8Fused>,
    TechniquePair<experiments::PolygonProjectedSolidAngleBiasedTraits<4>, hostile::PolygonBiasedKindOf<4>,
                  shaders::kPolygonProjectedSolidAngleBiased4Split,
                  shaders::kPolygonProjectedSolidAngleBiased4Fused>,
    TechniquePair<experiments::PolygonProjectedSolidAngleBiasedTraits<8>, hostile::PolygonBiasedKindOf<8>,
                  shaders::kPolygonProjectedSolidAngleBiased8Split,
                  shaders::kPolygonProjectedSolidAngleBiased8Fused>,
    TechniquePair<experiments::LineAreaTraits, hostile::LineAreaKind, shaders::kLineAreaSplit,
                  shaders::kLineAreaFused>,
    TechniquePair<experiments::LineSolidAngleTraits, hostile::LineSolidAngleKind,
                  shaders::kLineSolidAngleSplit, shaders::kLineSolidAngleFused>,
    TechniquePair<experiments::LineClippedSolidAngleTraits, hostile::LineClippedSolidAngleKind,
                  shaders::kLineClippedSolidAngleSplit, shaders::kLineClippedSolidAngleFused>,
    TechniquePair<experiments::LineProjectedSolidAngleTraits, hostile::LineProjectedSolidAngleKind,
                  shaders::kLineProjectedSolidAngleSplit, shaders::kLineProjectedSolidAngleFused>>;

} // namespace nusselt::parity
