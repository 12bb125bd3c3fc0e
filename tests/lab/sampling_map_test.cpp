#include "lab/figures/sampling_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <stdexcept>

namespace nusselt::lab {

namespace {

double toroidal_distance(const Vec2<double>& a, const Vec2<double>& b) {
    const double x = std::fabs(a.x - b.x);
    const double y = std::fabs(a.y - b.y);
    return std::hypot(std::min(x, 1 - x), std::min(y, 1 - y));
}

TEST(BlueNoise, PointsKeepApart) {
    constexpr int kCount = 128;
    const auto points = blue_noise_points(kCount);
    ASSERT_EQ(points.size(), kCount);
    double nearest = 1;
    for (int i = 0; i < kCount; ++i) {
        EXPECT_TRUE(points[i].x >= 0 && points[i].x < 1 && points[i].y >= 0 && points[i].y < 1);
        for (int j = 0; j < i; ++j) nearest = std::min(nearest, toroidal_distance(points[i], points[j]));
    }
    // The densest packing has a distance of sqrt(2 / (sqrt(3) n)) = 1.07 / sqrt(n); independent points come as close
    // as 1 / n.
    EXPECT_GT(nearest, 0.5 / std::sqrt(kCount));
}

std::size_t occurrences(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    return static_cast<std::size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), expression), std::sregex_iterator()));
}

TEST(SamplingMap, EveryCoordinateIsInThePicture) {
    for (const std::string& technique : mapped_techniques()) {
        const std::string picture = draw_sampling_map(technique);
        EXPECT_EQ(picture.find("nan"), std::string::npos) << technique;
        EXPECT_EQ(picture.find("inf"), std::string::npos) << technique;
        const std::string drawing = picture.substr(picture.find("<path")); // without the size of the picture
        const std::regex coordinates("[ML ](-?[0-9.]+) (-?[0-9.]+)");
        std::size_t count = 0;
        for (std::sregex_iterator i(drawing.begin(), drawing.end(), coordinates), end; i != end;
             ++i, ++count) {
            EXPECT_TRUE(std::stod((*i)[1]) >= 0 && std::stod((*i)[1]) <= 928)
                << technique << ": " << i->str();
            EXPECT_TRUE(std::stod((*i)[2]) >= 0 && std::stod((*i)[2]) <= 482)
                << technique << ": " << i->str();
        }
        EXPECT_GT(count, 500u) << technique;
    }
}

// Techniques that clip show all samples, the others lose some of those of the light across the horizon.
TEST(SamplingMap, SamplesBelowTheHorizonAreToldAndNotDrawn) {
    constexpr std::size_t kAll = 4 * 256; // random numbers and three panels
    for (const char* technique : {"PolygonClippedSolidAngle", "PolygonProjectedSolidAngle"}) {
        const std::string picture = draw_sampling_map(technique);
        EXPECT_EQ(occurrences(picture, "h0"), kAll) << technique;
        EXPECT_EQ(occurrences(picture, "below the horizon"), 0u) << technique;
    }
    for (const char* technique : {"PolygonArea", "PolygonSolidAngle"}) {
        const std::string picture = draw_sampling_map(technique);
        EXPECT_EQ(occurrences(picture, "below the horizon"), 1u) << technique;
        const std::regex percentage("([0-9]+) % of samples below the horizon");
        std::smatch match;
        ASSERT_TRUE(std::regex_search(picture, match, percentage)) << technique;
        const double missing = static_cast<double>(kAll - occurrences(picture, "h0"));
        EXPECT_NEAR(std::stod(match[1]), 100 * missing / 256, 0.5) << technique;
    }
    EXPECT_EQ(occurrences(draw_sampling_map("LineSolidAngle"), "below the horizon"), 1u);
    EXPECT_EQ(occurrences(draw_sampling_map("LineClippedSolidAngle"), "below the horizon"), 0u);
}

// Each of the four edges above the horizon has an ellipse and a ray, in two panels of three lights.
TEST(SamplingMap, SectorsAreDrawnForTechniquesThatHaveThem) {
    EXPECT_EQ(occurrences(draw_sampling_map("PolygonProjectedSolidAngle"), "stroke-dasharray"),
              2u * 4 * 2 * 3);
    EXPECT_EQ(occurrences(draw_sampling_map("PolygonSolidAngle"), "stroke-dasharray"), 0u);
    // The first vertex of the light across the horizon is below it.
    EXPECT_EQ(occurrences(draw_sampling_map("PolygonSolidAngle"), "<circle") -
                  occurrences(draw_sampling_map("PolygonArea"), "<circle"),
              4u);
}

TEST(SamplingMap, UnknownTechniquesAreNamed) {
    try {
        draw_sampling_map("PolygonVolume");
        FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("PolygonVolume"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("PolygonArea"), std::string::npos);
    }
}

} // namespace

} // namespace nusselt::lab
