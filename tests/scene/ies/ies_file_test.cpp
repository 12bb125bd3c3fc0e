// What the reader makes of the fields of IES files.

#include "../gzip.h"
#include "../scene_fixture.h"
#include "ies_text.h"

#include <gtest/gtest.h>

namespace nusselt::scene::test {
namespace {

const Intensity kConstant = [](const Double3&) { return 100.0; };

IesFile read(const IesText& text) { return parse(text.text(kConstant)); }

TEST(IesFile, Versions) {
    const std::pair<const char*, int> cases[] = {{"", 1986},
                                                 {"IES is not at the begin of a version\n", 1986},
                                                 {"IESNA91\n", 1991},
                                                 {"IESNA:LM-63-1995\n", 1995},
                                                 {" iesna: LM-63-95 \r\n", 1995},
                                                 {"IESNA:LM-63-2002\n", 2002},
                                                 {"\xef\xbb\xbfIESNA:LM-63-2002\n", 2002},
                                                 {"IES:LM-63-2019\n", 2019}};
    for (const auto& [line, version] : cases) EXPECT_EQ(read({.first_line = line}).version, version) << line;
}

TEST(IesFile, FieldTwelveDependsOnTheVersion) {
    const auto file = [](const char* line) {
        return read({.first_line = line, .multiplier = 2, .ballast_factor = 0.5, .field_12 = 1.25});
    };
    for (const char* const line : {"", "IESNA91\n"}) {
        EXPECT_EQ(file(line).multiplier, 1.25) << line;
        EXPECT_EQ(file(line).candelas[0], 125) << line;
        EXPECT_FALSE(file(line).generation) << line;
    }
    for (const char* const line : {"IESNA:LM-63-1995\n", "IESNA:LM-63-2002\n", "IES:LM-63-2019\n"})
        EXPECT_EQ(file(line).multiplier, 1) << line;
    EXPECT_FALSE(file("IESNA:LM-63-2002\n").generation);
    EXPECT_EQ(file("IES:LM-63-2019\n").generation, 1.25);
}

TEST(IesFile, LampsDoNotMultiply) {
    const IesFile file = read({.lamps = "4.0, 1500"});
    EXPECT_EQ(file.lamps, 4u);
    EXPECT_EQ(file.lumens_per_lamp, 1500);
    EXPECT_EQ(file.multiplier, 1);
    EXPECT_EQ(file.input_watts, 100);
}

TEST(IesFile, KeywordsAndLineEnds) {
    const std::string unix_text =
        IesText{.label = "[TEST] 17\n[manufac]  Lamps & Sons \nno keyword\n[MORE\n"}.text(kConstant);
    std::string dos_text;
    for (const char c : unix_text) dos_text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    for (const std::string& text : {unix_text, dos_text, dos_text + '\x1a', unix_text + "\n \n"}) {
        const IesFile file = parse(text);
        ASSERT_EQ(file.keywords.size(), 2u);
        EXPECT_EQ(file.keywords[1], (std::pair<std::string, std::string>("MANUFAC", "Lamps & Sons")));
        EXPECT_EQ(file.candelas.size(), 37u);
    }
}

TEST(IesFile, NumbersInAllNotations) {
    const IesFile file = parse("TILT=NONE\n1.0,-1.0 , +1.E0\t3.0,2.0 1.0\n2\n0 0\n0,1 1\n0\n"
                               "0.0 45. 9.0e+1\n0,180.0\n.5e1,+4\n\n3,,2 1 0");
    EXPECT_EQ(file.vertical, (std::vector<double>{0, 45, 90}));
    EXPECT_EQ(file.horizontal, (std::vector<double>{0, 180}));
    EXPECT_EQ(file.candelas, (std::vector<double>{5, 4, 3, 2, 1, 0}));
}

TEST(IesFile, SymmetriesOfTypeC) {
    const auto symmetry = [](const std::vector<double>& horizontal) {
        return read({.horizontal = horizontal}).symmetry;
    };
    EXPECT_EQ(symmetry({0}), ProfileSymmetry::rotational);
    EXPECT_EQ(symmetry({0, 90}), ProfileSymmetry::quadrants);
    EXPECT_EQ(symmetry({0, 30, 89.99}), ProfileSymmetry::quadrants);
    EXPECT_EQ(symmetry({0, 90, 180}), ProfileSymmetry::plane_0);
    EXPECT_EQ(symmetry({90, 200, 270}), ProfileSymmetry::plane_90);
    EXPECT_EQ(symmetry({0, 90, 180, 270, 360}), ProfileSymmetry::none);
    EXPECT_EQ(symmetry({0, 90, 180, 270}), ProfileSymmetry::none);
    EXPECT_EQ(symmetry({0, 120, 240}), ProfileSymmetry::none);
    EXPECT_EQ(read({.horizontal = {0.001, 30, 89.99}}).horizontal, (std::vector<double>{0, 30, 90}));
}

TEST(IesFile, MirroredHalfPlanes) {
    // The intensity is the horizontal angle.
    const auto profile = [](const std::vector<double>& horizontal) {
        IesText text{.vertical = {30, 90}, .horizontal = horizontal};
        return make_profile(parse(text.text([](const Double3& w) {
            const double angle = std::atan2(-w.y, w.x) / kDegree;
            return std::round(angle < -1e-9 ? angle + 360 : std::fabs(angle));
        })));
    };
    const auto at = [](const IntensityProfile& p, double h) { return p.intensity_at(1, h * kDegree); };
    const IntensityProfile quadrants = profile({0, 45, 90});
    const IntensityProfile half_0 = profile({0, 60, 180});
    const IntensityProfile half_90 = profile({90, 170, 200, 270});
    for (const double h : {0.0, 20.0, 45.0, 80.0, 90.0}) {
        for (const double image : {h, 180 - h, 180 + h, 360 - h}) EXPECT_NEAR(at(quadrants, image), h, 1e-9);
        for (const double image : {h, 360 - h}) EXPECT_NEAR(at(half_0, image), h, 1e-9);
    }
    for (const double h : {90.0, 120.0, 170.0, 180.0, 255.0, 270.0})
        for (const double image : {h, h <= 180 ? 180 - h : 540 - h}) EXPECT_NEAR(at(half_90, image), h, 1e-9);
}

TEST(IesFile, Tilt) {
    EXPECT_FALSE(read({}).tilt);
    const IesFile file = read({.tilt = " tilt = Include \n3\n2.0\n0 90\n1\n0.5\n"});
    ASSERT_TRUE(file.tilt);
    EXPECT_EQ(file.tilt->lamp_geometry, 3);
    EXPECT_EQ(file.tilt->angles, (std::vector<double>{0, 90}));
    EXPECT_EQ(file.tilt->factors, (std::vector<double>{1, 0.5}));
    EXPECT_EQ(file.candelas[0], 100);
}

/// Lines end with LF, CR LF, or CR alone; messages count them alike.
TEST(IesFile, AllLineEnds) {
    const std::string text = IesText{.first_line = "IESNA91\n", .label = "[TEST] a lamp\n"}.text(kConstant);
    const IesFile expected = parse(text);
    for (const std::string end : {"\r\n", "\r"}) {
        std::string other;
        for (const char c : text) other += c == '\n' ? end : std::string(1, c);
        const IesFile file = parse(other);
        EXPECT_EQ(file.version, 1991);
        EXPECT_EQ(file.keywords, expected.keywords);
        EXPECT_EQ(file.candelas, expected.candelas);
        const auto message = [](const std::string& damaged) -> std::string {
            try {
                parse(damaged);
            } catch (const SceneError& error) {
                return error.what();
            }
            return "no error";
        };
        EXPECT_NE(message(text + "7"), "no error");
        EXPECT_EQ(message(other + "7"), message(text + "7"));
    }
}

class IesFiles : public SceneTest {};

TEST_F(IesFiles, AreReadBesideTheirTiltFileAndCompressed) {
    const std::string text = IesText{.first_line = "IESNA91\n", .tilt = "TILT=a lamp.tlt\n"}.text(kConstant);
    write("a lamp.tlt", "1\n3\n0 45 90\n1 0.9 0.8\n");
    write("lamp.ies", text);
    write("lamp.IES.gz", gzipped(text));
    for (const char* const name : {"lamp.ies", "lamp.IES.gz"}) {
        EXPECT_TRUE(is_ies_file(folder_ / name));
        const IesFile file = read_ies(folder_ / name);
        ASSERT_TRUE(file.tilt) << name;
        EXPECT_EQ(file.tilt->file, folder_ / "a lamp.tlt");
        EXPECT_EQ(file.tilt->factors[2], 0.8);
    }
    EXPECT_FALSE(is_ies_file("lamp.pbrt"));
    EXPECT_FALSE(is_ies_file("ies"));
}

TEST_F(IesFiles, AreNotScenes) {
    write("lamp.ies", IesText{}.text(kConstant));
    try {
        load_scene(folder_ / "lamp.ies");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what())
                      .find("is an IES profile, which cannot be read as a scene; print what "
                            "it contains with `nusselt info "),
                  std::string::npos)
            << error.what();
    }
}

TEST(LuminousOpening, FollowsTheTableOfItsVersion) {
    using enum OpeningShape;
    struct Row {
        int version;
        double width, length, height;
        OpeningShape shape;
        double box[3]; ///< width, length, height
        double area;   ///< from below, over pi/4 for what is round
    };
    const Row rows[] = {
        {1986, 0, 0, 0, point, {0, 0, 0}, 0},
        {2019, 0, 0, 0, point, {0, 0, 0}, 0},
        {1995, 2, 3, 0, rectangle, {2, 3, 0}, 6},
        {2002, 2, 3, 1, box, {2, 3, 1}, 6},
        {1986, -2, 0, 0, ellipse, {2, 2, 0}, kPi},
        {1991, -2, 0, 0, ellipse, {2, 2, 0}, kPi},
        {2002, -2, -2, 0, ellipse, {2, 2, 0}, kPi},
        {2019, -2, -4, 0, ellipse, {2, 4, 0}, 2 * kPi},
        {2019, -2, 0, 0, ellipse, {2, 2, 0}, kPi},
        {1995, -2, 4, 0, ellipse, {2, 4, 0}, 2 * kPi},
        {1995, 4, -2, 0, ellipse, {4, 2, 0}, 2 * kPi},
        {1995, -2, 0, 3, vertical_cylinder, {2, 2, 3}, kPi},
        {2002, -2, -2, 3, vertical_cylinder, {2, 2, 3}, kPi},
        {1991, -2, 0, -2, ellipsoid, {2, 2, 2}, kPi},
        {1995, -2, 4, -3, ellipsoid, {2, 4, 3}, 2 * kPi},
        {2002, -2, -2, -2, ellipsoid, {2, 2, 2}, kPi},
        {1995, 0, 5, -0.5, cylinder_along_0, {0.5, 5, 0.5}, 2.5},
        {2002, -0.5, 5, -0.5, cylinder_along_0, {0.5, 5, 0.5}, 2.5},
        {1995, 5, 0, -0.5, cylinder_along_90, {5, 0.5, 0.5}, 2.5},
        {2019, 5, -0.5, -0.5, cylinder_along_90, {5, 0.5, 0.5}, 2.5},
        {2002, -2, 0, -2, vertical_ellipse, {2, 0, 2}, 0},
    };
    for (const Row& row : rows) {
        const auto opening = to_opening(row.version, row.width, row.length, row.height, 0.5);
        ASSERT_TRUE(opening);
        EXPECT_EQ(opening->shape, row.shape);
        EXPECT_EQ(2 * opening->width, row.box[0]);
        EXPECT_EQ(2 * opening->length, row.box[1]);
        EXPECT_EQ(2 * opening->height, row.box[2]);
        EXPECT_DOUBLE_EQ(4 * opening->area_from_below(), row.area);
        EXPECT_FALSE(name_of(opening->shape).empty());
    }
    EXPECT_FALSE(to_opening(2002, 1, 1, -1, 1));
    EXPECT_FALSE(to_opening(1995, 0, -1, 0, 1));
    // A foot has 0.3048 m.
    EXPECT_DOUBLE_EQ(read({.opening = "1 2 4 0"}).opening.length, 4 * 0.3048);
    EXPECT_EQ(read({.opening = "2 2 4 0"}).opening.length, 4);
}

} // namespace
} // namespace nusselt::scene::test
