// Tokens, parameters, directives, blocks and includes, good and bad.

#include "scene_fixture.h"

namespace nusselt::scene {
namespace {

class Syntax : public SceneTest {};

TEST_F(Syntax, CommentsBracketsAndWhiteSpaceAreFree) {
    const Scene scene = load("# a comment with \"quotes\" and [ brackets\n"
                             "WorldBegin Shape\"trianglemesh\"\"point3   P\"[0 0 0 1 0 0 0 1 0]# end\r\n"
                             "\t\"integer indices\"[ 0 1 2 ]");
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.warnings.size(), 1u); // no camera
}

TEST_F(Syntax, ByteOrderMarkIsSkipped) {
    EXPECT_EQ(load("\xef\xbb\xbf" + std::string(kTriangle)).triangles.size(), 1u);
}

TEST_F(Syntax, NumbersInAllSpellings) {
    const Scene scene =
        load(R"(Shape "trianglemesh" "point3 P" [ +1 -4.65661e-010 .5  1.e2 -0 7E-1  1e-60 2 3 ])");
    ASSERT_EQ(scene.positions.size(), 3u);
    EXPECT_FLOAT_EQ(scene.positions[0].x, 1);
    EXPECT_FLOAT_EQ(scene.positions[0].y, -4.65661e-10f);
    EXPECT_FLOAT_EQ(scene.positions[0].z, 0.5f);
    EXPECT_FLOAT_EQ(scene.positions[1].x, 100);
    EXPECT_FLOAT_EQ(scene.positions[1].z, 0.7f);
    EXPECT_EQ(scene.positions[2].x, 0); // far below the smallest float
}

TEST_F(Syntax, BadNumbersNameFileLineAndValue) {
    EXPECT_EQ(error("\nShape \"trianglemesh\"\n\"point3 P\" [0 0 zero]"),
              "scene.pbrt:3: expected a number, found 'zero'");
    EXPECT_EQ(error("Translate 1 2 1e999"), "scene.pbrt:1: number out of range: '1e999'");
    EXPECT_EQ(error("Translate 1 2 nan"), "scene.pbrt:1: number out of range: 'nan'");
    EXPECT_EQ(error("Translate 1 2 1x"), "scene.pbrt:1: expected a number, found '1x'");
    EXPECT_EQ(error("Translate 1 2"), "scene.pbrt:1: expected a number, found the end of the file");
    EXPECT_EQ(error("Translate 1 \"2\" 3"), "scene.pbrt:1: expected a number, found \"2\"");
    EXPECT_EQ(error("Shape \"trianglemesh\" \"point3 P\" [0 0 0\nShape \"cone\""),
              "scene.pbrt:2: expected a number, found 'Shape'");
}

TEST_F(Syntax, BadTokensAndLists) {
    EXPECT_EQ(error("Shape \"tri\nanglemesh\""), "scene.pbrt:1: string without closing quote: \"tri");
    EXPECT_EQ(error("Shape trianglemesh"), "scene.pbrt:1: expected a quoted string, found 'trianglemesh'");
    EXPECT_EQ(error("Shape \"trianglemesh\" \"P\" [0]"),
              "scene.pbrt:1: expected a parameter \"type name\", found \"P\"");
    EXPECT_EQ(error("Shape \"trianglemesh\" \"point3 P\" [0 0 0"),
              "scene.pbrt:1: parameter \"point3 P\": ']' is missing");
    EXPECT_EQ(error("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1]"),
              "scene.pbrt:1: parameter \"point3 P\": 4 values cannot be grouped into 3 components each");
    EXPECT_EQ(error("Shape \"trianglemesh\" \"point3 P\" [[0 0 0]]"),
              "scene.pbrt:1: parameter \"point3 P\": expected a number, found '['");
    EXPECT_EQ(error("\n\n17 4"), "scene.pbrt:3: expected a directive, found '17'");
    EXPECT_EQ(error("]"), "scene.pbrt:1: expected a directive, found ']'");
    EXPECT_EQ(error("Material \"matte\" \"rgb Kd\" [1 2] " + std::string(kTriangle)),
              "scene.pbrt:1: parameter \"rgb Kd\": expected 3 numbers, found 2");
    EXPECT_EQ(error("Film \"rgb\" \"integer xresolution\" [2.5]"),
              "scene.pbrt:1: parameter \"integer xresolution\": expected an integer, found 2.5");
    EXPECT_EQ(error("Film \"rgb\" \"integer xresolution\" [2 3]"),
              "scene.pbrt:1: parameter \"integer xresolution\": expected 1 value(s), found 2");
    EXPECT_EQ(error("Film \"rgb\" \"string filename\" [2]"),
              "scene.pbrt:1: parameter \"string filename\": expected a quoted string, found '2'");
    EXPECT_EQ(error("AreaLightSource \"diffuse\" \"bool twosided\" [yes]"),
              "scene.pbrt:1: parameter \"bool twosided\": expected true or false, found 'yes'");
}

TEST_F(Syntax, BooleansOfBothVersions) {
    for (const std::string value : {"true", "[ true ]", "\"true\"", "[ \"true\" ]"}) {
        const Scene scene =
            load("AreaLightSource \"diffuse\" \"bool twosided\" " + value + "\n" + std::string(kTriangle));
        ASSERT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
        EXPECT_TRUE(scene.lights.of<PolygonLight>()[0].two_sided) << value;
    }
}

TEST_F(Syntax, StringsResolveEscapes) {
    EXPECT_EQ(load("Film \"rgb\" \"string filename\" \"a\\\"b\\\\c\\q.exr\"").film.filename,
              "a\"b\\c\\q.exr");
}

TEST_F(Syntax, UnknownThingsAreWarnedOfOnceWithTheirLine) {
    const Scene scene =
        load("Camera \"perspective\"\n"
             "Mystery \"x\" [1 2] 3 true \"float y\" 4\n"
             "Mystery \"x\"\n"
             "Sampler \"halton\" \"integer pixelsamples\" 4 Integrator \"path\" Accelerator \"bvh\"\n"
             "ColorSpace \"srgb\" Option \"string msereferenceimage\" \"x\"\n"
             "LightSource \"laser\" \"rgb L\" [1 1 1]\n"
             "Shape \"cone\" \"float radius\" 2\n"
             "Shape \"cone\" \"float radius\" 3\n" +
             std::string(kTriangle) + "\"float fuzz\" 3 \"spline knots\" [1 2]\n");
    ASSERT_EQ(scene.warnings.size(), 5u);
    EXPECT_EQ(without_folder(scene.warnings[0]), "scene.pbrt:2: directive 'Mystery' is unknown and ignored");
    EXPECT_EQ(without_folder(scene.warnings[1]),
              "scene.pbrt:7: unsupported shapes are skipped, starting here: 2 \"cone\"");
    EXPECT_EQ(without_folder(scene.warnings[2]),
              "scene.pbrt:6: unsupported light sources are skipped, starting here: 1 \"laser\"");
    EXPECT_EQ(without_folder(scene.warnings[3]),
              "scene.pbrt:10: shape \"trianglemesh\": parameter \"float fuzz\" is unknown and ignored");
    EXPECT_EQ(without_folder(scene.warnings[4]),
              "scene.pbrt:10: shape \"trianglemesh\": parameter \"spline knots\" is unknown and ignored");
    EXPECT_EQ(scene.triangles.size(), 1u);
}

/// pbrt v4 has a name and one value; some files have a type and brackets as in parameters.
TEST_F(Syntax, OptionsAreANameAndAValue) {
    const Scene scene = load("Option \"disablepixeljitter\" false\n"
                             "Option \"displacementedgescale\" 2.5\n"
                             "Option \"bool forcediffuse\" [ false ]\n"
                             "Option \"string msereferenceimage\" \"x.exr\"\n"
                             "Camera \"perspective\" WorldBegin\n" +
                             std::string(kTriangle));
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_NE(error("Option \"seed\"").find("scene.pbrt:1: Option: expected a value"), std::string::npos);
    EXPECT_NE(error("Option \"seed\" [ 1").find("not closed"), std::string::npos);
}

TEST_F(Syntax, OptionsThatMatterAreWarnedOf) {
    const std::pair<const char*, const char*> cases[] = {
        {"\"disablepixeljitter\" true", "Option \"disablepixeljitter\" is ignored; `--pixel-center` sends "
                                        "camera rays through pixel centres"},
        {"\"integer seed\" [ 7 ]", "Option \"integer seed\" is ignored; `--seed` chooses the random numbers"},
        {"\"force_diffuse\" true",
         "Option \"force_diffuse\" is ignored; `--brdf lambert` renders all materials as diffuse"},
        {"\"disabletexturefiltering\" true", "Option \"disabletexturefiltering\" is ignored; `\"string "
                                             "filter\" \"point\"` does the same for a texture"},
        {"\"nosuch\" 3", "Option \"nosuch\" is unknown and ignored"}};
    for (const auto& [option, warning] : cases) {
        const Scene scene = load("Option " + std::string(option) + "\nCamera \"perspective\"\nWorldBegin\n" +
                                 std::string(kTriangle));
        ASSERT_EQ(scene.warnings.size(), 1u) << option;
        EXPECT_EQ(without_folder(scene.warnings[0]), "scene.pbrt:1: " + std::string(warning));
    }
}

TEST_F(Syntax, WrongValuesOfOptionsAreErrors) {
    EXPECT_EQ(error("Option \"disablepixeljitter\" \"yes\""),
              "scene.pbrt:1: Option \"disablepixeljitter\": expected true or false, found \"yes\"");
    EXPECT_EQ(error("Option \"displacementedgescale\" 1x"),
              "scene.pbrt:1: Option \"displacementedgescale\": expected a number, found '1x'");
    EXPECT_EQ(error("Option \"seed\" [ 1 2 ]"),
              "scene.pbrt:1: Option \"seed\": expected a number, found 2 values");
    EXPECT_EQ(error("Option \"forcediffuse\"\nCamera \"perspective\""),
              "scene.pbrt:1: Option \"forcediffuse\": expected true or false, found 'Camera'");
}

TEST_F(Syntax, SamplersAreTakenAtTheirWord) {
    const auto warning = [&](const std::string& sampler) {
        const Scene scene =
            load("Sampler " + sampler + "\nCamera \"perspective\"\nWorldBegin\n" + std::string(kTriangle));
        return scene.warnings.empty() ? "" : without_folder(scene.warnings[0]);
    };
    EXPECT_EQ(warning("\"halton\" \"integer pixelsamples\" 4 \"integer seed\" 1"), "");
    EXPECT_EQ(warning("\"stratified\" \"integer xsamples\" 2 \"bool jitter\" true"), "");
    EXPECT_EQ(warning("\"halton\" \"float pixelsamples\" 4.5"),
              "scene.pbrt:1: Sampler: parameter \"float pixelsamples\" is unknown and ignored");
    EXPECT_EQ(warning("\"stratified\" \"integer pixelsamples\" 4"),
              "scene.pbrt:1: Sampler: parameter \"integer pixelsamples\" is unknown and ignored");
}

TEST_F(Syntax, WavelengthsOutOfOrderAreWarnedOf) {
    const auto load_light = [&](const std::string& samples) {
        return load("AreaLightSource \"diffuse\" \"spectrum L\" [" + samples + "]\n" +
                    std::string(kTriangle) + "Camera \"perspective\"");
    };
    const Scene sorted = load_light("400 1 500 2 600 3");
    const Scene mixed = load_light("500 2 600 3 400 1");
    EXPECT_TRUE(sorted.warnings.empty());
    ASSERT_EQ(mixed.warnings.size(), 1u);
    EXPECT_EQ(without_folder(mixed.warnings[0]),
              "scene.pbrt:1: parameter \"spectrum L\": the wavelengths are not in order; they are sorted");
    EXPECT_EQ(mixed.lights.of<PolygonLight>()[0].radiance.x, sorted.lights.of<PolygonLight>()[0].radiance.x);
}

TEST_F(Syntax, BlocksRestoreWhatTheyPromise) {
    const Scene scene =
        load("Camera \"perspective\" WorldBegin\n"
             "AttributeBegin\n"
             "  AreaLightSource \"diffuse\" Translate 1 0 0 ReverseOrientation\n"
             "  TransformBegin Translate 10 0 0 Material \"matte\" \"rgb Kd\" [1 0 0] TransformEnd\n" +
             std::string(kTriangle) + "AttributeEnd\n" + std::string(kTriangle) + "WorldEnd\n");
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.triangles.size(), 2u);
    // The transform block keeps its material but not its translation, the attribute block keeps nothing.
    EXPECT_EQ(scene.positions[0].x, 1);
    EXPECT_EQ(scene.positions[3].x, 0);
    EXPECT_EQ(scene.materials[scene.triangle_material[0]].diffuse.y, 0);
    EXPECT_EQ(scene.materials[scene.triangle_material[1]].diffuse.y, 0.5f);
    EXPECT_EQ(scene.triangle_light[0], 0);
    EXPECT_EQ(scene.triangle_light[1], -1);
    EXPECT_EQ(emitting_normal(scene.lights.of<PolygonLight>()[0]).z, -1);
}

TEST_F(Syntax, BlocksMustNest) {
    EXPECT_EQ(error("\nAttributeEnd"), "scene.pbrt:2: AttributeEnd without AttributeBegin");
    EXPECT_EQ(error("TransformBegin\nAttributeEnd"),
              "scene.pbrt:2: AttributeEnd inside the Transform block that begins at scene.pbrt:1");
    EXPECT_EQ(warning(load("Camera \"perspective\"\nAttributeBegin\n" + std::string(kTriangle))),
              "scene.pbrt:2: AttributeBegin has no matching End");
}

TEST_F(Syntax, IncludesAreRelativeToTheirFile) {
    write("parts/all.pbrt", "Include \"one.pbrt\"\nInclude \"parts/two.pbrt\"\n");
    write("parts/one.pbrt", kTriangle);
    write("parts/two.pbrt", kTriangle);
    EXPECT_EQ(load("Include \"parts/all.pbrt\"").triangles.size(), 2u);
}

TEST_F(Syntax, ErrorsInIncludesNameTheIncludedFile) {
    write("part.pbrt", "\n\nTranslate 1 a 2");
    EXPECT_EQ(error("Include \"part.pbrt\""), "part.pbrt:3: expected a number, found 'a'");
    EXPECT_EQ(error("\nInclude \"missing.pbrt\""), "scene.pbrt:2: scene file 'missing.pbrt': no such file");
    EXPECT_EQ(error("Include \".\""), "scene.pbrt:1: scene file '.': a folder, not a file");
}

TEST_F(Syntax, EndlessIncludesEnd) {
    EXPECT_EQ(error("Include \"scene.pbrt\""),
              "scene.pbrt:1: more than 32 nested includes; does 'scene.pbrt' include itself?");
}

TEST_F(Syntax, ImportLeavesTheStateAlone) {
    write("part.pbrt", "Translate 5 0 0\n" + std::string(kTriangle));
    const Scene scene = load("Import \"part.pbrt\"\n" + std::string(kTriangle));
    EXPECT_EQ(scene.positions[0].x, 5);
    EXPECT_EQ(scene.positions[3].x, 0);
}

TEST_F(Syntax, MissingMainFile) { EXPECT_THROW(load_scene(folder_ / "nothing.pbrt"), std::runtime_error); }

TEST_F(Syntax, EmptySceneIsLegal) {
    const Scene scene = load("Camera \"perspective\"");
    EXPECT_EQ(warning(scene), "scene.pbrt:1: the scene is empty");
    EXPECT_EQ(scene.radius, 0);
}

TEST_F(Syntax, MessagesAreOneShortLine) {
    const std::string name(100000, 'x');
    EXPECT_EQ(error("NamedMaterial \"" + name + '"'),
              "scene.pbrt:1: material \"" + name.substr(0, 60) + "...\" is not defined");
    EXPECT_EQ(error("Translate " + name),
              "scene.pbrt:1: expected a number, found '" + name.substr(0, 60) + "...'");
    EXPECT_EQ(error("CoordSysTransform \"a\\nb\""), "scene.pbrt:1: coordinate system \"a?b\" is not defined");
    EXPECT_EQ(error(std::string("\x01\0\x7f", 3)),
              "scene.pbrt:1: expected a directive, found '" + std::string(3, '?') + "'");
    EXPECT_EQ(error("Material \"matte\" \"texture Kd\" \"" + name + "\"\n" + std::string(kTriangle)),
              "scene.pbrt:1: texture \"" + name.substr(0, 991) + "...");
    // 59 bytes and one character of two bytes do not fit into 60.
    const std::string cut = name.substr(0, 59);
    EXPECT_EQ(error(cut + "\xc3\xa4\xc3\xa4"), "scene.pbrt:1: expected a directive, found '" + cut + "...'");
}

TEST_F(Syntax, WarningsAreLimited) {
    std::string text = "Camera \"perspective\"\n" + std::string(kTriangle);
    for (int i = 0; i < 1000; ++i) text += "Mystery" + std::to_string(i) + "\n";
    const Scene scene = load(text);
    ASSERT_EQ(scene.warnings.size(), 201u);
    EXPECT_EQ(without_folder(scene.warnings[199]),
              "scene.pbrt:202: directive 'Mystery199' is unknown and ignored");
    EXPECT_EQ(scene.warnings[200], "further kinds of warnings are not shown");
}

TEST_F(Syntax, BlocksInEachOtherAreLimited) {
    std::string text;
    for (int i = 0; i < 1000000; ++i) text += "AttributeBegin\n";
    EXPECT_EQ(error(text),
              "scene.pbrt:1025: more than 1024 nested blocks; add the missing AttributeEnd directives");
}

TEST_F(Syntax, RepeatedTextIsLimited) {
    write("large.inc", std::string(1 << 20, ' '));
    std::string text;
    for (int i = 0; i < 300; ++i) text += "Include \"large.inc\"\n";
    EXPECT_EQ(error(text), "scene.pbrt:34: repeated includes exceed 1000 files or 33554432 "
                           "bytes of text; use ObjectInstance for copies");
}

} // namespace
} // namespace nusselt::scene
