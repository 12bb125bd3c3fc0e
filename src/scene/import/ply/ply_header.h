#pragma once
/// The header of a PLY file.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::scene {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_in_bytes(PlyType type);

struct PlyProperty {
    std::string_view name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType count_type = PlyType::uint8; ///< of a list
};

struct PlyElement {
    std::string_view name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0; ///< bytes up to the begin of the data
};

/// Throws std::runtime_error with the offending line. Names in the result point into `bytes`.
PlyHeader read_ply_header(std::string_view bytes);

} // namespace nusselt::scene
