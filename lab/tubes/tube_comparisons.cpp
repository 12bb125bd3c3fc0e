#include "lab/tubes/tube_comparisons.h"

#include "lab/tubes/tube_settings.h"

namespace nusselt::lab {

namespace {

using scene::TubeModel;

render::RenderSettings reference() { return sampled_tubes(512); }

const Variant kCylinder = {"cylinder without caps", sampled_tubes(64), {}, TubeModel::open};
const Variant kSampledLine = {"line, sampled", sampled_tubes(64), {}, TubeModel::linear};
const Variant kLine = {"line", analytic_tubes(), {}, TubeModel::open};
const Variant kLineAndCaps = {"line and caps", analytic_tubes(), {}, TubeModel::solid};

/// The sampled line has no fitted lobe: its error is that of the line alone, which is of the order of radius over distance.
/// That is a tenth where the tubes end above the floor.
ImageComparison thin_tubes() {
    return {"thin-tubes",
            "Heitz and Hill 2017, Fig. 1.1",
            "Thin tubes above a floor and in front of a wall, shaded as lines.",
            "evidence/thin-tubes.pbrt",
            reference(),
            {kSampledLine, kLine, kLineAndCaps},
            {AtMost{{Measure::relative_rmse, "floor"}, kSampledLine.label, 0.15},
             AtMost{{Measure::relative_rmse, "floor"}, kLine.label, 0.2},
             AtMost{{Measure::relative_rmse, "wall"}, kLine.label, 0.05}},
            {{"wall", 0.3, 0.05, 0.7, 0.2}, {"floor", 0.1, 0.7, 0.9, 0.95}}};
}

ImageComparison materials() {
    ImageComparison comparison = {
        "tube-materials",
        "Heitz and Hill 2017, Fig. 1.2",
        "A floor of roughness 0.2, 0.35, 0.5 and 0.8 under a thin tube, shaded as a line.",
        "evidence/planes-tube.pbrt",
        reference(),
        {kSampledLine, kLine, kLineAndCaps},
        {},
        {{"roughness 0.2", 0.15, 0.45, 0.25, 0.7},
         {"roughness 0.35", 0.3, 0.45, 0.48, 0.9},
         {"roughness 0.5", 0.52, 0.45, 0.7, 0.9},
         {"roughness 0.8", 0.76, 0.45, 0.85, 0.7}}};
    for (const Inset& inset : comparison.insets) {
        const Metric metric = {Measure::relative_rmse, inset.name};
        comparison.expectations.push_back(AtMost{metric, kSampledLine.label, 0.05});
        comparison.expectations.push_back(AtMost{metric, kLine.label, 0.1});
    }
    return comparison;
}

/// The end of a tube that points at a polished floor: without caps, a dark spot shows.
ImageComparison caps() {
    const Metric spot = {Measure::bias, "cap"};
    return {"tube-caps",
            "Heitz and Hill 2017, Fig. 1.15",
            "A tube that points at a polished floor, as cylinder and as line, with and without caps.",
            "evidence/tube-end.pbrt",
            reference(),
            {kCylinder, kLine, kLineAndCaps},
            {Falling{spot, {kCylinder.label, kLine.label, kLineAndCaps.label}}},
            {{"cap", 0.45, 0.6, 0.55, 0.72}}};
}

/// Only one tube shows a cap. With it, its error is smaller, but its end gets a bulb; the others gain nothing.
ImageComparison cap_artefacts() {
    return {"tube-cap-artefacts",
            "Heitz and Hill 2017, Fig. 1.16",
            "Tubes in several directions above a polished floor, as lines with and without caps.",
            "evidence/tubes-over-floor.pbrt",
            reference(),
            {kCylinder, kLine, kLineAndCaps},
            {AtMostTimes{{Measure::rmse, "across"}, kLine.label, 1.1, {kLineAndCaps.label}},
             AtMostTimes{{Measure::rmse, "upright"}, kLine.label, 1.1, {kLineAndCaps.label}}},
            {{"towards the eye", 0.2, 0.45, 0.34, 0.75},
             {"across", 0.36, 0.5, 0.6, 0.72},
             {"upright", 0.64, 0.5, 0.78, 0.85}}};
}

} // namespace

std::vector<ImageComparison> tube_comparisons() {
    return {thin_tubes(), materials(), caps(), cap_artefacts()};
}

} // namespace nusselt::lab
