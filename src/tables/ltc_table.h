#pragma once
/// Tables of linearly transformed cosines in memory and in files.

#include <nusselt/ltc/table_file.h>

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

/// The bytes of a table file (nusselt/ltc/table_file.h), numbers rounded to nearest.
std::string encode(const LtcTable& table);

/// \param name of the source, for messages.
/// \throws std::runtime_error saying what is wrong
LtcTable decode(std::string_view bytes, const std::string& name);

/// The 64-bit FNV-1a hash of the part of an encoded table that follows the header.
std::uint64_t checksum_of(std::string_view bytes);

/// \throws std::runtime_error naming the file
LtcTable load_ltc_table(const std::filesystem::path& path);

/// The table of the specular Frostbite BRDF (data/ltc-frostbite.bin) that is compiled in. Decoded on the first call.
const LtcTable& frostbite_ltc_table();

/// The table of Phong lobes (data/ltc-phong.bin) that is compiled in, for phong_fit_of(). Decoded on the first call.
const LtcTable& phong_ltc_table();

} // namespace nusselt::tables
