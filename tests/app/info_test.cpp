// The output of `nusselt info` for scenes.

#include "program.h"

namespace nusselt {

namespace {

class Info : public CommandLine {
protected:
    std::string info(const std::string& scene) const {
        std::ofstream(path("scene.pbrt")) << scene;
        const Outcome outcome = run("info scene.pbrt");
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.out;
    }
};

void expect_line(const std::string& text, const std::string& line) {
    EXPECT_NE(("\n" + text).find("\n" + line + "\n"), std::string::npos) << line << "\nis not in\n" << text;
}

TEST_F(Info, CountsObjectsAndMeasuresTheirInstances) {
    const std::string text = info(R"(
        LookAt 0 0 5  0 0 0  0 1 0
        Camera "perspective" "float fov" 90
        Film "rgb" "integer xresolution" 200 "integer yresolution" 100 "string filename" "view.exr"
        WorldBegin
        ObjectBegin "leaf"
        Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0]
        ObjectEnd
        Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0]
        Translate 5 6 7
        ObjectInstance "leaf"
        Translate -6 -6 -7
        ObjectInstance "leaf")");
    expect_line(text, "triangles    2");
    expect_line(text, "objects      1 with 1 triangles");
    expect_line(text, "instances    2");
    expect_line(text, "bounding box (-1 0 0) to (6 7 7) m");
    // The field of view is that of the shorter axis; 2 atan(2) is 126.87 degrees.
    expect_line(text, "camera       at (0 0 5), looks along (0 0 -1), field of view 126.9 x 90 degrees");
    expect_line(text, "film         200 x 100, view.exr");
    expect_line(text, "filter       box, radii 0.5 x 0.5 pixels");
    EXPECT_EQ(text.find("crop"), std::string::npos);
}

TEST_F(Info, OrthographicCamerasHaveAnExtent) {
    const std::string text = info(R"(
        LookAt 1 2 5  1 2 0  0 1 0
        Camera "orthographic" "float screenwindow" [-3 3 -1 1]
        PixelFilter "gaussian" "float xradius" 2 "float yradius" 1
        Film "rgb" "integer xresolution" 60 "integer yresolution" 20 "integer pixelbounds" [10 50 5 15]
        WorldBegin
        Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0])");
    expect_line(text, "camera       at (1 2 5), looks along (0 0 -1), orthographic, 6 x 2 m");
    expect_line(text, "film         60 x 20");
    expect_line(text, "crop         10 <= x < 50, 5 <= y < 15");
    expect_line(text, "filter       gaussian, radii 2 x 1 pixels");
}

TEST_F(Info, MaterialsNameTheirTextures) {
    std::ofstream(path("grey.pfm"), std::ios::binary) << "Pf\n1 1\n-1.0\n" << std::string(4, '\0');
    const std::string text = info(R"(
        Camera "perspective"
        WorldBegin
        Texture "t" "float" "imagemap" "string filename" "grey.pfm" "float scale" 0.5
        MakeNamedMaterial "old" "string type" "matte" "texture bumpmap" "t"
        MakeNamedMaterial "new" "string type" "diffuse" "texture displacement" "t"
        MakeNamedMaterial "mapped" "string type" "diffuse" "string normalmap" "grey.pfm"
        NamedMaterial "old"
        Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "texture alpha" "t"
        NamedMaterial "new"
        Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0]
        NamedMaterial "mapped"
        Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0])");
    const std::string diffuse = ": lambert, diffuse 0.5 0.5 0.5";
    expect_line(text,
                "  old" + diffuse + ", alpha 0.5 times grey.pfm, bumps 0.5 times grey.pfm (as in pbrt v3)");
    expect_line(text, "  new" + diffuse + ", bumps 0.5 m times grey.pfm");
    expect_line(text, "  mapped" + diffuse + ", normals grey.pfm");
}

TEST_F(Info, PrintsIesProfiles) {
    std::ofstream(path("lamp.IES")) << "IESNA:LM-63-2002\n[MANUFAC] Lamps\x1b[2J\nTILT=NONE\n"
                                       "1 -1 2 3 1 1 1 -1 -1 0\n0.5 1 100\n0 90 180\n0\n100 100 100\n";
    const Outcome outcome = run("info lamp.IES");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string& text = outcome.out;
    expect_line(text, "format       IES profile, LM-63 of 2002");
    expect_line(text, "MANUFAC      Lamps?[2J");
    expect_line(text, "photometry   type C, rotationally symmetric");
    expect_line(text, "angles       3 vertical (0 to 180), 1 horizontal (0 to 0) degrees");
    expect_line(text, "lamps        1, absolute photometry");
    // 4 pi times 100 cd
    expect_line(text, "flux         1256.64 lm, 50 % down and 50 % up");
    expect_line(text, "intensity    up to 100 cd, at vertical 0, horizontal 0 degrees");
    expect_line(text, "beam angle   360 degrees in the plane of 0, 360 in that of 90");
    // A foot is 0.3048 m, and 100 cd / (179 lm/W pi/4 (0.3048 m)^2) is 7.656.
    expect_line(text, "opening      disc or ellipse, length 0.3048, width 0.3048, height 0 m");
    expect_line(text, "flat light   loses 50.5 % of the flux; 0.07297 m^2, straight down 7.656 W/(sr m^2)");
    EXPECT_EQ(run("info lamp.IES --lights a.json").exit_code, 2);
    std::ofstream(path("lamp.IES")) << "IESNA:LM-63-2002\n";
    const Outcome broken = run("info lamp.IES");
    EXPECT_EQ(broken.exit_code, 1);
    EXPECT_NE(broken.err.find("lamp.IES: not an IES file: no line begins with TILT="), std::string::npos)
        << broken.err;
}

} // namespace

} // namespace nusselt
