#pragma once
/// Checksums of PNG files, which would keep changed inputs from everything behind them.

#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace nusselt::fuzz {

/// The file with right checksums of all its chunks, as far as they are complete. Other files stay as they are.
inline std::string with_right_checksums(std::string_view file) {
    std::string result(file);
    const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(result[i])}; };
    constexpr std::size_t kSignature = 8, kLength = 4, kType = 4, kChecksum = 4;
    if (!file.starts_with("\x89PNG")) return result;
    for (std::size_t chunk = kSignature; chunk + kLength + kType + kChecksum <= result.size();) {
        const std::size_t length =
            byte(chunk) << 24 | byte(chunk + 1) << 16 | byte(chunk + 2) << 8 | byte(chunk + 3);
        const std::size_t summed = kType + length;
        const std::size_t checksum = chunk + kLength + summed;
        if (checksum + kChecksum > result.size()) break;
        const auto* begin = reinterpret_cast<const unsigned char*>(result.data()) + chunk + kLength;
        const uLong sum = crc32(0, begin, static_cast<uInt>(summed));
        for (std::size_t i = 0; i < kChecksum; ++i)
            result[checksum + i] = static_cast<char>(sum >> (24 - 8 * i));
        chunk = checksum + kChecksum;
    }
    return result;
}

} // namespace nusselt::fuzz
