// The door for formats: the table of importers, and another format in it.

#include "gzip.h"
#include "scene/model/fingerprint.h"
#include "scene_fixture.h"
#include "toy_format/toy_importer.h"

#include <random>
#include <vector>

namespace nusselt::scene {
namespace {

/// The formats of the program, and the row of one more.
const std::vector<Importer>& formats() {
    static const std::vector<Importer> kFormats = [] {
        std::vector<Importer> all(importers().begin(), importers().end());
        all.push_back(kToyImporter);
        return all;
    }();
    return kFormats;
}

constexpr std::string_view kToyScene = R"(toy
# A floor, a panel, a tube, and two copies of an object with a light of its own.
film 40 30
camera 0 1 -5
mesh 0.5 0.25 0.75  -1 0 -1  -1 0 1  1 0 1  1 0 -1
light 3 2 1  -1 2 -1  1 2 -1  1 2 1  -1 2 1
tube 8 8 4  0 1 0  0 1 2  0.125
object lamp
mesh 0.5 0.5 0.5  0 0 0  0 1 0  1 0 0
light 1 2 3  0 0 0.5  1 0 0.5  0 1 0.5
end
instance lamp 3 0 0
instance lamp 0 0 4
)";

/// The same in pbrt's words.
constexpr std::string_view kPbrtScene = R"(Film "image" "integer xresolution" 40 "integer yresolution" 30
Translate 0 -1 5
Camera "perspective"
WorldBegin
Material "matte" "rgb Kd" [0.5 0.25 0.75]
Shape "trianglemesh" "point P" [-1 0 -1 -1 0 1 1 0 1 1 0 -1] "integer indices" [0 1 2 0 2 3]
AttributeBegin
ObjectBegin "lamp"
Material "matte" "rgb Kd" [0.5 0.5 0.5]
Shape "trianglemesh" "point P" [0 0 0 0 1 0 1 0 0] "integer indices" [0 1 2]
Material "none"
AreaLightSource "diffuse" "rgb L" [1 2 3]
Shape "trianglemesh" "point P" [0 0 0.5 1 0 0.5 0 1 0.5] "integer indices" [0 1 2]
ObjectEnd
Material "none"
AreaLightSource "diffuse" "rgb L" [3 2 1]
Shape "trianglemesh" "point P" [-1 2 -1 1 2 -1 1 2 1 -1 2 1] "integer indices" [0 1 2 0 2 3]
AreaLightSource "diffuse" "rgb L" [8 8 4]
Shape "line" "point3 p0" [0 1 0] "point3 p1" [0 1 2] "float radius" 0.125
AttributeEnd
Translate 3 0 0
ObjectInstance "lamp"
Translate -3 0 4
ObjectInstance "lamp"
)";

class Importers : public SceneTest {
protected:
    Scene load_file(const std::string& name, std::string_view text) const {
        write(name, text);
        return load_scene(folder_ / name, formats());
    }
    std::string error_of(const std::string& name, std::string_view text) const {
        try {
            load_file(name, text);
        } catch (const std::runtime_error& failure) {
            return without_folder(failure.what());
        }
        return "no error";
    }
    /// The error of a toy scene with this line only.
    std::string error_of_line(const std::string& line) const {
        return error_of("scene.toy", "toy\n\n" + line + "\n");
    }
};

TEST_F(Importers, OtherFormatsAreNamedWithWhatToDo) {
    struct Case {
        const char* file;
        std::string contents;
        const char* expected;
    };
    const Case cases[] = {
        {"a.gltf", "{\"asset\": {\"version\": \"2.0\"}}",
         "is a glTF file, which cannot be read as a scene; convert it"},
        {"a.glb", "glTF\2", "assimp export"},
        {"A.GLTF", "{}", "is a glTF file"},
        {"a.obj", "v 0 0 0\n", "is a Wavefront OBJ file, which cannot be read as a scene; convert it"},
        {"a.usda", "#usda 1.0\n", "is a USD file, which cannot be read as a scene; export it from Blender"},
        {"a.xml", "<scene version=\"3.0.0\"/>", "is a Mitsuba scene"},
        {"scene", "<scene version=\"3.0.0\"/>", "is a Mitsuba scene"},
        {"scene", "<?xml version=\"1.0\"?>\n<!-- A comment. -->\n<scene version=\"3.0.0\"/>",
         "is a Mitsuba scene"},
        {"model", "<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\"/>", "is a COLLADA file"},
        {"a.xml", "<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\"/>", "is a COLLADA file"},
        {"page", "<?xml version=\"1.0\"?>\n<html/>", "is an XML file"},
        {"page", "<?xml", "is an XML file"},
        {"a.blend", "BLENDER-v300RENDH", "is a file of Blender"},
        {"without-extension", "BLENDER-v300RENDH", "is a file of Blender"},
        {"compressed.blend", "\x28\xb5\x2f\xfd", "is a file of Blender"},
        {"a.PNG", "\x89PNG\r\n",
         "is a PNG image, which cannot be read as a scene; refer to it in a scene file with Texture"},
        {"picture", "\x76\x2f\x31\x01", "is an EXR image"},
        {"rig.json", "{}", "is a JSON file, which cannot be read as a scene; give a light rig to `--lights`"},
        {"a.obj.gz", gzipped("v 0 0 0\n"),
         "is a Wavefront OBJ file, which cannot be read as a scene; decompress"},
        {"a.obj.gz", gzipped("v 0 0 0\n"), "a.obj.gz`, and convert it with `assimp export "},
        {"a.gltf.gz", gzipped("{}"), "a.gltf a.pbrt`"},
        {"a.ply", "ply\nformat ascii 1.0\n", "refer to it in a scene file with Shape \"plymesh\""},
    };
    for (const Case& c : cases) {
        write(c.file, c.contents);
        try {
            load_scene(folder_ / c.file);
            ADD_FAILURE() << c.file << " is read";
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(c.expected), std::string::npos) << error.what();
        }
    }
}

TEST_F(Importers, HaveNamesAndExtensionsOfTheirOwn) {
    for (const Importer& a : formats()) {
        EXPECT_FALSE(a.name.empty());
        EXPECT_EQ(a.extension.front(), '.') << a.name;
        for (const Importer& b : formats())
            EXPECT_TRUE(&a == &b || (a.name != b.name && a.extension != b.extension)) << a.name;
    }
}

TEST_F(Importers, AnotherFormatGivesTheSameModel) {
    const Scene toy = load_file("scene.toy", kToyScene);
    EXPECT_TRUE(toy.warnings.empty());
    EXPECT_EQ(toy.film.width, 40);
    EXPECT_EQ(world_triangle_count(toy), 6u);
    ASSERT_EQ(toy.lights.of<PolygonLight>().size(), 3u);
    EXPECT_EQ(toy.lights.of<PolygonLight>()[0].vertices.size(), 4u); // merged
    EXPECT_EQ(emitting_normal(toy.lights.of<PolygonLight>()[0]).y, -1);
    ASSERT_EQ(toy.lights.of<LineLight>().size(), 1u);
    EXPECT_EQ(toy.lights.of<LineLight>()[0].radius, 0.125f);
    ASSERT_EQ(toy.objects.size(), 1u);
    EXPECT_EQ(toy.instances.size(), 2u);
    EXPECT_EQ(toy.materials.back().name, "black");

    std::vector<std::string> names;
    for (const Emitter& emitter : toy.emitters) names.push_back(emitter.name);
    EXPECT_EQ(names, (std::vector<std::string>{"light at scene.toy:6", "tube at scene.toy:7",
                                               "light at scene.toy:10", "light at scene.toy:10 #2"}));
}

TEST_F(Importers, ImagesDoNotDependOnTheFormat) {
    const Scene pbrt = load_file("scene.pbrt", kPbrtScene);
    EXPECT_TRUE(pbrt.warnings.empty());
    // The fingerprint covers all that images depend on.
    EXPECT_EQ(fingerprint(load_file("scene.toy", kToyScene)), fingerprint(pbrt));
}

TEST_F(Importers, TheExtensionTellsTheFormat) {
    EXPECT_EQ(load_file("scene.toy", "toy\n").film.width, 640);
    EXPECT_EQ(load_file("scene.toy.gz", gzipped("toy\n")).film.width, 640);
    EXPECT_EQ(error_of("scene.pbrt", "toy\n"), "scene.pbrt:1: expected a directive, found 'toy'");
}

TEST_F(Importers, ContentsTellTheFormatOfFilesWithOtherExtensions) {
    EXPECT_EQ(load_file("scene", kToyScene).lights.of<LineLight>().size(), 1u);
    EXPECT_EQ(load_file("scene.txt", kToyScene).lights.of<LineLight>().size(), 1u);
    EXPECT_EQ(load_file("scene.gz", gzipped(std::string(kToyScene))).lights.of<LineLight>().size(), 1u);
    EXPECT_EQ(load_file("scene.bak", "# a comment\n\n  " + std::string(kTriangle)).triangles.size(), 1u);
    EXPECT_EQ(load_file("pbrt.gz", gzipped(std::string(kTriangle))).triangles.size(), 1u);
}

TEST_F(Importers, UnknownFormatsAreNamedWithTheKnownOnes) {
    const std::string expected =
        "scene file 'scene.xyz': unknown format; use one of pbrt (.pbrt), toy (.toy)";
    EXPECT_EQ(error_of("scene.xyz", "v 0 0 0\n"), expected);
    EXPECT_EQ(error_of("scene.xyz", ""), expected);
    EXPECT_EQ(error_of("scene.xyz", "# only a comment"), expected);
    EXPECT_EQ(error_of("scene.xyz", std::string("\0\xff", 2)), expected);
    for (const char* mark : {"\xff\xfe", "\xfe\xff"})
        EXPECT_EQ(
            error_of("scene.pbrt", std::string(mark) + "W\x01o"),
            "scene file 'scene.pbrt': its text is in UTF-16; convert it with `iconv -f UTF-16 -t UTF-8`");
    // The program itself does not support the format of the tests.
    write("scene.toy", kToyScene);
    EXPECT_THROW(load_scene(folder_ / "scene.toy"), std::runtime_error);
}

TEST_F(Importers, FilesThatCannotBeRead) {
    for (const char* name : {"missing.pbrt", "missing.toy", "missing.obj", "missing"})
        EXPECT_THROW(load_scene(folder_ / name, formats()), std::runtime_error) << name;
    write("folder/scene.pbrt", "");
    try {
        load_scene(folder_ / "folder", formats());
        FAIL();
    } catch (const std::runtime_error& failure) {
        EXPECT_EQ(without_folder(failure.what()), "scene file 'folder': a folder, not a file");
    }
}

TEST_F(Importers, ErrorsNameFileAndLine) {
    EXPECT_EQ(error_of_line("sphere 1"), "scene.toy:3: sphere: unknown");
    EXPECT_EQ(error_of_line("camera 0 0"), "scene.toy:3: camera: expected a number, found ''");
    EXPECT_EQ(error_of_line("camera 0 0 up"), "scene.toy:3: camera: expected a number, found 'up'");
    EXPECT_EQ(error_of_line("camera 0 0 nan"), "scene.toy:3: camera: expected a number, found 'nan'");
    EXPECT_EQ(error_of_line("camera 0 0 0 0"), "scene.toy:3: camera: '0' is left over");
    EXPECT_EQ(error_of_line("film 0 1"), "scene.toy:3: film: a size lies between 1 and 65536");
    EXPECT_EQ(error_of_line("mesh 1 1 1  0 0 0  1 0 0"), "scene.toy:3: mesh: needs three vertices");
    EXPECT_EQ(error_of_line("instance lamp 0 0 0"), "scene.toy:3: instance: there is no object 'lamp'");
    EXPECT_EQ(error_of_line("light -1 1 1  0 0 0  1 0 0  0 1 0"),
              "scene.toy:3: light: radiance must be from 0 to 1e+30, found -1");
}

TEST_F(Importers, ErrorsOfTheBuilderNameFileAndLine) {
    EXPECT_EQ(error_of_line("mesh 1 1 1  0 0 0  1 0 0  0 1e16 0"),
              "scene.toy:3: shape \"mesh\": vertex 2 at (0, 10000000272564224, 0) must be finite and "
              "within 1e15 m");
    EXPECT_EQ(error_of_line("tube 1 1 1  0 0 0  0 0 0  1"),
              "scene.toy:3: shape \"tube\": the end points must differ");
    EXPECT_EQ(error_of_line("tube 1 1 1  0 0 0  0 0 1  0"),
              "scene.toy:3: shape \"tube\": radius must be positive and at most 1e15 m after the transform, "
              "found 0");
    EXPECT_EQ(error_of_line("object a\nmesh 1 1 1  0 0 0  1 0 0  0 1 0\nend\ninstance a 0 0 1e16"),
              "scene.toy:6: instance: the transform of object \"a\" is not invertible or exceeds 1e15");
    EXPECT_EQ(error_of_line("camera 1e16 0 0"),
              "scene.toy:3: camera: the position must be within 1e15 m of the origin");
}

TEST_F(Importers, WarningsOfTheBuilderNameFileAndLine) {
    EXPECT_EQ(warning(load_file("scene.toy", "toy\n")), "scene.toy:1: the scene is empty");
    EXPECT_EQ(warning(load_file("scene.toy",
                                "toy\nmesh 1 1 1  0 0 0  1 0 0  2 0 0\nmesh 1 1 1  0 0 0  1 0 0  0 1 0\n")),
              "scene.toy:2: 1 degenerate triangles are skipped, starting here");
}

TEST_F(Importers, DamagedFilesLoadOrNameALine) {
    std::minstd_rand engine(1);
    int errors = 0;
    for (int i = 0; i < 1000; ++i) {
        std::string text(kToyScene);
        for (int changes = 0; changes < 3; ++changes) {
            const std::size_t at = engine() % text.size();
            if (engine() % 2 == 0)
                text[at] = static_cast<char>(engine() % 256);
            else
                text.erase(at, 1 + engine() % 8);
        }
        try {
            const Scene scene = load_file("scene.toy", text);
            for (const std::uint32_t material : scene.triangle_material)
                ASSERT_LT(material, scene.materials.size());
        } catch (const SceneError& failure) {
            ++errors;
            ASSERT_EQ(without_folder(failure.what()).rfind("scene.toy:", 0), 0u) << failure.what();
        }
    }
    EXPECT_GT(errors, 500);
}

} // namespace
} // namespace nusselt::scene
