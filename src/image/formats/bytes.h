#pragma once
/// Numbers in files.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace nusselt::image {

/// \returns the number in `size` bytes, at most four, the lowest one first; bytes beyond the end of the file are zero
inline std::uint32_t little_endian(std::string_view file, std::size_t begin, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = begin + size; i-- > begin;)
        value = value << 8 | (i < file.size() ? static_cast<unsigned char>(file[i]) : 0u);
    return value;
}

} // namespace nusselt::image
