#include "scene/import/ply/ply.h"

#include "scene/build/polygons/polygon_triangulation.h"
#include "scene/import/ply/ply_header.h"
#include "scene/input/message.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

namespace nusselt::scene {

namespace {

static_assert(std::endian::native == std::endian::little);

/// The data end too early; where that is is known to who reads elements.
struct Truncated {};

[[noreturn]] void fail_truncated() { throw Truncated(); }

/// The value at `bytes`, of a type and byte order that are known at compile time.
template <class T, bool kSwap>
T load(const char* bytes) {
    char ordered[sizeof(T)];
    std::memcpy(ordered, bytes, sizeof(T));
    if constexpr (kSwap) std::reverse(ordered, ordered + sizeof(T));
    T value;
    std::memcpy(&value, ordered, sizeof(T));
    return value;
}

template <bool kSwap>
class BinaryReader {
public:
    explicit BinaryReader(std::string_view data) : data_(data) {}

    double read(PlyType type) {
        const std::size_t size = size_in_bytes(type);
        if (data_.size() < size) fail_truncated();
        const char* bytes = data_.data();
        data_.remove_prefix(size);
        switch (type) {
        case PlyType::int8:
            return load<std::int8_t, kSwap>(bytes);
        case PlyType::uint8:
            return load<std::uint8_t, kSwap>(bytes);
        case PlyType::int16:
            return load<std::int16_t, kSwap>(bytes);
        case PlyType::uint16:
            return load<std::uint16_t, kSwap>(bytes);
        case PlyType::int32:
            return load<std::int32_t, kSwap>(bytes);
        case PlyType::uint32:
            return load<std::uint32_t, kSwap>(bytes);
        case PlyType::float32:
            return static_cast<double>(load<float, kSwap>(bytes));
        case PlyType::float64:
            break;
        }
        return load<double, kSwap>(bytes);
    }
    void skip(PlyType type, std::size_t count) {
        const std::size_t size = size_in_bytes(type);
        if (data_.size() / size < count) fail_truncated();
        data_.remove_prefix(size * count);
    }
    /// The largest number of values of a type that the rest of the file can hold.
    std::size_t capacity(PlyType type) const { return data_.size() / size_in_bytes(type); }

private:
    std::string_view data_;
};

class AsciiReader {
public:
    explicit AsciiReader(std::string_view data) : data_(data) {}

    double read(PlyType) {
        data_.remove_prefix(std::min(data_.find_first_not_of(kSpace), data_.size()));
        if (data_.empty()) fail_truncated();
        double value = 0;
        const auto [end, error] = std::from_chars(data_.data(), data_.data() + data_.size(), value);
        const auto length = static_cast<std::size_t>(end - data_.data());
        const bool ends_here = length == data_.size() || kSpace.find(data_[length]) != std::string_view::npos;
        if (error == std::errc::invalid_argument || !ends_here)
            throw std::runtime_error(
                "expected a number, found '" +
                std::string(data_.substr(0, std::min<std::size_t>(data_.find_first_of(kSpace), 40))) + "'");
        if (error == std::errc::result_out_of_range) {
            // from_chars reports underflow like overflow and leaves the value unset; strtod distinguishes them.
            const std::string text(data_.substr(0, length));
            value = std::strtod(text.c_str(), nullptr);
            if (std::isinf(value)) throw std::runtime_error("number out of range: '" + shortened(text) + "'");
        }
        data_.remove_prefix(length);
        return value;
    }
    void skip(PlyType type, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) read(type);
    }
    /// A number takes a digit and a separator.
    std::size_t capacity(PlyType) const { return data_.size() / 2 + 1; }

private:
    static constexpr std::string_view kSpace = " \t\r\n";
    std::string_view data_;
};

template <class Reader>
std::size_t read_list_length(Reader& reader, const PlyProperty& property) {
    const double length = reader.read(property.count_type);
    if (!(length >= 0) || length != std::floor(length))
        throw std::runtime_error("list length " + to_text(length));
    if (length > static_cast<double>(reader.capacity(property.type))) fail_truncated();
    return static_cast<std::size_t>(length);
}

template <class Reader>
void skip_property(Reader& reader, const PlyProperty& property) {
    reader.skip(property.type, property.is_list ? read_list_length(reader, property) : 1);
}

/// Calls a function with the index of each row of an element, which errors then name.
template <class Function>
void for_each_row(const PlyElement& element, const Function& read_row) {
    std::size_t row = 0;
    try {
        for (; row < element.count; ++row) read_row(row);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("PLY data: " + std::string(element.name) + " " + std::to_string(row) + ": " +
                                 error.what());
    }
}

/// Throws unless the rest of the file can hold each column of the element, lists being empty at least.
/// This bounds the memory for the element by a multiple of the size of the file.
template <class Reader>
void check_count(const Reader& reader, const PlyElement& element) {
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const PlyProperty& property : element.properties)
        least = std::min(least, reader.capacity(property.is_list ? property.count_type : property.type));
    if (element.count > least) fail_truncated();
}

enum Column { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kU, kV, kColumns };

std::optional<Column> column_of(std::string_view name) {
    static constexpr std::pair<std::string_view, Column> kNames[] = {
        {"x", kX},         {"y", kY},         {"z", kZ},         {"nx", kNormalX}, {"ny", kNormalY},
        {"nz", kNormalZ},  {"u", kU},         {"v", kV},         {"s", kU},        {"t", kV},
        {"texture_u", kU}, {"texture_v", kV}, {"texture_s", kU}, {"texture_t", kV}};
    for (const auto& [column_name, column] : kNames)
        if (column_name == name) return column;
    return std::nullopt;
}

template <class Reader>
void read_vertices(Reader& reader, const PlyElement& element, Mesh& mesh) {
    std::vector<std::optional<Column>> columns;
    bool present[kColumns] = {};
    for (const PlyProperty& property : element.properties) {
        columns.push_back(property.is_list ? std::nullopt : column_of(property.name));
        if (columns.back()) present[*columns.back()] = true;
    }
    if (!present[kX] || !present[kY] || !present[kZ])
        throw std::runtime_error("PLY header: x, y or z is missing in element 'vertex'");
    const bool has_normals = present[kNormalX] && present[kNormalY] && present[kNormalZ];
    const bool has_uvs = present[kU] && present[kV];
    mesh.positions.resize(element.count);
    if (has_normals) mesh.normals.resize(element.count);
    if (has_uvs) mesh.uvs.resize(element.count);

    for_each_row(element, [&](std::size_t i) {
        float row[kColumns] = {};
        for (std::size_t j = 0; j < columns.size(); ++j) {
            if (columns[j]) {
                row[*columns[j]] = static_cast<float>(reader.read(element.properties[j].type));
            } else {
                skip_property(reader, element.properties[j]);
            }
        }
        mesh.positions[i] = {row[kX], row[kY], row[kZ]};
        if (has_normals) mesh.normals[i] = {row[kNormalX], row[kNormalY], row[kNormalZ]};
        if (has_uvs) mesh.uvs[i] = {row[kU], row[kV]};
    });
}

[[noreturn]] void fail_index(double index, std::size_t vertices) {
    if (index >= 0 && index < static_cast<double>(vertices))
        throw std::runtime_error("vertex index " + to_text(index) + " is not a whole number");
    throw std::runtime_error("vertex index " + to_text(index) + " is out of range for " +
                             std::to_string(vertices) + " vertices");
}

/// Reads polygons into a mesh that has its vertices.
class FaceReader {
public:
    explicit FaceReader(Mesh& mesh) : mesh_(mesh) {}

    template <class Reader>
    void read(Reader& reader, const PlyProperty& property) {
        corners_.resize(read_list_length(reader, property));
        for (std::uint32_t& corner : corners_) {
            const double index = reader.read(property.type);
            const bool is_vertex = index >= 0 && index < static_cast<double>(mesh_.positions.size());
            if (!is_vertex || std::floor(index) != index) fail_index(index, mesh_.positions.size());
            corner = static_cast<std::uint32_t>(index);
        }
        if (corners_.size() < 3) {
            ++mesh_.degenerate_triangles;
        } else if (corners_.size() == 3) {
            mesh_.triangles.push_back({{corners_[0], corners_[1], corners_[2]}});
        } else {
            split();
        }
    }

private:
    void split() {
        positions_.clear();
        for (const std::uint32_t corner : corners_) positions_.push_back(to_double(mesh_.positions[corner]));
        for (const Triangle& t : triangulate_polygon(positions_))
            mesh_.triangles.push_back(
                {{corners_[t.vertex[0]], corners_[t.vertex[1]], corners_[t.vertex[2]]}});
    }

    Mesh& mesh_;
    std::vector<std::uint32_t> corners_;
    std::vector<Double3> positions_;
};

template <class Reader>
void read_faces(Reader& reader, const PlyElement& element, Mesh& mesh) {
    mesh.triangles.reserve(mesh.triangles.size() + element.count);
    FaceReader faces(mesh);
    for_each_row(element, [&](std::size_t) {
        for (const PlyProperty& property : element.properties) {
            if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index")) {
                faces.read(reader, property);
            } else {
                skip_property(reader, property);
            }
        }
    });
}

template <class Reader>
void read_element(Reader& reader, const PlyElement& element, Mesh& mesh) {
    check_count(reader, element);
    if (element.name == "vertex") {
        if (element.count > std::numeric_limits<std::uint32_t>::max())
            throw std::runtime_error("PLY file has more than 2^32 vertices");
        read_vertices(reader, element, mesh);
    } else if (element.name == "face") {
        read_faces(reader, element, mesh);
    } else {
        for_each_row(element, [&](std::size_t) {
            for (const PlyProperty& property : element.properties) skip_property(reader, property);
        });
    }
}

/// The elements that make a mesh: one of vertices, then one of faces.
void check_elements(const PlyHeader& header) {
    int vertices = 0;
    int faces = 0;
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex") ++vertices;
        if (element.name == "face") ++faces;
        if (faces > vertices)
            throw std::runtime_error("PLY header: element 'face' must follow element 'vertex'");
        if (vertices > 1 || faces > 1)
            throw std::runtime_error("PLY header: element '" + std::string(element.name) + "' appears twice");
    }
    if (faces == 0) throw std::runtime_error("PLY header: element 'face' is missing");
}

template <class Reader>
Mesh read_elements(Reader reader, const PlyHeader& header) {
    Mesh mesh;
    for (const PlyElement& element : header.elements) {
        try {
            if (!element.properties.empty()) read_element(reader, element, mesh);
        } catch (const Truncated&) {
            throw std::runtime_error("PLY file ends before the last of " + std::to_string(element.count) +
                                     " of element '" + std::string(element.name) + "'");
        }
    }
    return mesh;
}

} // namespace

Mesh read_ply(std::string_view bytes) {
    const PlyHeader header = read_ply_header(bytes);
    check_elements(header);
    const std::string_view data = bytes.substr(header.size);
    switch (header.format) {
    case PlyFormat::ascii:
        return read_elements(AsciiReader(data), header);
    case PlyFormat::binary_little_endian:
        return read_elements(BinaryReader<false>(data), header);
    case PlyFormat::binary_big_endian:
        break;
    }
    return read_elements(BinaryReader<true>(data), header);
}

} // namespace nusselt::scene
