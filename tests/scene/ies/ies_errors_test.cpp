// Wrong IES files: every message in full, and files with random damage.

#include "../scene_fixture.h"
#include "ies_text.h"

#include <gtest/gtest.h>
#include <random>

namespace nusselt::scene::test {
namespace {

const std::string kGood = "IESNA:LM-63-2002\n"       // line 1
                          "[TEST] a lamp\n"          // 2
                          "TILT=NONE\n"              // 3
                          "1 1000 1 3 2 1 2 1 1 0\n" // 4
                          "1 1 100\n"                // 5
                          "0 45 90\n"                // 6
                          "0 90\n"                   // 7
                          "100 70 0\n"               // 8
                          "100 80 5\n";              // 9

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string error_of(const std::string& text) {
    try {
        parse(text);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no error";
}

TEST(IesErrors, NameFileLineAndValue) {
    EXPECT_EQ(error_of(kGood), "no error");
    struct Case {
        const char* from;
        const char* to;
        const char* expected;
    };
    const Case cases[] = {
        {"LM-63-2002", "LM-63-2001",
         "lamp.ies:1: unknown version 'IESNA:LM-63-2001'; known are LM-63 of 1986, 1991, 1995, 2002 and "
         "2019"},
        {"TILT=NONE\n", "", "lamp.ies: not an IES file: no line begins with TILT="},
        {"TILT=NONE", "TILT=", "lamp.ies:3: TILT= needs NONE, INCLUDE or the name of a file"},
        {"NONE", "no.tlt", "lamp.ies:3: TILT file 'no.tlt': no such file"},
        {"NONE", "INCLUDE\n4",
         "lamp.ies:4: the lamp geometry of TILT must be a whole number from 1 to 3, found 4"},
        {"NONE", "INCLUDE\n1 0",
         "lamp.ies:4: the number of angles of TILT must be a whole number from 1 to 16777216, found 0"},
        {"NONE", "INCLUDE\n1 16000000",
         "lamp.ies:4: the file ends too early: its counts announce 32000000 more numbers, and it has room "
         "for 31"},
        {"NONE", "INCLUDE\n1 2\n45 45",
         "lamp.ies:5: the angle of TILT 2 of 2 must exceed the one before, 45, by 1e-04 or more, found 45"},
        {"NONE", "INCLUDE\n1 2\n0 90\n1 -1",
         "lamp.ies:6: the factors of TILT must not be negative, found -1"},
        {"\n1 1000", "\n1.5 1000",
         "lamp.ies:4: the number of lamps must be a whole number from 0 to 16777216, found 1.5"},
        {"1 1000 1", "1 x 1", "lamp.ies:4: the lumens per lamp must be a finite number, found 'x'"},
        {"1000 1", "1000 0", "lamp.ies:4: the multiplier of the candelas must be positive, found 0"},
        {" 3 2 1 2", " 1 2 1 2",
         "lamp.ies:4: the number of vertical angles must be a whole number from 2 to 16777216, found 1"},
        {" 3 2 1 2", " 3 0 1 2",
         "lamp.ies:4: the number of horizontal angles must be a whole number from 1 to 16777216, found 0"},
        {" 3 2 1 2", " 3 2.5 1 2",
         "lamp.ies:4: the number of horizontal angles must be a whole number from 1 to 16777216, found 2.5"},
        {" 3 2 1 2", " 3 1e99 1 2",
         "lamp.ies:4: the number of horizontal angles must be a whole number from 1 to 16777216, found "
         "1e+99"},
        {" 3 2 1 2", " 9999999 9999999 1 2",
         "lamp.ies:4: the file ends too early: its counts announce 99999999999999 more numbers, and it has "
         "room for 25"},
        {"3 2 1 2", "3 2 4 2",
         "lamp.ies:4: the photometric type (1 is C, 2 is B, 3 is A) must be a whole number from 1 to 3, "
         "found 4"},
        {"1 2 1 1 0", "1 3 1 1 0",
         "lamp.ies:4: the unit of length (1 is feet, 2 is metres) must be a whole number from 1 to 2, found "
         "3"},
        {"1 1 0\n", "1 inf 0\n",
         "lamp.ies:4: the length of the opening must be a finite number, found 'inf'"},
        {"1 1 0\n", "1 1 -1\n",
         "lamp.ies:4: no opening has a width of 1, a length of 1 and a height of -1; 0 0 0 is a point"},
        {"1 1 0\n", "1 1e16 0\n", "lamp.ies:4: the sizes of the opening must not exceed 1e+15, found 1e+16"},
        {"\n1 1 100", "\n-1 1 100", "lamp.ies:5: the ballast factor must be positive, found -1"},
        {"\n1 1 100", "\n1 1 watts", "lamp.ies:5: the input watts must be a finite number, found 'watts'"},
        {"0 45 90", "0 45 45",
         "lamp.ies:6: the vertical angle 3 of 3 must exceed the one before, 45, by 1e-04 or more, found 45"},
        {"0 45 90", "0 45 190", "lamp.ies:6: the vertical angle 3 of 3 must be from -180 to 180, found 190"},
        {"0 45 90", "-90 0 90", "lamp.ies:6: vertical angles of type C begin with 0 or more, found -90"},
        {"\n0 90\n", "\n0 91\n",
         "lamp.ies:7: horizontal angles from 0 to 91; type C has a single one, or 0 to 90, 0 to 180, 90 to "
         "270 or 0 to 360"},
        {"\n0 90\n", "\n90 0\n",
         "lamp.ies:7: the horizontal angle 2 of 2 must exceed the one before, 90, by 1e-04 or more, found 0"},
        {"70", "-70",
         "lamp.ies:8: the candelas at vertical 45, horizontal 0 must not be negative, found -70"},
        {"80", "nan",
         "lamp.ies:9: the candelas at vertical 45, horizontal 90 must be a finite number, found 'nan'"},
        {"80", "1e400",
         "lamp.ies:9: the candelas at vertical 45, horizontal 90 must be a finite number, found '1e400'"},
        {"80", "1e16",
         "lamp.ies:9: the candelas at vertical 45, horizontal 90 must not exceed 1e+15 with all factors, "
         "found 1e+16 times 1"},
        {"80 5", "80", "lamp.ies:9: the file ends before the candelas at vertical 90, horizontal 90"},
        {"80 5", "80 5\n6", "lamp.ies:10: found '6' behind the last number"},
        {"80 5", "80 5\nIESNA:LM-63-2002", "lamp.ies:10: found 'IESNA:LM-63-2002' behind the last number"},
        {"3 2 1 2", "3 2 3 2", "no error"}, // A, mirrored in both planes
        {"3 2 1 2", "3 1 2 2", "lamp.ies:7: type B needs two or more horizontal angles"},
        {"3 2 1 2 1 1 0\n1 1 100\n0 45 90\n0 90", "3 2 2 2 1 1 0\n1 1 100\n0 45 90\n0 91",
         "lamp.ies:7: horizontal angles of type B are from -90 to 90, found 0 to 91"},
        {"3 2 1 2 1 1 0\n1 1 100\n0 45 90\n0 90", "3 2 2 2 1 1 0\n1 1 100\n0 45 90\n5 90",
         "lamp.ies:7: angles of type B begin with 0 or less, found vertical ones from 0 and horizontal ones "
         "from 5"},
        {"3 2 1 2 1 1 0\n1 1 100\n0 45 90", "3 2 3 2 1 1 0\n1 1 100\n0 45 91",
         "lamp.ies:6: vertical angles of type A are from -90 to 90, found 0 to 91"},
    };
    for (const Case& c : cases)
        EXPECT_EQ(error_of(replaced(kGood, c.from, c.to)), c.expected) << c.from << " -> " << c.to;
    EXPECT_EQ(error_of(replaced(replaced(kGood, "IESNA:LM-63-2002", "IES:LM-63-2019"), "NONE", "a.tlt")),
              "lamp.ies:3: TILT=a.tlt: the version of 2019 has NONE and INCLUDE only");
    // Without a version, the numbers for lamps have another meaning.
    EXPECT_EQ(error_of(replaced(replaced(kGood, "IESNA:LM-63-2002", ""), "\n1 1 100", "\n1 0 100")),
              "lamp.ies:5: the ballast-lamp photometric factor must be positive, found 0");
}

TEST(IesErrors, FilesWithoutText) {
    EXPECT_EQ(error_of(""), "lamp.ies: the file is empty");
    EXPECT_EQ(error_of(" \r\n\t\n"), "lamp.ies: the file is empty");
    EXPECT_EQ(error_of("\x1a"), "lamp.ies: the file is empty");
    EXPECT_EQ(error_of(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)),
              "lamp.ies: not an IES file: a binary file, or text in UTF-16");
    EXPECT_EQ(error_of("\x89PNG\r\n"), "lamp.ies: not an IES file: no line begins with TILT=");
}

class IesFileErrors : public SceneTest {
protected:
    std::string error_of_file(const std::string& name) const {
        try {
            read_ies(folder_ / name);
        } catch (const std::runtime_error& error) {
            return without_folder(error.what());
        }
        return "no error";
    }
};

TEST_F(IesFileErrors, MissingAndLargeFiles) {
    EXPECT_EQ(error_of_file("lamp.ies"), "IES file 'lamp.ies': no such file");
    write("folder/file", "");
    EXPECT_EQ(error_of_file("folder"), "IES file 'folder': a folder, not a file");
    write("lamp.ies", kGood + std::string(kMaxIesBytes, ' '));
    EXPECT_EQ(error_of_file("lamp.ies"), "IES file 'lamp.ies': larger than 16777216 bytes");
}

TEST_F(IesFileErrors, TiltFiles) {
    write("lamp.ies", replaced(kGood, "NONE", "lamp.tlt"));
    EXPECT_EQ(error_of_file("lamp.ies"), "lamp.ies:3: TILT file 'lamp.tlt': no such file");
    write("lamp.tlt", "1\n2\n0 90\n1 x\n");
    EXPECT_EQ(error_of_file("lamp.ies"),
              "lamp.tlt:4: the factor of TILT 2 of 2 must be a finite number, found 'x'");
    write("lamp.tlt", "1\n2\n0 90\n1 1\n1");
    EXPECT_EQ(error_of_file("lamp.ies"), "lamp.tlt:5: found '1' behind the last number");
    write("lamp.tlt", "");
    EXPECT_EQ(error_of_file("lamp.ies"), "lamp.tlt: the file is empty");
}

/// A profile opens no file outside of its folder.
TEST_F(IesFileErrors, TiltFilesAreBesideTheirProfile) {
    write("up/lamp.tlt", "1\n2\n0 90\n1 1\n");
    for (const std::string name :
         {"up/lamp.tlt", "./lamp.tlt", "../lamp.tlt", "..", ".", "/etc/hostname", "up\\lamp.tlt"}) {
        write("lamp.ies", replaced(kGood, "NONE", name));
        EXPECT_EQ(error_of_file("lamp.ies"),
                  "lamp.ies:3: TILT=" + name +
                      ": the file must lie in the folder of the IES file; give its "
                      "name alone, without a folder");
    }
}

/// A file with a few random mistakes.
std::string damaged(std::string text, std::mt19937& engine) {
    static const std::string kPieces[] = {
        " ",   "\n",   ",",          "-", "+", ".",    "0", "1",     "90",  "360", "1e3",     "1e308",
        "nan", "-inf", "9999999999", "[", "]", "TILT", "=", "IESNA", "1.0", "\t",  "INCLUDE", "0.0001"};
    const auto below = [&](std::size_t end) { return end == 0 ? 0 : engine() % end; };
    for (std::size_t mistakes = 1 + below(2); mistakes > 0; --mistakes) {
        const std::size_t at = below(text.size());
        switch (engine() % 4) {
        case 0:
            text.erase(at, 1 + below(6));
            break;
        case 1:
            text.insert(at, kPieces[below(std::size(kPieces))]);
            break;
        case 2:
            text.replace(at, 1, kPieces[below(std::size(kPieces))]);
            break;
        default:
            text[at] = static_cast<char>(engine());
        }
        if (text.empty()) text = " ";
    }
    return text;
}

TEST(IesErrors, DamagedFilesAreReadOrRefused) {
    std::vector<std::string> sources;
    for (const std::string& line : {std::string(), std::string("IESNA91\n"), std::string("IES:LM-63-2019\n")})
        for (const int type : {1, 2, 3})
            sources.push_back(IesText{.first_line = line,
                                      .tilt = "TILT=INCLUDE\n1 2 0 90 1 0.5\n",
                                      .type = type,
                                      .vertical = {0, 30, 60, 90},
                                      .horizontal = {0, 45, 90}}
                                  .text([](const Double3& w) { return 100 * std::fabs(w.z); }));
    std::mt19937 engine(7);
    int read = 0, refused = 0;
    for (int i = 0; i < 4000; ++i) {
        const std::string text = damaged(sources[engine() % sources.size()], engine);
        try {
            const IesFile file = parse(text);
            ++read;
            ASSERT_EQ(file.candelas.size(), file.vertical.size() * file.horizontal.size());
            const IntensityProfile profile = make_profile(file);
            const double flux = profile.flux();
            ASSERT_TRUE(flux >= 0 && flux <= 4.001 * kPi * profile.peak().candelas) << text;
            ASSERT_LE(profile.spread(0.3, 0.5), 2 * kPi + 1e-9) << text;
        } catch (const SceneError& error) {
            ++refused;
            const std::string message = error.what();
            ASSERT_TRUE(message.starts_with("lamp.ies:")) << message;
            ASSERT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
    // Both happen often, or else little was tested.
    EXPECT_GT(read, 500);
    EXPECT_GT(refused, 1000);
}

} // namespace
} // namespace nusselt::scene::test
