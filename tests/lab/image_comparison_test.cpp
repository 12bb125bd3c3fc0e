#include "common/source_folder.h"
#include "lab/figures/run_image_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <variant>

namespace nusselt::lab {

namespace {

const std::filesystem::path kScenes = std::filesystem::path(nusselt_test::kSourceFolder) / "scenes";

const ImageComparison& comparison(const std::string& name) {
    const auto& all = all_image_comparisons();
    return *std::find_if(all.begin(), all.end(), [&](const ImageComparison& e) { return e.name == name; });
}

/// Of small images, to be quick. Where they are blurred, penumbrae have to be wider than the blur.
int small_width(const ImageComparison& comparison) { return comparison.blur > 0 ? 192 : 64; }

/// References that are means of several frames have fewer samples in each.
ImageComparisonResult run(const ImageComparison& full) {
    ImageComparison comparison = full;
    comparison.width = small_width(full);
    comparison.reference.samples = full.reference_frames > 1 ? 32 : 256;
    RunSettings settings;
    settings.scenes = kScenes;
    return run_image_comparison(comparison, settings, [](std::string_view) {});
}

bool all_hold(const ImageComparisonResult& result) {
    return verdict_of(result.expectations) == Verdict::holds;
}

// The variants and the metric of an expectation.
std::vector<std::string> variants_of(const AtMost& e) { return {e.variant}; }
std::vector<std::string> variants_of(const AtMostTimes& e) {
    std::vector<std::string> variants = e.others;
    variants.push_back(e.variant);
    return variants;
}
std::vector<std::string> variants_of(const Falling& e) { return e.variants; }
std::vector<std::string> variants_of(const Unbiased& e) { return e.variants; }
template <class Comparison>
std::string inset_of(const Comparison& e) {
    return e.metric.inset;
}
std::string inset_of(const Unbiased& /*whole images*/) { return ""; }

TEST(Registry, NamesAreUniqueScenesExistAndExpectationsReferToVariants) {
    std::set<std::string> names;
    for (const ImageComparison& e : all_image_comparisons()) {
        EXPECT_TRUE(names.insert(e.name).second) << e.name;
        EXPECT_TRUE(std::filesystem::exists(kScenes / e.scene)) << e.scene;
        EXPECT_FALSE(e.expectations.empty()) << e.name;
        std::set<std::string> labels;
        std::set<std::string> insets = {""};
        for (const Inset& inset : e.insets) EXPECT_TRUE(insets.insert(inset.name).second) << inset.name;
        for (const Variant& v : e.variants) EXPECT_TRUE(labels.insert(v.label).second) << v.label;
        for (const Expectation& expectation : e.expectations)
            std::visit(
                [&](const auto& about) {
                    for (const std::string& label : variants_of(about))
                        EXPECT_EQ(labels.count(label), 1u) << label;
                    EXPECT_EQ(insets.count(inset_of(about)), 1u) << inset_of(about);
                },
                expectation);
    }
}

TEST(Run, ExpectationsHoldInSmallImages) {
    for (const ImageComparison& e : all_image_comparisons()) {
        const ImageComparisonResult result = run(e);
        EXPECT_EQ(result.reference.width, small_width(e));
        for (const VariantResult& v : result.variants) EXPECT_EQ(v.errors.invalid_pixels, 0) << v.label;
        for (const ExpectationResult& expectation : result.expectations)
            EXPECT_EQ(expectation.verdict, Verdict::holds) << e.name << ": " << expectation.text;
    }
}

TEST(Run, FindsPenumbrae) {
    for (const char* name : {"line-diffuse", "polygon-diffuse", "tube"}) {
        const double share = run(comparison(name)).share_outside_penumbrae;
        EXPECT_GT(share, 0.5) << name;
        EXPECT_LT(share, 0.99) << name;
    }
    EXPECT_EQ(run(comparison("planes-image")).share_outside_penumbrae, 1);
}

// Shading without shadows is not the mean of anything with shadows.
TEST(Run, NoticesAWrongMean) {
    ImageComparison mutant = comparison("wall");
    Variant wrong = mutant.variants[0];
    wrong.label = "ltc_analytic";
    wrong.settings.technique = render::Technique::ltc_analytic;
    mutant.variants = {mutant.variants[0], wrong};
    mutant.expectations = {Unbiased{{mutant.variants[0].label}}, Unbiased{{wrong.label}}};
    const ImageComparisonResult result = run(mutant);
    EXPECT_EQ(result.expectations[0].verdict, Verdict::holds);
    EXPECT_EQ(result.expectations[1].verdict, Verdict::fails);
}

// Solid angle sampling posing as projected solid angle sampling must be noticed.
TEST(Run, ExpectationsFailForAnImpostor) {
    ImageComparison mutant = comparison("line-diffuse");
    for (Variant& v : mutant.variants) {
        v.settings.technique = render::Technique::solid_angle;
        v.technique.clear();
    }
    const ImageComparisonResult result = run(mutant);
    for (const ExpectationResult& expectation : result.expectations)
        EXPECT_EQ(expectation.verdict, Verdict::fails) << expectation.text;
}

// Shading without shadows posing as the biased variant, and noise posing as analytic shading.
TEST(Run, LimitsOfErrorsFailForImpostors) {
    render::RenderSettings unshadowed;
    unshadowed.technique = render::Technique::ltc_analytic;
    const Variant impostors[] = {{"projected_solid_angle_biased", unshadowed}, {"ltc_analytic", {}}};
    const char* const names[] = {"biased", "planes-image"};
    for (int i = 0; i < 2; ++i) {
        ImageComparison mutant = comparison(names[i]);
        mutant.variants = {impostors[i]};
        auto& expectations = mutant.expectations;
        const auto is_no_limit = [](const Expectation& e) { return !std::holds_alternative<AtMost>(e); };
        expectations.erase(std::remove_if(expectations.begin(), expectations.end(), is_no_limit),
                           expectations.end());
        const ImageComparisonResult result = run(mutant);
        ASSERT_EQ(result.expectations.size(), 1u) << names[i];
        EXPECT_EQ(result.expectations[0].verdict, Verdict::fails) << result.expectations[0].text;
    }
}

TEST(Run, NamesTheMissingScene) {
    ImageComparison lost = comparison("line-diffuse");
    lost.scene = "no-such-scene.pbrt";
    try {
        run(lost);
        FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("no-such-scene.pbrt"), std::string::npos) << error.what();
    }
}

TEST(Report, HasATableRowAndAnImagePerVariant) {
    const ImageComparisonResult result = run(comparison("line-diffuse"));
    EXPECT_TRUE(all_hold(result));
    const Report report = report_of(result);
    ASSERT_EQ(report.images.size(), result.variants.size() + 1);
    EXPECT_EQ(report.images[0].role, ImageRole::reference);
    for (std::size_t i = 0; i < result.variants.size(); ++i) {
        const ReportImage& image = report.images[i + 1];
        EXPECT_EQ(report.tables[0][i + 1][0], result.variants[i].label);
        EXPECT_EQ(image.label, result.variants[i].label);
        EXPECT_EQ(image.role, ImageRole::variant);
        EXPECT_EQ(image.metrics[0].first, "RMSE");
        EXPECT_GT(image.metrics[0].second, 0);
        EXPECT_EQ(image.metrics[1].first, "FLIP");
        EXPECT_GT(image.metrics[1].second, 0);
        EXPECT_LT(image.metrics[1].second, 1);
    }
    ASSERT_FALSE(report.inputs.empty());
    EXPECT_EQ(report.inputs[0].filename(), "cornell-tube.pbrt");
}

} // namespace

} // namespace nusselt::lab
