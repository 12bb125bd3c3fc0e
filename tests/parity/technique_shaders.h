#pragma once
/// Each technique with its shaders: for any device, and for those with a fused fma.

#include "experiments/accuracy_techniques.h"
#include "experiments/hostile/techniques.h"
#include "shaders/polygon_projected_solid_angle_4_fused.h"
#include "shaders/polygon_projected_solid_angle_4_split.h"
#include "shaders/polygon_projected_solid_angle_8_fused.h"
#include "shaders/polygon_projected_solid_angle_8_split.h"

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

using TechniquePairs =
    testing::Types<TechniquePair<experiments::PolygonProjectedSolidAngleTraits<4>,
                                 hostile::PolygonProjectedSolidAngleKindOf<4>,
                                 kPolygonProjectedSolidAngle4Split, kPolygonProjectedSolidAngle4Fused>,
                   TechniquePair<experiments::PolygonProjectedSolidAngleTraits<8>,
                                 hostile::PolygonProjectedSolidAngleKindOf<8>,
                                 kPolygonProjectedSolidAngle8Split, kPolygonProjectedSolidAngle8Fused>>;

} // namespace nusselt::parity
