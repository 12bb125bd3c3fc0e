#include "lab/lines/line_comparisons.h"

namespace nusselt::lab {

namespace {

using render::LineOffsets;
using render::LineOrientation;
using render::RenderSettings;
using render::SampleOrder;

constexpr int kLines = 16;

/// Many points, by sampling that has nothing to do with lines.
RenderSettings reference() {
    RenderSettings settings;
    settings.strategies = render::Strategies::diffuse_ltc;
    settings.samples = 256;
    settings.pixel_position = render::PixelPosition::center;
    return settings;
}

Variant lines(const std::string& label, LineOrientation orientation, LineOffsets offsets) {
    RenderSettings settings;
    settings.light_samples = render::LightSamples::lines;
    settings.lines.count = kLines;
    settings.lines.orientation = orientation;
    settings.lines.offsets = offsets;
    settings.lines.many_occluders = render::ManyOccluders::lines;
    settings.sample_order = SampleOrder::stratified;
    settings.pixel_position = render::PixelPosition::center;
    return {label, settings};
}

ImageComparison under_a_triangle(const std::string& name, const std::string& figure,
                                 const std::string& description) {
    ImageComparison experiment;
    experiment.name = name;
    experiment.source = "Billen and Dutre 2016, " + figure;
    experiment.description = description;
    experiment.scene = "ring.pbrt";
    experiment.reference = reference();
    experiment.frames = 16;
    experiment.reference_frames = 16;
    return experiment;
}

/// The longest edge of the light runs from left to right: so do fixed lines, and these shadow edges of the shelf.
const Inset kAlong = {"shadow edge along fixed lines", 0.67, 0.63, 0.8, 0.73};
const Inset kAcross = {"shadow edge across fixed lines", 0.78, 0.57, 0.87, 0.65};

ImageComparison orientation() {
    ImageComparison experiment = under_a_triangle(
        "lines-orientation", "Fig. 2",
        "A glossy ring and a metal shelf under a triangular light: 16 lines, stratified, in one fixed "
        "direction, each in a random one, or in parallel in a random one for each shading point.");
    experiment.insets = {kAlong, kAcross};
    experiment.variants = {lines("independent", LineOrientation::independent, LineOffsets::length),
                           lines("fixed", LineOrientation::fixed, LineOffsets::length),
                           lines("parallel", LineOrientation::parallel, LineOffsets::length)};
    experiment.expectations = {Falling{{Measure::rmse}, {"independent", "parallel"}},
                               Falling{{Measure::rmse, kAcross.name}, {"parallel", "fixed"}},
                               Falling{{Measure::rmse, kAlong.name}, {"fixed", "parallel"}},
                               Unbiased{{"independent", "fixed", "parallel"}}};
    return experiment;
}

ImageComparison offsets() {
    ImageComparison experiment =
        under_a_triangle("lines-offsets", "Fig. 3",
                         "The same scene with 16 parallel lines per light, whose offsets "
                         "are uniform or as likely as lines are long.");
    experiment.variants = {lines("uniform", LineOrientation::parallel, LineOffsets::uniform),
                           lines("length", LineOrientation::parallel, LineOffsets::length)};
    // Without stratification, the lengths of lines make the difference.
    for (Variant variant : {experiment.variants[0], experiment.variants[1]}) {
        variant.label += ", independent";
        variant.settings.sample_order = SampleOrder::independent;
        experiment.variants.push_back(variant);
    }
    experiment.expectations = {
        AtMostTimes{{Measure::rmse}, "length", 0.9, {"uniform"}},
        AtMostTimes{{Measure::rmse}, "length, independent", 0.8, {"uniform, independent"}},
        Unbiased{{"uniform", "length"}}};
    return experiment;
}

} // namespace

std::vector<ImageComparison> line_comparisons() { return {orientation(), offsets()}; }

} // namespace nusselt::lab
