// Limits on all files of a scene together, and on what loading takes.

#include "base/process_time.h"
#include "common/process_memory.h"
#include "gzip.h"
#include "scene/build/textures/emission_images.h"
#include "scene/build/textures/texture_bake.h"
#include "scene/input/json_node.h"
#include "scene/model/limits.h"
#include "scene/model/scene_size.h"
#include "scene_fixture.h"

#include <array>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <random>

namespace nusselt::scene {
namespace {

template <class Action>
std::string reason(const Action& action) {
    try {
        action();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "no error";
}

class Limits : public SceneTest {
protected:
    /// A bitmap in one colour.
    void write_image(const std::string& name, int width, int height) const {
        std::string bytes = "PF\n" + std::to_string(width) + ' ' + std::to_string(height) + "\n-1\n";
        const float texel[3] = {0.25f, 0.5f, 1};
        for (int i = 0; i < width * height; ++i)
            bytes.append(reinterpret_cast<const char*>(texel), sizeof texel);
        write(name, bytes);
    }
    ImageRequest request(const std::string& name) const {
        ImageRequest result;
        result.path = folder_ / name;
        result.encoding = ImageRequest::kLinear;
        result.location = {&source_, 7};
        return result;
    }

    SourceFile source_ = {"scene.pbrt", {}};
    Warnings warnings_;
};

TEST_F(Limits, BudgetsEnd) {
    Budget budget(10, "all gone");
    budget.take(10);
    budget.take(0);
    EXPECT_EQ(reason([&] { budget.take(1); }), "all gone");
    Budget other(10, "all gone");
    EXPECT_EQ(reason([&] { other.take(~std::uint64_t{0}); }), "all gone");
    EXPECT_EQ(reason([&] { other.take(1); }), "all gone");
}

TEST_F(Limits, CompressedFilesShareABudget) {
    write("a", gzipped(std::string(600, 'a')));
    write("b", gzipped(std::string(600, 'b')));
    write("c", std::string(2000, 'c'));
    Budget budget(1000, "all gone");
    EXPECT_EQ(FileBytes(folder_ / "a", budget).view(), std::string(600, 'a'));
    EXPECT_EQ(FileBytes(folder_ / "c", budget).view(), std::string(2000, 'c'));
    EXPECT_EQ(reason([&] { FileBytes(folder_ / "b", budget); }), "all gone");
}

TEST_F(Limits, JsonIsCountedAfterDecompression) {
    // Digits here and there keep the ratio below its own limit.
    std::string text(kMaxJsonBytes + 1, ' ');
    std::minstd_rand engine(1);
    for (std::size_t i = 0; i < text.size(); i += 64) text[i] = static_cast<char>('0' + engine() % 10);
    write("rig.json", gzipped(text));
    EXPECT_EQ(without_folder(reason([&] { read_json(folder_ / "rig.json"); })),
              "rig.json: decompresses to more than 268435456 bytes");
}

TEST_F(Limits, MeshesThatAreReadAgain) {
    // It claims 3 GiB.
    write("mesh.ply", gzipped("ply\n").substr(0, 20) + std::string("\0\0\0\xc0", 4));
    const std::string shape = "Shape \"plymesh\" \"string filename\" \"mesh.ply\"\n";
    EXPECT_EQ(error(shape + shape + shape),
              "scene.pbrt:3: repeated mesh files exceed 4294967296 bytes in total; the last one is "
              "'mesh.ply'; use ObjectInstance for copies");
    EXPECT_NE(error(shape + shape).find("scene.pbrt:1: mesh file 'mesh.ply'"), std::string::npos);
}

TEST_F(Limits, CopiesOfLightsFromCompressedMeshes) {
    // 2^31 bytes are eight times as many numbers as are allowed.
    write("mesh.ply", gzipped("ply\n").substr(0, 20) + std::string("\0\0\0\x80", 4));
    EXPECT_EQ(error("ObjectBegin \"lamp\" AreaLightSource \"diffuse\"\n"
                    "Shape \"plymesh\" \"string filename\" \"mesh.ply\" ObjectEnd\nObjectInstance \"lamp\""),
              "scene.pbrt:3: instances have more than 131072 shapes that emit light, or more than 67108864 "
              "numbers in these; move lights out of objects");
}

TEST_F(Limits, ImagesShareABudgetOfTexels) {
    write_image("image.pfm", 8, 4);
    SceneBudget budget{{0, "no files"}, {63, "too many texels"}};
    EXPECT_EQ(decode_image(request("image.pfm"), budget, warnings_).width, 8);
    EXPECT_EQ(without_folder(reason([&] { decode_image(request("image.pfm"), budget, warnings_); })),
              "scene.pbrt:7: texture file 'image.pfm': too many texels");
}

TEST_F(Limits, ImagesOfCodesAreChargedBefore) {
    // An uncompressed grey TGA of 8 x 4.
    write("image.tga", std::string("\0\0\3\0\0\0\0\0\0\0\0\0\10\0\4\0\10\0", 18) + std::string(32, 'g'));
    SceneBudget budget{{0, "no files"}, {63, "too many texels"}};
    EXPECT_EQ(decode_image(request("image.tga"), budget, warnings_).width, 8);
    EXPECT_EQ(without_folder(reason([&] { decode_image(request("image.tga"), budget, warnings_); })),
              "scene.pbrt:7: texture file 'image.tga': too many texels");
}

TEST_F(Limits, TexturesThatAreMadeOfImagesCountToo) {
    write_image("image.pfm", 8, 4);
    TexturePlan plan;
    plan.images = {request("image.pfm")};
    TextureNode leaf;
    leaf.operation = TextureOperation::image;
    leaf.image = 0;
    plan.nodes = {leaf};
    const Location location = {&source_, 9};
    plan.requests = {{0, 3, location}, {0, 1, location}};
    // The image, and a copy for each of the two requests.
    SceneBudget enough{{0, "no files"}, {3 * 32, "too many texels"}};
    EXPECT_EQ(bake_textures(plan, enough, warnings_).size(), 2u);
    SceneBudget scarce{{0, "no files"}, {3 * 32 - 1, "too many texels"}};
    EXPECT_EQ(reason([&] { bake_textures(plan, scarce, warnings_); }), "scene.pbrt:9: too many texels");
}

TEST_F(Limits, ImagesOfLightsAreDecodedOnce) {
    write_image("image.pfm", 8, 4);
    SceneBudget budget{{0, "no files"}, {32, "too many texels"}};
    EmissionImages images;
    for (int i = 0; i < 3; ++i)
        expect_near(mean_texel(*images.read(request("image.pfm"), budget, warnings_)), {0.25f, 0.5f, 1},
                    1e-6f);
}

TEST_F(Limits, CountsThatIndicesTellApart) {
    check_counts(kMaxVertices, kMaxTriangles, "ObjectInstance");
    EXPECT_EQ(reason([] { check_counts(kMaxVertices + 1, 1, "ObjectInstance"); }),
              "the scene has more than 4294967294 vertices; use ObjectInstance for copies, or simplify it");
    EXPECT_EQ(reason([] { check_counts(3, std::size_t{1} << 31, "ObjectInstance"); }),
              "the scene has more than 2147483647 triangles; use ObjectInstance for copies, or simplify it");
}

// ---- The memory and the time of very many lights

constexpr int kLights = 100'000;

// A million lights may take 0.4 GB. The sanitizers need more of both.
constexpr double kMaxBytes = 40e6;
constexpr double kMaxSeconds = nusselt_test::kHasSanitizer ? 60 : 2;

std::string numbers(std::initializer_list<double> values) {
    std::string text;
    for (const double value : values) text += to_text(value) + " ";
    return text;
}

/// The corners of a small quad, one of a grid.
std::array<std::string, 4> corners(int i) {
    const double x = 0.01 * (i % 1000);
    const double y = 0.01 * (i / 1000);
    return {numbers({x, y, 1}), numbers({x + 0.004, y, 1}), numbers({x + 0.004, y + 0.004, 1}),
            numbers({x, y + 0.004, 1})};
}

constexpr const char* kEmission = "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n";

std::string in_block(const std::string& shape) {
    return std::string("AttributeBegin\n") + kEmission + shape + "AttributeEnd\n";
}

std::string quad(int i) {
    const auto [a, b, c, d] = corners(i);
    return in_block("Shape \"trianglemesh\" \"point3 P\" [" + a + b + c + d +
                    "] \"integer indices\" [0 1 2 0 2 3]\n");
}

std::string patch(int i) {
    const auto [a, b, c, d] = corners(i);
    return in_block("Shape \"bilinearmesh\" \"point3 P\" [" + a + b + d + c + "]\n");
}

std::string tube(int i) {
    const auto [a, b, c, d] = corners(i);
    return in_block("Shape \"line\" \"point3 p0\" [" + a + "] \"point3 p1\" [" + b +
                    "] \"float radius\" 0.001\n");
}

std::string repeated(const std::function<std::string(int)>& shape) {
    std::string text;
    for (int i = 0; i < kLights; ++i) text += shape(i);
    return text;
}

std::string one_mesh() {
    std::string points;
    std::string indices;
    for (int i = 0; i < kLights; ++i) {
        for (const std::string& corner : corners(i)) points += corner;
        for (const int k : {0, 1, 2, 0, 2, 3}) indices += std::to_string(4 * i + k) + " ";
    }
    return std::string(kEmission) + "Shape \"trianglemesh\" \"point3 P\" [" + points +
           "] \"integer indices\" [" + indices + "]\n";
}

class ManyLights : public SceneTest {
protected:
    /// Loads a scene in a process of its own, which has not used any memory before.
    void expect_frugal(const std::string& text, std::size_t emitters, double max_bytes = kMaxBytes) const {
        write("one.pbrt", quad(0));
        write("scene.pbrt", text);
        GTEST_FLAG_SET(death_test_style, "threadsafe");
        EXPECT_EXIT(load_frugally(emitters, max_bytes), testing::ExitedWithCode(0), "");
    }

private:
    void load_frugally(std::size_t emitters, double max_bytes) const {
        load_scene(folder_ / "one.pbrt"); // what any scene takes, such as pages of the program
        const double bytes_before = nusselt_test::process_memory("VmRSS");
        const double seconds_before = base::process_seconds();
        const Scene scene = load_scene(folder_ / "scene.pbrt");
        const double bytes = nusselt_test::process_memory("VmHWM") - bytes_before;
        const double seconds = base::process_seconds() - seconds_before;
        std::fprintf(stderr, "%g MB, %g s\n", 1e-6 * bytes, seconds);
        const bool is_complete = scene.lights.size() == kLights && scene.emitters.size() == emitters;
        const double byte_limit = nusselt_test::kHasSanitizer ? 1e9 : max_bytes;
        std::exit(is_complete && bytes <= byte_limit && seconds <= kMaxSeconds ? 0 : 1);
    }
};

TEST_F(ManyLights, QuadsTakeLittleMemory) { expect_frugal(repeated(quad), kLights); }
// Measured: 41 MB. Each patch lives twice for a while, as it was read and as the mesh of its pieces.
TEST_F(ManyLights, BilinearPatchesTakeLittleMemory) { expect_frugal(repeated(patch), kLights, 43e6); }
TEST_F(ManyLights, TubesTakeLittleMemory) { expect_frugal(repeated(tube), kLights); }
TEST_F(ManyLights, OneMeshTakesLittleMemory) { expect_frugal(one_mesh(), 1); }

} // namespace
} // namespace nusselt::scene
