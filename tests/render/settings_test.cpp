// Tables of settings, and what is refused.

#include "render/settings.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

namespace nusselt {
namespace {

using namespace render;

template <class Value>
class SettingNames : public testing::Test {};

using Enumerations =
    testing::Types<Technique, Strategies, Mis, SampleOrder, PixelPosition, BrdfChoice, LayerKind,
                   LightSamples, LineOrientation, LineOffsets, LineShading, ManyOccluders>;
TYPED_TEST_SUITE(SettingNames, Enumerations);

TYPED_TEST(SettingNames, AreUniqueAndLeadBackToTheirValues) {
    constexpr auto values = values_of(kNames<TypeParam>);
    std::set<std::string> names;
    for (const TypeParam value : values) {
        const std::string name(name_of(value));
        EXPECT_FALSE(name.empty());
        EXPECT_TRUE(names.insert(name).second) << name;
        EXPECT_EQ(from_name(values, name), value);
    }
    EXPECT_THROW(static_cast<void>(from_name(values, "nothing")), std::invalid_argument);
    EXPECT_EQ(name_of(static_cast<TypeParam>(values.size())), "") << "numbers have no gaps";
}

std::string refusal(const RenderSettings& settings) {
    try {
        validate(settings);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(Settings, RefuseNumbersThatAreNoValue) {
    EXPECT_EQ(refusal({}), "");
    RenderSettings settings;
    settings.technique = static_cast<Technique>(interface::kTechniqueCount);
    EXPECT_EQ(refusal(settings), "unknown technique: number 6");
    settings = {};
    settings.strategies = static_cast<Strategies>(99);
    EXPECT_EQ(refusal(settings), "unknown strategies: number 99");
    settings = {};
    settings.mis = static_cast<Mis>(interface::kMisCount);
    EXPECT_EQ(refusal(settings), "unknown heuristic of multiple importance sampling: number 7");
    settings = {};
    settings.sample_order = static_cast<SampleOrder>(interface::kSamplerCount);
    EXPECT_EQ(refusal(settings), "unknown sampler: number 6");
    settings = {};
    settings.brdf = static_cast<BrdfChoice>(2);
    EXPECT_EQ(refusal(settings), "unknown BRDF: number 2");
    settings = {};
    settings.layers = {LayerKind::albedo, static_cast<LayerKind>(9)};
    EXPECT_EQ(refusal(settings), "unknown layer: number 9");
}

} // namespace
} // namespace nusselt
