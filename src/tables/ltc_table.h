#pragma once
/// Tables of linearly transformed cosines in memory and in files.

#include <nusselt/ltc/table.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::tables {

struct LtcTable {
    int roughnesses = 0; ///< numbers of samples
    int inclinations = 0;
    int f0s = 0;
    std::vector<float> entries; ///< as LtcTableView::entries

    /// Valid as long as the table lives and `entries` is not resized.
    LtcTableView view() const { return {entries.data(), roughnesses, inclinations, f0s}; }
};

/// The bytes of a table file. Each sample becomes five numbers of 16 bits, rounded to nearest:
///
///     angle of the peak, angle of the horizon    u / 65535 is the angle over pi / 2
///     width_x, width_y / width_x                 u / 65535 is (log2(x) + 24) / 27
///     albedo                                     u / 65535
///
/// where the rows of cosine_from_shading are (cos peak, 0, sin peak) / width_x, (0, 1, 0) / width_y and
/// (-sin tilt, 0, cos tilt). They follow, sample by sample as in memory, a header of 40 bytes: "nusselt-ltc\0\1\0\0\0",
/// three numbers of samples, their product times ten, all of 32 bits, and the 64-bit FNV-1a hash of the rest; everything
/// little-endian. Half floats of the matrix would lose three times as much where lobes are narrow.
std::string encode(const LtcTable& table);

/// \param name of the source, for messages.
/// \throws std::runtime_error saying what is wrong: no such file, sizes, length or checksum
LtcTable decode(std::string_view bytes, const std::string& name);

/// The 64-bit FNV-1a hash of the part of an encoded table that follows the header.
std::uint64_t checksum_of(std::string_view bytes);

/// \throws std::runtime_error naming the file
LtcTable load_ltc_table(const std::filesystem::path& path);

/// The table of the specular Frostbite BRDF (data/ltc-frostbite.bin) that is compiled in. Decoded on the first call.
const LtcTable& frostbite_ltc_table();

} // namespace nusselt::tables
