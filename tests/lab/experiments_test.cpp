#include "base/temporary_folder.h"
#include "common/source_folder.h"
#include "lab/figures/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <variant>

namespace nusselt::lab {

namespace {

const std::filesystem::path kScenes = std::filesystem::path(nusselt_test::kSourceFolder) / "scenes";

const Experiment& experiment(const std::string& name) {
    const auto& all = all_experiments();
    return *std::find_if(all.begin(), all.end(), [&](const Experiment& e) { return e.name == name; });
}

/// Small images, to be quick. References that are means of several frames have fewer samples in each.
RunSettings small_run(const Experiment& e) {
    RunSettings settings;
    settings.scenes = kScenes;
    settings.width = 64;
    settings.reference_samples = e.reference_frames > 1 ? 32 : 256;
    return settings;
}

ExperimentResult run(const Experiment& e) {
    return run_experiment(e, small_run(e), [](std::string_view) {});
}

bool all_hold(const ExperimentResult& result) {
    return std::all_of(result.expectations.begin(), result.expectations.end(),
                       [](const ExpectationResult& e) { return e.holds; });
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
    for (const Experiment& e : all_experiments()) {
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
    for (const Experiment& e : all_experiments()) {
        const ExperimentResult result = run(e);
        EXPECT_EQ(result.reference.width, 64);
        for (const VariantResult& v : result.variants) EXPECT_EQ(v.errors.invalid_pixels, 0) << v.label;
        for (const ExpectationResult& expectation : result.expectations)
            EXPECT_TRUE(expectation.holds) << e.name << ": " << expectation.text;
    }
}

TEST(Run, FindsPenumbrae) {
    for (const char* name : {"line-diffuse", "polygon-diffuse", "tube"}) {
        const double share = run(experiment(name)).share_outside_penumbrae;
        EXPECT_GT(share, 0.5) << name;
        EXPECT_LT(share, 0.99) << name;
    }
    EXPECT_EQ(run(experiment("planes-image")).share_outside_penumbrae, 1);
}

// Shading without shadows is not the mean of anything with shadows.
TEST(Run, NoticesAWrongMean) {
    Experiment mutant = experiment("wall");
    Variant wrong = mutant.variants[0];
    wrong.label = "ltc_analytic";
    wrong.settings.technique = render::Technique::ltc_analytic;
    mutant.variants = {mutant.variants[0], wrong};
    mutant.expectations = {Unbiased{{mutant.variants[0].label}}, Unbiased{{wrong.label}}};
    const ExperimentResult result = run(mutant);
    EXPECT_TRUE(result.expectations[0].holds);
    EXPECT_FALSE(result.expectations[1].holds);
}

// Solid angle sampling posing as projected solid angle sampling must be noticed.
TEST(Run, ExpectationsFailForAnImpostor) {
    Experiment mutant = experiment("line-diffuse");
    for (Variant& v : mutant.variants) v.settings.technique = render::Technique::solid_angle;
    const ExperimentResult result = run(mutant);
    for (const ExpectationResult& expectation : result.expectations)
        EXPECT_FALSE(expectation.holds) << expectation.text;
}

// Shading without shadows posing as the biased variant, and noise posing as analytic shading.
TEST(Run, LimitsOfErrorsFailForImpostors) {
    render::RenderSettings unshadowed;
    unshadowed.technique = render::Technique::ltc_analytic;
    const Variant impostors[] = {{"projected_solid_angle_biased", unshadowed}, {"ltc_analytic", {}}};
    const char* const names[] = {"biased", "planes-image"};
    for (int i = 0; i < 2; ++i) {
        Experiment mutant = experiment(names[i]);
        mutant.variants = {impostors[i]};
        auto& expectations = mutant.expectations;
        const auto is_no_limit = [](const Expectation& e) { return !std::holds_alternative<AtMost>(e); };
        expectations.erase(std::remove_if(expectations.begin(), expectations.end(), is_no_limit),
                           expectations.end());
        const ExperimentResult result = run(mutant);
        ASSERT_EQ(result.expectations.size(), 1u) << names[i];
        EXPECT_FALSE(result.expectations[0].holds) << result.expectations[0].text;
    }
}

TEST(Run, NamesTheMissingScene) {
    Experiment lost = experiment("line-diffuse");
    lost.scene = "no-such-scene.pbrt";
    try {
        run(lost);
        FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("no-such-scene.pbrt"), std::string::npos) << error.what();
    }
}

TEST(Report, HasATableRowAndAnImagePerVariant) {
    const ExperimentResult result = run(experiment("line-diffuse"));
    EXPECT_TRUE(all_hold(result));
    const nusselt::base::TemporaryFolder parent;
    const std::filesystem::path folder = parent / "page";
    write_report(result, folder);
    std::ifstream stream(folder / "index.html");
    const std::string html{std::istreambuf_iterator<char>(stream), {}};
    for (const VariantResult& v : result.variants) {
        EXPECT_NE(html.find("<td>" + v.label + "<td>"), std::string::npos) << v.label;
        EXPECT_NE(html.find("src=\"" + v.label + ".png\""), std::string::npos) << v.label;
        for (const char* suffix : {".png", ".exr", "-difference.png"})
            EXPECT_GT(std::filesystem::file_size(folder / (v.label + suffix)), 100u) << v.label << suffix;
    }
    EXPECT_EQ(html.find("does not hold"), std::string::npos);
}

} // namespace

} // namespace nusselt::lab
