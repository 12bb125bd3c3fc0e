#include "lab/timing/scale.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace nusselt::lab {

namespace {

struct Point {
    double x, y, z;
};

/// A height in [0, 1) that looks random.
double bump(std::uint64_t column, std::uint64_t row) {
    std::uint64_t hash = column * 0x9e3779b97f4a7c15u ^ row * 0xc2b2ae3d27d4eb4fu;
    hash ^= hash >> 29;
    hash *= 0xbf58476d1ce4e5b9u;
    hash ^= hash >> 32;
    return static_cast<double>(hash >> 11) * 0x1p-53;
}

/// Writes numbers in little-endian order, in which all supported processors store them.
class BinaryFile {
public:
    explicit BinaryFile(const std::filesystem::path& path) : path_(path), stream_(path, std::ios::binary) {}
    void text(const std::string& text) { stream_ << text; }
    template <class T>
    void number(T value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        stream_.write(bytes, sizeof value);
    }
    void finish() {
        stream_.close();
        if (!stream_) throw std::runtime_error("cannot write " + path_.string());
    }

private:
    std::filesystem::path path_;
    std::ofstream stream_;
};

/// \param size  squares per side, each of two triangles
/// \param point returns a point of the grid, given column and row from 0 to size
void write_grid(const std::filesystem::path& path, std::uint32_t size,
                const std::function<Point(std::uint32_t, std::uint32_t)>& point) {
    const std::uint64_t stride = std::uint64_t{size} + 1;
    BinaryFile file(path);
    file.text("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(stride * stride) +
              "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
              std::to_string(2 * std::uint64_t{size} * size) +
              "\nproperty list uchar int vertex_indices\nend_header\n");
    for (std::uint32_t row = 0; row <= size; ++row) {
        for (std::uint32_t column = 0; column <= size; ++column) {
            const Point p = point(column, row);
            for (const double entry : {p.x, p.y, p.z}) file.number(static_cast<float>(entry));
        }
    }
    const auto face = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
        file.number(std::uint8_t{3});
        for (const std::uint64_t vertex : {a, b, c}) file.number(static_cast<std::uint32_t>(vertex));
    };
    for (std::uint64_t row = 0; row < size; ++row) {
        for (std::uint64_t column = 0; column < size; ++column) {
            const std::uint64_t corner = row * stride + column;
            face(corner, corner + 1, corner + stride + 1);
            face(corner, corner + stride + 1, corner + stride);
        }
    }
    file.finish();
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    BinaryFile file(path);
    file.text(text);
    file.finish();
}

constexpr const char* kTerrain = R"(LookAt 0 6 -9  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "image" "integer xresolution" 64 "integer yresolution" 64
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [10 10 10]
  Shape "quad" "point3 o" [-1 5 -1] "vector3 u" [2 0 0] "vector3 v" [0 0 2]
AttributeEnd
Material "matte" "rgb Kd" [0.5 0.5 0.5]
Shape "plymesh" "string filename" "mesh.ply"
)";

constexpr const char* kLight = R"(LookAt 0 3 -8  0 1 0  0 1 0
Camera "perspective" "float fov" 40
Film "image" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
Material "matte" "rgb Kd" [0.5 0.5 0.5]
Shape "quad" "point3 o" [-5 0 -5] "vector3 u" [0 0 10] "vector3 v" [10 0 0]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [1 1 1]
  Shape "plymesh" "string filename" "mesh.ply"
AttributeEnd
)";

} // namespace

std::uint64_t write_scale_scene(ScaleScene scene, std::uint64_t triangles,
                                const std::filesystem::path& folder) {
    const auto size = static_cast<std::uint32_t>(
        std::max(1.0, std::floor(std::sqrt(0.5 * static_cast<double>(triangles)))));
    const double step = 1.0 / size;
    // The bumps are as wide and as high as a square of the grid.
    const auto hill = [=](std::uint32_t column, std::uint32_t row) {
        const double x = 10 * (column * step - 0.5);
        const double z = 10 * (row * step - 0.5);
        return Point{x, 0.3 * std::sin(2 * x) * std::cos(3 * z) + 5 * step * bump(column, row), z};
    };
    const auto bumpy_sphere = [=](std::uint32_t column, std::uint32_t row) {
        // Leaves out the poles, where triangles would vanish.
        const double theta = std::numbers::pi * (0.02 + 0.96 * row * step);
        const double phi = 2 * std::numbers::pi * (column % size) * step;
        const double radius = 1 + step * bump(column % size, row);
        return Point{radius * std::sin(theta) * std::cos(phi), 2 + radius * std::cos(theta),
                     radius * std::sin(theta) * std::sin(phi)};
    };
    const bool is_light = scene == ScaleScene::light;
    write_text(folder / "scene.pbrt", is_light ? kLight : kTerrain);
    if (is_light)
        write_grid(folder / "mesh.ply", size, bumpy_sphere);
    else
        write_grid(folder / "mesh.ply", size, hill);
    return 2 * std::uint64_t{size} * size;
}

} // namespace nusselt::lab
