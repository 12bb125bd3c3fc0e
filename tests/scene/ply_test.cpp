// PLY files in all formats, and hostile ones.

#include "scene/import/ply/ply.h"
#include "scene_fixture.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace nusselt::scene {
namespace {

/// Appends the bytes of a number in the byte order of a format.
class Bytes {
public:
    explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
    template <class T>
    Bytes& add(T value) {
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        if (big_endian_) std::reverse(bytes, bytes + sizeof(T));
        text_.append(bytes, sizeof(T));
        return *this;
    }
    const std::string& text() const { return text_; }

private:
    bool big_endian_;
    std::string text_;
};

std::string failure(std::string_view bytes) {
    try {
        read_ply(bytes);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "no error";
}

const std::string kAsciiHeader = "ply\nformat ascii 1.0\ncomment made by hand\n";
const std::string kVertexHeader = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaceHeader = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kAscii = kAsciiHeader + kVertexHeader + kFaceHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(Ply, Ascii) {
    const Mesh mesh = read_ply(kAscii);
    ASSERT_EQ(mesh.positions.size(), 3u);
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.positions[1].x, 1);
    EXPECT_EQ(mesh.triangles[0].vertex[2], 2u);
    EXPECT_TRUE(mesh.normals.empty());
    EXPECT_TRUE(mesh.uvs.empty());
}

TEST(Ply, AsciiWithWindowsLineEndsAndNoLastLineEnd) {
    std::string text;
    for (const char c : kAscii) text += c == '\n' ? "\r\n" : std::string(1, c);
    EXPECT_EQ(read_ply(text).triangles.size(), 1u);
    EXPECT_EQ(read_ply(kAscii.substr(0, kAscii.size() - 1)).triangles.size(), 1u);
}

/// Two elements to skip, properties of all types in odd order, a triangle, a quad and a pentagon.
void expect_binary_mesh(const std::string& format, bool big_endian) {
    const std::string header =
        "ply\nformat " + format +
        " 1.0\n"
        "element camera 1\nproperty list uint16 double parameters\nproperty char kind\n"
        "element vertex 5\nproperty uchar red\nproperty double z\nproperty float nx\n"
        "property float ny\nproperty float nz\nproperty float x\nproperty short y\n"
        "property list uchar ushort extras\nproperty float s\nproperty float t\n"
        "element face 3\nproperty int group\nproperty list int uint vertex_index\n"
        "element edge 2\nproperty int a\nend_header\n";
    Bytes data(big_endian);
    data.add<std::uint16_t>(2).add(1.5).add(2.5).add<std::int8_t>(-1);
    for (int i = 0; i < 5; ++i) {
        data.add<std::uint8_t>(200).add(-0.5).add(0.0f).add(0.0f).add(1.0f);
        data.add(0.25f * static_cast<float>(i)).add<std::int16_t>(static_cast<std::int16_t>(-300 * i));
        data.add<std::uint8_t>(static_cast<std::uint8_t>(i % 2));
        if (i % 2 == 1) data.add<std::uint16_t>(7);
        data.add(0.1f * static_cast<float>(i)).add(1.0f);
    }
    data.add(9).add(3).add(0u).add(1u).add(2u);
    data.add(9).add(4).add(1u).add(2u).add(3u).add(4u);
    data.add(9).add(5).add(4u).add(3u).add(2u).add(1u).add(0u);
    data.add(1).add(2);

    const Mesh mesh = read_ply(header + data.text());
    ASSERT_EQ(mesh.positions.size(), 5u);
    EXPECT_EQ(mesh.positions[4].x, 1);
    EXPECT_EQ(mesh.positions[4].y, -1200);
    EXPECT_EQ(mesh.positions[4].z, -0.5f);
    EXPECT_EQ(mesh.normals[3].z, 1);
    EXPECT_EQ(mesh.uvs[2].x, 0.2f);
    const std::vector<std::array<std::uint32_t, 3>> expected = {{0, 1, 2}, {1, 2, 3}, {1, 3, 4},
                                                                {4, 3, 2}, {4, 2, 1}, {4, 1, 0}};
    ASSERT_EQ(mesh.triangles.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(mesh.triangles[i].vertex[j], expected[i][j]);

    // The reader reports a truncated file, and does not read beyond its end.
    for (std::size_t size = 0; size < data.text().size(); ++size)
        EXPECT_EQ(failure(header + data.text().substr(0, size)).substr(0, 29),
                  "PLY file ends before the last")
            << size;
}

TEST(Ply, BinaryLittleEndian) { expect_binary_mesh("binary_little_endian", false); }
TEST(Ply, BinaryBigEndian) { expect_binary_mesh("binary_big_endian", true); }

TEST(Ply, TextureCoordinateNames) {
    for (const auto& [u, v] :
         {std::pair{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}) {
        const std::string properties = std::string("property float ") + u + "\nproperty float " + v + "\n";
        const Mesh mesh = read_ply(kAsciiHeader + kVertexHeader + properties + kFaceHeader +
                                   "0 0 0 0.5 1\n1 0 0 0.25 2\n0 1 0 0 0\n3 0 1 2\n");
        ASSERT_EQ(mesh.uvs.size(), 3u) << u;
        EXPECT_EQ(mesh.uvs[1].x, 0.25f);
        EXPECT_EQ(mesh.uvs[1].y, 2);
    }
}

TEST(Ply, FacesWithTooFewVerticesAreCounted) {
    const Mesh mesh = read_ply(kAsciiHeader + kVertexHeader +
                               "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
                               "0 0 0 1 0 0 0 1 0   2 0 1   3 0 1 2   0");
    EXPECT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.degenerate_triangles, 2u);
}

TEST(Ply, BadHeaders) {
    EXPECT_EQ(failure(""), "not a PLY file");
    EXPECT_EQ(failure("plywood\nformat ascii 1.0\n"), "not a PLY file");
    EXPECT_EQ(failure("\x1f\x8b compressed\n"), "not a PLY file");
    EXPECT_EQ(failure("ply\nformat ascii 1.0\nelement vertex 3\n"), "PLY header: 'end_header' is missing");
    EXPECT_EQ(failure("ply\nformat ascii 2.0\n"), "PLY header: unknown format: 'format ascii 2.0'");
    EXPECT_EQ(failure("ply\nend_header\n"), "PLY header: 'format' is missing");
    EXPECT_EQ(failure(kAsciiHeader + "element vertex\n"),
              "PLY header: expected 'element NAME COUNT': 'element vertex'");
    EXPECT_EQ(failure(kAsciiHeader + "element vertex -3\n"),
              "PLY header: invalid number of elements: 'element vertex -3'");
    EXPECT_EQ(failure(kAsciiHeader + "element vertex 99999999999999999999999\n"),
              "PLY header: invalid number of elements: 'element vertex 99999999999999999999999'");
    EXPECT_EQ(failure(kAsciiHeader + "property float x\n"),
              "PLY header: property before the first element: 'property float x'");
    EXPECT_EQ(failure(kAsciiHeader + "element vertex 1\nproperty half x\n"),
              "PLY header: unknown type: 'property half x'");
    EXPECT_EQ(failure(kAsciiHeader + "element vertex 1\nproperty list float int x\n"),
              "PLY header: the length of a list must be an integer: 'property list float int x'");
    EXPECT_EQ(failure(kAsciiHeader + "element vertex 1\nproperty x\n"),
              "PLY header: invalid property: 'property x'");
    EXPECT_EQ(failure(kAsciiHeader + "colour blue\n"), "PLY header: unknown line: 'colour blue'");
    EXPECT_EQ(failure(kAsciiHeader + "element vertex 1\nproperty float x\nelement face 0\nproperty int x\n"
                                     "end_header\n0\n"),
              "PLY header: x, y or z is missing in element 'vertex'");
    EXPECT_EQ(failure(kAsciiHeader + kVertexHeader + "end_header\n0 0 0 0 0 0 0 0 0\n"),
              "PLY header: element 'face' is missing");
    EXPECT_EQ(failure(kAsciiHeader +
                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 1 2\n"),
              "PLY header: element 'face' must follow element 'vertex'");
}

TEST(Ply, HugeCountsAreRefusedBeforeMemoryIsAllocated) {
    for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const std::string begin = "ply\nformat " + format + " 1.0\n";
        const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
        const std::string body(600, '0');
        for (const std::string count : {"1000", "4000000000", "18446744073709551615"}) {
            EXPECT_EQ(failure(begin + "element vertex " + count + "\n" + xyz + kFaceHeader + body),
                      "PLY file ends before the last of " + count + " of element 'vertex'");
            EXPECT_EQ(failure(begin + "element vertex 0\n" + xyz + "element face " + count +
                              "\nproperty list uchar int vertex_indices\nend_header\n" + body),
                      "PLY file ends before the last of " + count + " of element 'face'");
            // Elements without properties take no memory.
            EXPECT_EQ(read_ply(begin + "element vertex " + count + "\nelement face " + count +
                               "\nend_header\n" + body)
                          .triangles.size(),
                      0u);
        }
    }
    const std::string list = "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
                             "element face 1\nproperty list uint int vertex_indices\nend_header\n";
    const std::string truncated = "PLY file ends before the last of 1 of element 'face'";
    EXPECT_EQ(failure("ply\nformat binary_little_endian 1.0\n" + list + "\xff\xff\xff\xff"), truncated);
    EXPECT_EQ(failure(kAsciiHeader + list + "4294967295 0"), truncated);
    EXPECT_EQ(failure(kAsciiHeader + list + "-1 0"), "PLY data: face 0: list length -1");
    EXPECT_EQ(failure(kAsciiHeader + list + "1.5 0"), "PLY data: face 0: list length 1.5");
    EXPECT_EQ(failure(kAsciiHeader + list + "nan 0"), "PLY data: face 0: list length nan");
}

TEST(Ply, BadData) {
    const std::string header = kAsciiHeader + kVertexHeader + kFaceHeader;
    EXPECT_EQ(failure(header + "0 0 0 1 0 0 0 x 0 3 0 1 2"),
              "PLY data: vertex 2: expected a number, found 'x'");
    EXPECT_EQ(failure(header + "0 0 0 1 0 0 0 1.0.0 0 3 0 1 2"),
              "PLY data: vertex 2: expected a number, found '1.0.0'");
    EXPECT_EQ(failure(header + "0 0 0 1 0 0 0 1 0 3 0 1 3"),
              "PLY data: face 0: vertex index 3 is out of range for 3 vertices");
    EXPECT_EQ(failure(header + "0 0 0 1 0 0 0 1 0 3 0 1 -1"),
              "PLY data: face 0: vertex index -1 is out of range for 3 vertices");
    EXPECT_EQ(failure(header + "0 0 0 1 0 0 0 1 0 3 0 1 nan"),
              "PLY data: face 0: vertex index nan is out of range for 3 vertices");
    EXPECT_EQ(failure(header + "0 0 0 1 0 0 0 1 0 3 0 1 1.5"),
              "PLY data: face 0: vertex index 1.5 is not a whole number");
    for (std::size_t size = header.size(); size + 2 < kAscii.size(); ++size)
        EXPECT_EQ(failure(kAscii.substr(0, size)).substr(0, 29), "PLY file ends before the last");
}

class PlyInScene : public SceneTest {};

TEST_F(PlyInScene, IsTransformedAndLit) {
    write("meshes/a.ply", kAscii);
    const Scene scene = load("Camera \"perspective\" WorldBegin Translate 0 0 7 AreaLightSource \"diffuse\"\n"
                             "Shape \"plymesh\" \"string filename\" \"meshes/a.ply\"");
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.positions[1].z, 7);
    EXPECT_EQ(scene.lights.of<PolygonLight>().size(), 1u);
}

TEST_F(PlyInScene, ErrorsNameSceneLineAndMesh) {
    write("bad.ply", "ply\nformat ascii 1.0\n");
    EXPECT_EQ(error("\nShape \"plymesh\"\n\"string filename\" \"bad.ply\""),
              "scene.pbrt:3: mesh file 'bad.ply': PLY header: 'end_header' is missing");
    EXPECT_EQ(error("Shape \"plymesh\" \"string filename\" \"none.ply\""),
              "scene.pbrt:1: mesh file 'none.ply': no such file");
    EXPECT_EQ(error("Shape \"plymesh\""),
              "scene.pbrt:1: shape \"plymesh\": parameter \"string filename\" is missing");
    write("far.ply", kAsciiHeader + kVertexHeader + kFaceHeader + "0 0 0 nan 0 0 0 1 0 3 0 1 2");
    EXPECT_EQ(error("Shape \"plymesh\" \"string filename\" \"far.ply\""),
              "scene.pbrt:1: shape \"plymesh\": vertex 1 at (nan, 0, 0) must be finite and within 1e15 m");
}

} // namespace
} // namespace nusselt::scene
