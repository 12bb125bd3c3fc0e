#include "examples/snippets/emission.cpp"

#include <gtest/gtest.h>

namespace {

constexpr int kGrid = 48;

/// The mean of a function over the centres of a grid in the unit square.
template <class Function>
Vec mean_over_square(const Function& f) {
    Vec sum{0, 0, 0};
    for (int k = 0; k < kGrid * kGrid; ++k)
        sum += f(Vec2<float>{(static_cast<float>(k % kGrid) + 0.5f) / kGrid,
                             (static_cast<float>(k / kGrid) + 0.5f) / kGrid});
    return sum / float{kGrid * kGrid};
}

void expect_near(const Vec& value, const Vec& expected) {
    constexpr float kTolerance = 0.005f;
    EXPECT_NEAR(value.x, expected.x, kTolerance * expected.x);
    EXPECT_NEAR(value.y, expected.y, kTolerance * expected.y);
    EXPECT_NEAR(value.z, expected.z, kTolerance * expected.z);
}

const Vec kNormal = normalize(Vec{0.3f, 0.1f, 1});

TEST(EmissionSnippets, ScreensGiveTheIntegral) {
    constexpr int kSize = 16;
    std::vector<Vec> texels;
    for (int k = 0; k < kSize * kSize; ++k) {
        const float column = static_cast<float>(k % kSize), row = static_cast<float>(k / kSize);
        texels.push_back({1 + column, 4 + row, 9});
    }
    const Vec corner{-0.5f, -0.5f, 1}, side_x{1, 0, 0}, side_y{0, 1, 0.25f}, point{0, 0, 0};
    const auto plane = make_texture_plane(corner, side_x, side_y);
    const TextureView<float> view{texels.data(), kSize, kSize};
    const Vec exact = mean_over_square([&](const Vec2<float>& at) {
        const Vec p = plane.point_at(at);
        const Vec wi = normalize(p);
        const float geometry = dot(kNormal, wi) * std::fabs(dot(plane.normal, wi)) / dot(p, p);
        return (geometry * plane.area() * kAlbedo / kPi<float>)*BilinearFilter::lookup(view, at);
    });
    expect_near(mean_over_square([&](const Vec2<float>& u) {
                    return light_of_screen(texels.data(), kSize, kSize, corner, side_x, side_y, point,
                                           kNormal, u);
                }),
                exact);
}

/// More light from above than from the side.
Vec sky_in(const Vec& w) {
    const float height = max(w.z, 0.0f);
    return {1 + height, 1 + 3 * height * height, 2};
}

TEST(EmissionSnippets, WindowsGiveTheIntegral) {
    const Vec window[] = {{-0.5f, -0.4f, 1}, {0.7f, -0.4f, 1}, {0.7f, 0.6f, 1}, {-0.5f, 0.6f, 1}};
    const Frame<float> portal{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto frame = Frame<float>::from_normal(kNormal);
    const PolygonProjectedSolidAngle<float, 4> technique(
        to_shading_space(make_polygon<4>(window, 4), Vec{0, 0, 0}, frame));
    const Vec exact = mean_over_square([&](const Vec2<float>& u) {
        const auto s = technique.sample(u);
        return (s.wi.z / s.pdf * kAlbedo / kPi<float>)*sky_in(frame.to_world(s.wi));
    });
    // A table takes as long as many samples.
    constexpr int kSamples = 64;
    Vec sum{0, 0, 0};
    for (int k = 0; k < kSamples; ++k)
        sum +=
            light_of_window(window, portal, sky_in, Vec{0, 0, 0}, kNormal,
                            {(static_cast<float>(k % 8) + 0.5f) / 8, (static_cast<float>(k / 8) + 0.5f) / 8});
    expect_near(sum / float{kSamples}, exact);
}

TEST(EmissionSnippets, MapsGiveTheIntegral) {
    constexpr int kSize = 32;
    std::vector<Vec> texels;
    for (int k = 0; k < kSize * kSize; ++k)
        texels.push_back(
            sky_in(octahedral_direction(Vec2<float>{(static_cast<float>(k % kSize) + 0.5f) / kSize,
                                                    (static_cast<float>(k / kSize) + 0.5f) / kSize})));
    const OctahedralMap<float> map{texels.data(), kSize};
    const auto frame = Frame<float>::from_normal(kNormal);
    const Vec exact = mean_over_square([&](const Vec2<float>& u) {
        const float radius = std::sqrt(u.x), azimuth = 2 * kPi<float> * u.y;
        const Vec wi{radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1 - u.x)};
        return kAlbedo * map.lookup(frame.to_world(wi));
    });
    expect_near(mean_over_square([&](const Vec2<float>& u) {
                    return light_of_map(texels.data(), kSize, Vec{0, 0, 0}, kNormal, u);
                }),
                exact);
}

} // namespace
