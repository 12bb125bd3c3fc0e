#pragma once
/// Bytes and numbers in files.

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>

namespace nusselt::image {

/// \returns the number in `size` bytes, at most four, the lowest one first; bytes beyond the end of the file are zero
inline std::uint32_t little_endian(std::string_view file, std::size_t begin, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = begin + size; i-- > begin;)
        value = value << 8 | (i < file.size() ? static_cast<unsigned char>(file[i]) : 0u);
    return value;
}

/// `count` bytes of the file from `begin`, fewer at its end.
std::string bytes_at(std::istream& file, std::int64_t begin, std::size_t count);

/// Fails because a file has fewer bytes than its pixels need.
[[noreturn]] void fail_as_cut_off();

/// The number of bytes in the file, whose position becomes its beginning.
std::int64_t byte_count(std::istream& file);

/// Reads a file in large steps.
class ByteSource {
public:
    /// \param begin  of the first bytes to take
    ByteSource(std::istream& file, std::int64_t begin);

    /// The next bytes, which stay until the next call.
    /// \throws std::runtime_error  if the file has fewer
    std::string_view take(std::size_t count);

private:
    std::istream& file_;
    std::string buffer_;
    std::size_t used_ = 0; ///< bytes of the buffer that were taken
};

} // namespace nusselt::image
