// Plain and compressed files, good and broken.

#include "gzip.h"
#include "scene/input/file_bytes.h"
#include "scene_fixture.h"

namespace nusselt::scene {
namespace {

FileBytes inflated_within(std::string_view bytes, std::uint64_t max_size) {
    Budget budget(max_size, "too much");
    return inflated(bytes, budget);
}

std::string reason(std::string_view bytes, std::uint64_t max_size) {
    try {
        inflated_within(bytes, max_size);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "no error";
}

constexpr std::uint64_t kPlenty = 1 << 24;

TEST(Gzip, RoundTrips) {
    const std::string random_like = [] {
        std::string text;
        std::uint32_t state = 1;
        for (int i = 0; i < 100000; ++i)
            text += static_cast<char>((state = state * 1664525 + 1013904223) >> 24);
        return text;
    }();
    for (const std::string& text : {std::string(), std::string("a"), std::string(1000000, 'x'), random_like})
        EXPECT_EQ(inflated_within(gzipped(text), kPlenty).view(), text);
}

TEST(Gzip, PartsAreJoinedAndPaddingIsSkipped) {
    const std::string bytes = gzipped("one ") + gzipped("") + gzipped("two") + std::string(512, '\0');
    EXPECT_EQ(inflated_within(bytes, kPlenty).view(), "one two");
}

TEST(Gzip, BrokenFiles) {
    const std::string good = gzipped(std::string(1000, 'y').append("end"));
    for (std::size_t size = 2; size < good.size(); ++size)
        EXPECT_EQ(reason(std::string_view(good).substr(0, size), kPlenty), "its gzip data ends early")
            << size;
    std::string wrong_checksum = good;
    wrong_checksum[good.size() - 5] ^= 1;
    EXPECT_EQ(reason(wrong_checksum, kPlenty), "its gzip data is broken: incorrect data check");
    EXPECT_EQ(reason(good + "garbage", kPlenty), "its gzip data is broken: incorrect header check");
}

TEST(Gzip, TheLimitIsExact) {
    const std::string bomb = gzipped(std::string(1 << 20, '\0'));
    EXPECT_LT(bomb.size(), 1100u);
    EXPECT_EQ(inflated_within(bomb, 1 << 20).view().size(), std::size_t{1} << 20);
    EXPECT_EQ(reason(bomb, (1 << 20) - 1), "too much");
    // Beyond what is free, a limit for the ratio holds.
    const std::string larger = gzipped(std::string(2 << 20, '\0'));
    EXPECT_EQ(reason(larger, kPlenty),
              "decompresses to more than 100 times its size; decompress it (gunzip) if this is intended");
}

class CompressedScene : public SceneTest {};

TEST_F(CompressedScene, LoadsWhateverItsName) {
    write("part.pbrt.gz", gzipped(kTriangle));
    write("part.pbrt", gzipped(kTriangle));
    EXPECT_EQ(load("Include \"part.pbrt\" Include \"part.pbrt.gz\"").triangles.size(), 2u);
    EXPECT_EQ(load(gzipped(kTriangle)).triangles.size(), 1u);
}

TEST_F(CompressedScene, BrokenOnesAreNamed) {
    write("part.pbrt.gz", gzipped(kTriangle).substr(0, 30));
    EXPECT_EQ(error("Include \"part.pbrt.gz\""),
              "scene.pbrt:1: scene file 'part.pbrt.gz': its gzip data ends early");
    write("part.pbrt.gz", gzipped(gzipped(kTriangle)));
    EXPECT_EQ(error("Include \"part.pbrt.gz\""),
              "scene.pbrt:1: scene file 'part.pbrt.gz': compressed twice; decompress it once (gunzip)");
}

} // namespace
} // namespace nusselt::scene
