// Camera rays against the definition of pbrt, computed by hand.

#include "scene_fixture.h"

#include <cmath>

namespace nusselt::scene {
namespace {

class CameraDirectives : public SceneTest {
protected:
    Scene camera(const std::string& text) const {
        Scene scene = load(text + "\nWorldBegin\n" + std::string(kTriangle));
        EXPECT_TRUE(scene.warnings.empty());
        return scene;
    }
    static Float3 direction(const Scene& scene, double x, double y) {
        const Camera& c = scene.camera;
        return to_float(normalized(to_double(c.corner) + x * to_double(c.right) + y * to_double(c.down)));
    }
    static Float3 unit(double x, double y, double z) { return to_float(normalized({x, y, z})); }
};

TEST_F(CameraDirectives, DefaultLooksAlongZWithXToTheRightAndYUp) {
    const Scene scene = camera("Film \"image\" \"integer xresolution\" 100 \"integer yresolution\" 100\n"
                               "Camera \"perspective\"");
    expect_near(scene.camera.origin, {0, 0, 0}, 0);
    expect_near(direction(scene, 50, 50), {0, 0, 1}, 1e-6f);
    // Field of view 90 degrees.
    expect_near(direction(scene, 0, 0), unit(-1, 1, 1), 1e-6f);
    expect_near(direction(scene, 100, 100), unit(1, -1, 1), 1e-6f);
    expect_near(direction(scene, 0.5, 0.5), unit(-0.99, 0.99, 1), 1e-6f);
}

TEST_F(CameraDirectives, FieldOfViewIsThatOfTheShorterAxis) {
    const double t = std::tan(30 * std::acos(-1.0) / 180);
    const Scene wide = camera("Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100\n"
                              "Camera \"perspective\" \"float fov\" 60");
    expect_near(direction(wide, 0, 0), unit(-2 * t, t, 1), 1e-6f);
    expect_near(direction(wide, 150, 100), unit(t, -t, 1), 1e-6f);
    const Scene tall = camera("Camera \"perspective\" \"float fov\" 60\n"
                              "Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 400");
    expect_near(direction(tall, 0, 0), unit(-t, 4 * t, 1), 1e-6f);
    expect_near(direction(tall, 100, 200), unit(t, 0, 1), 1e-6f);
}

TEST_F(CameraDirectives, ScreenWindowAndAspectRatio) {
    const std::string film = "Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 100\n";
    const Scene window = camera(film + "Camera \"perspective\" \"float screenwindow\" [-1 3 -2 0.5]");
    expect_near(direction(window, 0, 0), unit(-1, 0.5, 1), 1e-6f);
    expect_near(direction(window, 100, 100), unit(3, -2, 1), 1e-6f);
    const Scene aspect = camera(film + "Camera \"perspective\" \"float frameaspectratio\" 0.5");
    expect_near(direction(aspect, 100, 0), unit(1, 2, 1), 1e-6f);
    const Scene half = camera(film + "Camera \"perspective\" \"float halffov\" 45");
    expect_near(direction(half, 100, 0), unit(1, 1, 1), 1e-6f);
}

TEST_F(CameraDirectives, LookAtIsLeftHanded) {
    // Looking along -z with y up: pbrt's camera space is left-handed, so +x of the image is -x of the world.
    const Scene scene = camera("Film \"image\" \"integer xresolution\" 10 \"integer yresolution\" 10\n"
                               "LookAt 1 2 3  1 2 -5  0 1 0 Camera \"perspective\"");
    expect_near(scene.camera.origin, {1, 2, 3}, 1e-6f);
    expect_near(direction(scene, 5, 5), {0, 0, -1}, 1e-6f);
    expect_near(direction(scene, 10, 0), unit(-1, 1, -1), 1e-6f);
}

TEST_F(CameraDirectives, MirroredBeforeLookAt) {
    const Scene scene = camera("Film \"image\" \"integer xresolution\" 10 \"integer yresolution\" 10\n"
                               "Scale -1 1 1 LookAt 1 2 3  1 2 -5  0 1 0 Camera \"perspective\"");
    expect_near(scene.camera.origin, {1, 2, 3}, 1e-6f);
    expect_near(direction(scene, 10, 0), unit(1, 1, -1), 1e-6f);
}

TEST_F(CameraDirectives, TransformAndTranslationAreFromWorldToCamera) {
    const Scene scene = camera("Film \"image\" \"integer xresolution\" 10 \"integer yresolution\" 10\n"
                               "Rotate 90 0 1 0 Translate -4 -5 -6 Camera \"perspective\"");
    expect_near(scene.camera.origin, {4, 5, 6}, 1e-6f);
    // Camera z is the world direction that a quarter turn about y takes to z: -x... (z -> x, x -> -z).
    expect_near(direction(scene, 5, 5), {-1, 0, 0}, 1e-6f);
    expect_near(direction(scene, 10, 5), unit(-1, 0, 1), 1e-6f);
}

TEST_F(CameraDirectives, FilmDefaultsDependOnTheVersion) {
    EXPECT_EQ(camera("Camera \"perspective\" Film \"image\"").film.width, 640);
    EXPECT_EQ(camera("Camera \"perspective\" Film \"image\"").film.height, 480);
    EXPECT_EQ(camera("Camera \"perspective\" Film \"rgb\"").film.width, 1280);
    EXPECT_EQ(camera("Camera \"perspective\" Film \"rgb\" \"string filename\" \"x.exr\"").film.filename,
              "x.exr");
}

TEST_F(CameraDirectives, SamplersGiveTheSamplesPerPixel) {
    const auto samples = [&](const std::string& sampler) {
        return camera("Camera \"perspective\"\nSampler " + sampler + "\nFilm \"rgb\"").film.pixel_samples;
    };
    EXPECT_EQ(camera("Camera \"perspective\"").film.pixel_samples, std::nullopt);
    EXPECT_EQ(samples("\"halton\""), std::nullopt);
    EXPECT_EQ(samples("\"halton\" \"integer pixelsamples\" 128"), 128);
    EXPECT_EQ(samples("\"zsobol\" \"integer pixelsamples\" [ 16 ] \"integer seed\" 3"), 16);
    EXPECT_EQ(samples("\"stratified\""), std::nullopt);
    EXPECT_EQ(samples("\"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 5"), 15);
    EXPECT_EQ(samples("\"stratified\" \"integer ysamples\" 5"), 20);
    EXPECT_EQ(samples("\"stratified\" \"integer xsamples\" 2147483647 \"integer ysamples\" 2147483647"),
              2147483647);
    for (const std::string number : {"0", "-7"}) {
        const Scene scene = load("Camera \"perspective\"\nSampler \"sobol\" \"integer pixelsamples\" " +
                                 number + "\nWorldBegin\n" + std::string(kTriangle));
        EXPECT_EQ(scene.film.pixel_samples, std::nullopt);
        EXPECT_EQ(warning(scene), "scene.pbrt:2: Sampler: pixelsamples is " + number +
                                      ", but must be positive; it is ignored");
    }
}

TEST_F(CameraDirectives, OrthographicRaysAreParallel) {
    const Scene scene = camera("Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100\n"
                               "LookAt 0 0 10  0 0 0  0 1 0 Camera \"orthographic\"");
    const Camera& c = scene.camera;
    const auto origin = [&](double x, double y) {
        return to_float(to_double(c.origin) + x * to_double(c.origin_right) + y * to_double(c.origin_down));
    };
    expect_near(direction(scene, 0, 0), {0, 0, -1}, 1e-6f);
    expect_near(direction(scene, 17, 93), {0, 0, -1}, 1e-6f);
    // Looking along -z with y up, +x of the image is -x of the world.
    expect_near(origin(100, 50), {0, 0, 10}, 1e-6f);
    expect_near(origin(0, 0), {2, 1, 10}, 1e-6f);
    expect_near(origin(200, 100), {-2, -1, 10}, 1e-6f);
}

TEST_F(CameraDirectives, CropsOfTheWholeFilmAreNone) {
    const std::string film = "Camera \"perspective\" Film \"rgb\" ";
    EXPECT_FALSE(camera(film).film.crop);
    EXPECT_FALSE(camera(film + "\"float cropwindow\" [0 1 0 1]").film.crop);
    EXPECT_FALSE(camera(film + "\"integer pixelbounds\" [-9 9999 0 720]").film.crop);
    EXPECT_TRUE(camera(film + "\"float cropwindow\" [0 1 0 0.99]").film.crop);
    // The rays of a crop are those of the whole film.
    EXPECT_EQ(camera(film + "\"float cropwindow\" [0.5 1 0 0.5]").camera.corner.x,
              camera(film).camera.corner.x);
}

TEST_F(CameraDirectives, Errors) {
    EXPECT_EQ(error("\nCamera \"spherical\""),
              "scene.pbrt:2: camera \"spherical\" is not supported; use \"perspective\" or \"orthographic\"");
    EXPECT_EQ(error("Camera \"perspective\"\n\"float fov\" 180"),
              "scene.pbrt:2: camera: fov must lie between 0 and 180 degrees, found 180");
    EXPECT_EQ(error("Camera \"perspective\" \"float screenwindow\" [1 2 3]"),
              "scene.pbrt:1: camera: screenwindow must be x min, x max, y min, y max");
    EXPECT_EQ(error("Camera \"perspective\" \"float frameaspectratio\" -2"),
              "scene.pbrt:1: camera: frameaspectratio must be positive, found -2");
    EXPECT_EQ(error("Scale 1 1 0 Camera \"perspective\""),
              "scene.pbrt:1: camera: the transform is not invertible");
    EXPECT_EQ(error("Translate 1e20 0 0 Camera \"perspective\""),
              "scene.pbrt:1: camera: the position must be within 1e15 m of the origin");
    EXPECT_EQ(error("Film \"rgb\" \"integer yresolution\" 0"),
              "scene.pbrt:1: film: yresolution must lie between 1 and 65536, found 0");
}

TEST_F(CameraDirectives, Warnings) {
    EXPECT_EQ(warning(load(std::string(kTriangle))),
              "scene.pbrt:1: Camera is missing; the default camera looks from the origin along +z");
    EXPECT_EQ(warning(load("Camera \"perspective\" \"float lensradius\" 0.1\n" + std::string(kTriangle))),
              "scene.pbrt:1: camera: lensradius is ignored; everything is in focus");
}

} // namespace
} // namespace nusselt::scene
