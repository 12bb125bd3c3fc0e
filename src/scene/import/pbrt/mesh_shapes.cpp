#include "scene/import/pbrt/shape_readers.h"
#include "scene/import/ply/ply.h"
#include "scene/model/polygon.h"
#include "scene/model/vector_math.h"

namespace nusselt::scene {

namespace {

/// Triangle fan around the first vertex.
std::vector<Triangle> fan(std::size_t vertices) {
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 1; i + 1 < vertices; ++i) triangles.push_back({{0, i, i + 1}});
    return triangles;
}

std::vector<Float3> read_positions(ShapeDirective& shape) {
    std::vector<Float3> positions = shape.parameters.points("P");
    if (positions.empty())
        throw SceneError(shape.parameters.location(),
                         "shape \"" + shape.type + "\": parameter \"point3 P\" is missing");
    return positions;
}

std::vector<Triangle> read_triangles(ShapeDirective& shape, std::size_t vertices) {
    ParameterList& parameters = shape.parameters;
    const std::vector<std::uint32_t> indices = parameters.indices("indices", vertices);
    if (indices.empty()) {
        // As in pbrt v4, three vertices need no indices.
        if (vertices != 3)
            throw SceneError(parameters.location(),
                             "shape \"" + shape.type + "\": parameter \"integer indices\" is missing");
        return fan(3);
    }
    if (indices.size() % 3 != 0)
        throw SceneError(parameters.location_of("indices"),
                         "shape \"" + shape.type + "\": the number of indices, " +
                             std::to_string(indices.size()) + ", must be a multiple of 3");
    std::vector<Triangle> triangles;
    triangles.reserve(indices.size() / 3);
    for (std::size_t i = 0; i < indices.size(); i += 3)
        triangles.push_back({{indices[i], indices[i + 1], indices[i + 2]}});
    return triangles;
}

/// Throws SceneError unless an optional array has one value per vertex.
void check_length(const ShapeDirective& shape, std::string_view name, std::size_t found,
                  std::size_t expected) {
    if (found != 0 && found != expected)
        throw SceneError(shape.parameters.location_of(name),
                         "shape \"" + shape.type + "\": " + std::to_string(found) + " values of \"" +
                             std::string(name) + "\" for " + std::to_string(expected) + " vertices");
}

std::vector<std::uint32_t> read_patches(ShapeDirective& shape, std::size_t vertices) {
    std::vector<std::uint32_t> indices = shape.parameters.indices("indices", vertices);
    if (indices.empty()) {
        if (vertices != 4)
            throw SceneError(shape.parameters.location(),
                             "shape \"bilinearmesh\": parameter \"integer indices\" is missing");
        return {0, 1, 2, 3};
    }
    if (indices.size() % 4 != 0)
        throw SceneError(shape.parameters.location_of("indices"),
                         "shape \"bilinearmesh\": the number of indices, " + std::to_string(indices.size()) +
                             ", must be a multiple of 4");
    return indices;
}

} // namespace

Geometry read_triangle_mesh(ShapeDirective& shape, Warnings&) {
    ParameterList& parameters = shape.parameters;
    Mesh mesh;
    mesh.positions = read_positions(shape);
    mesh.normals = parameters.points("N");
    mesh.uvs = parameters.pairs("uv");
    if (mesh.uvs.empty()) mesh.uvs = parameters.pairs("st");
    check_length(shape, "N", mesh.normals.size(), mesh.positions.size());
    check_length(shape, "uv", mesh.uvs.size(), mesh.positions.size());
    mesh.triangles = read_triangles(shape, mesh.positions.size());
    parameters.ignore({"S", "faceIndices"});
    return mesh;
}

Geometry read_loop_subdivision(ShapeDirective& shape, Warnings& warnings) {
    Mesh mesh;
    mesh.positions = read_positions(shape);
    mesh.triangles = read_triangles(shape, mesh.positions.size());
    warnings.add(shape.parameters.location(), "loopsubdiv",
                 "shape \"loopsubdiv\": subdivision is not supported; the control mesh is used");
    shape.parameters.ignore({"levels", "nlevels", "scheme"});
    return mesh;
}

Geometry read_ply_mesh(ShapeDirective& shape, Warnings&) {
    ParameterList& parameters = shape.parameters;
    if (parameters.string("filename", "").empty())
        throw SceneError(parameters.location(),
                         "shape \"plymesh\": parameter \"string filename\" is missing");
    return MeshFile{shape.mesh_path, read_ply, parameters.location_of("filename")};
}

Geometry read_quad(ShapeDirective& shape, Warnings&) {
    ParameterList& parameters = shape.parameters;
    const auto o = parameters.point("o");
    const auto u = parameters.point("u");
    const auto v = parameters.point("v");
    if (!o || !u || !v)
        throw SceneError(
            parameters.location(),
            "shape \"quad\": must have the parameters \"point o\", \"vector u\" and \"vector v\"");
    const Double3 origin = to_double(*o);
    const Double3 along_u = origin + to_double(*u);
    Mesh mesh;
    mesh.positions = {*o, to_float(along_u), to_float(along_u + to_double(*v)),
                      to_float(origin + to_double(*v))};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = fan(4);
    return mesh;
}

Geometry read_polygon(ShapeDirective& shape, Warnings&) {
    Mesh mesh;
    mesh.positions = shape.parameters.points("P");
    std::vector<Double3> vertices;
    for (const Float3& p : mesh.positions) vertices.push_back(to_double(p));
    if (const auto defect = find_polygon_defect(vertices))
        throw SceneError(shape.parameters.location_of("P"), "shape \"polygon\": " + *defect);
    mesh.uvs = shape.parameters.pairs("uv");
    check_length(shape, "uv", mesh.uvs.size(), mesh.positions.size());
    mesh.triangles = fan(mesh.positions.size());
    return mesh;
}

Geometry read_bilinear_mesh(ShapeDirective& shape, Warnings&) {
    ParameterList& parameters = shape.parameters;
    BilinearPatches patches;
    patches.positions = read_positions(shape);
    patches.normals = parameters.points("N");
    patches.uvs = parameters.pairs("uv");
    check_length(shape, "N", patches.normals.size(), patches.positions.size());
    check_length(shape, "uv", patches.uvs.size(), patches.positions.size());
    patches.indices = read_patches(shape, patches.positions.size());
    parameters.ignore({"emissionfilename"});
    return patches;
}

} // namespace nusselt::scene
