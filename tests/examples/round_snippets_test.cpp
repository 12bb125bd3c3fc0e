#include "examples/snippets/round.cpp"

#include <gtest/gtest.h>

namespace {

TEST(RoundSnippets, DisksGiveTheFormFactor) {
    // A parallel disk above the point: the cosine's integral is pi r^2 / (r^2 + h^2).
    constexpr float kHeight = 2, kRadius = 0.75f, kEmitted = 3;
    const Vec center{0, 0, kHeight}, down{0, 0, -1}, up{0, 0, 1}, point{0, 0, 0};
    const float exact = kEmitted * kAlbedo * kRadius * kRadius / (kRadius * kRadius + kHeight * kHeight);
    for (const Vec2<float> u : {Vec2<float>{0.1f, 0.2f}, Vec2<float>{0.5f, 0.9f}, Vec2<float>{0.8f, 0.4f}}) {
        EXPECT_NEAR(light_of_disk(center, down, kRadius, kEmitted, point, up, u), exact, 1e-6f * kEmitted);
        EXPECT_EQ(light_of_disk(center, up, kRadius, kEmitted, point, up, u), 0) << "from behind";
    }
}

TEST(RoundSnippets, OtherShapesGiveTheirMeasures) {
    constexpr float kHeight = 2, kRadius = 0.75f;
    const Vec center{0, 0, kHeight}, point{0, 0, 0};
    const auto frame = Frame<float>::from_normal(Vec{0, 0, 1});
    float measures[3], share;
    other_shapes(center, kRadius, {kRadius, 0, 0}, {0, kRadius, 0}, {0, 0, kRadius}, point, frame, measures,
                 share);
    const float sphere = kPi<float> * kRadius * kRadius / (kHeight * kHeight);
    EXPECT_NEAR(measures[0], sphere, 1e-6f);
    EXPECT_NEAR(measures[1], kPi<float> * kRadius * kRadius / (kRadius * kRadius + kHeight * kHeight), 1e-6f);
    EXPECT_NEAR(measures[2], sphere, 1e-6f);
    EXPECT_NEAR(share, sphere / kPi<float>, 1e-6f);
}

TEST(RoundSnippets, GlossyLightOfASphereAboveTheSurfaceHasNoNoise) {
    const Sphere<float> sphere{{0.5f, 0.2f, 2}, 0.5f};
    const LtcCoefficients<float> coefficients{1, 0.1f, 0.9f, -0.1f, 0.8f, 0.6f};
    for (const Vec2<float> u : {Vec2<float>{0.1f, 0.2f}, Vec2<float>{0.5f, 0.9f}, Vec2<float>{0.8f, 0.4f}}) {
        float share = 0;
        const float radiance =
            light_of_glossy_sphere(sphere, 3, {0, 0, 0}, {0, 0, 1}, {0.6f, 0, 0.8f}, coefficients, u, share);
        EXPECT_GT(share, 0.01f);
        EXPECT_NEAR(radiance, 3 * coefficients.albedo * share, 1e-5f * radiance);
    }
}

} // namespace
