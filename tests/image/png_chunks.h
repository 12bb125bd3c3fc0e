#pragma once
/// Pieces of PNG files made by hand.

#include <zlib.h>

#include <cstdint>
#include <string>

namespace nusselt::image::test {

inline std::string big_endian(std::uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

/// \param type four letters, such as IHDR
inline std::string png_chunk(const std::string& type, const std::string& data) {
    const std::string summed = type + data;
    const auto* bytes = reinterpret_cast<const unsigned char*>(summed.data());
    return big_endian(std::uint32_t(data.size())) + summed +
           big_endian(std::uint32_t(crc32(0, bytes, uInt(summed.size()))));
}

} // namespace nusselt::image::test
