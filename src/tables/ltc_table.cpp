#include "tables/ltc_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

// The assembler includes the files: a C++ array of a million numbers would take a compiler a minute.
asm(".section .rodata\n"
    ".balign 16\n"
    ".global nusselt_ltc_frostbite_begin\n"
    ".global nusselt_ltc_frostbite_end\n"
    "nusselt_ltc_frostbite_begin:\n"
    ".incbin \"" NUSSELT_LTC_FROSTBITE "\"\n"
    "nusselt_ltc_frostbite_end:\n"
    ".global nusselt_ltc_phong_begin\n"
    ".global nusselt_ltc_phong_end\n"
    "nusselt_ltc_phong_begin:\n"
    ".incbin \"" NUSSELT_LTC_PHONG "\"\n"
    "nusselt_ltc_phong_end:\n"
    ".previous\n");
extern "C" const char nusselt_ltc_frostbite_begin[];
extern "C" const char nusselt_ltc_frostbite_end[];
extern "C" const char nusselt_ltc_phong_begin[];
extern "C" const char nusselt_ltc_phong_end[];

namespace nusselt::tables {

namespace {

using Numbers = std::uint16_t[LtcTableFile::kNumbers];

std::uint16_t number_of(double fraction) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(fraction, 0.0, 1.0) * 65535));
}
std::uint16_t number_of_angle(double angle) { return number_of(angle / (kPi<double> / 2)); }
std::uint16_t number_of_width(double width) {
    return number_of((std::log2(width) - LtcTableFile::kNarrowest) / LtcTableFile::kWidthOctaves);
}

void encode_entry(const float* entry, Numbers& numbers) {
    numbers[0] = number_of_angle(std::atan2(entry[1], entry[0]));
    numbers[1] = number_of_angle(std::atan2(entry[3], entry[4]));
    numbers[2] = number_of_width(std::hypot(entry[3], entry[4]));
    numbers[3] = number_of_width(entry[2]);
    numbers[4] = number_of(entry[5]);
}

void append(std::string& bytes, std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
}

const unsigned char* unsigned_bytes(std::string_view bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

} // namespace

std::string encode(const LtcTable& table) {
    std::string payload;
    for (std::size_t i = 0; i < table.entries.size(); i += LtcTableView::kStride) {
        Numbers numbers;
        encode_entry(&table.entries[i], numbers);
        for (const std::uint16_t number : numbers) append(payload, number, 2);
    }
    std::string bytes(std::begin(LtcTableFile::kMagic), std::end(LtcTableFile::kMagic));
    for (const int samples : {table.roughnesses, table.inclinations, table.f0s})
        append(bytes, static_cast<std::uint64_t>(samples), 4);
    append(bytes, payload.size(), 4);
    append(bytes, LtcTableFile::hash(unsigned_bytes(payload), payload.size()), 8);
    return bytes + payload;
}

LtcTable decode(std::string_view bytes, const std::string& name) {
    const LtcTableFile file = open_ltc_table(bytes.data(), bytes.size());
    if (file.problem) throw std::runtime_error(fmt::format("{}: {}", name, file.problem));
    LtcTable table{file.roughnesses, file.inclinations, file.f0s, std::vector<float>(file.entries())};
    file.decode(table.entries.data());
    return table;
}

std::uint64_t checksum_of(std::string_view bytes) {
    const std::string_view payload = bytes.substr(LtcTableFile::kHeaderBytes);
    return LtcTableFile::hash(unsigned_bytes(payload), payload.size());
}

LtcTable load_ltc_table(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    // Linux opens folders, too.
    if (!file || std::filesystem::is_directory(path))
        throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    return decode(bytes, path.string());
}

namespace {

LtcTable decode_compiled_in(const char* begin, const char* end, const std::string& name) {
    return decode({begin, static_cast<std::size_t>(end - begin)}, name);
}

} // namespace

const LtcTable& frostbite_ltc_table() {
    static const LtcTable table = decode_compiled_in(nusselt_ltc_frostbite_begin, nusselt_ltc_frostbite_end,
                                                     "the table of the Frostbite BRDF that is compiled in");
    return table;
}

const LtcTable& phong_ltc_table() {
    static const LtcTable table = decode_compiled_in(nusselt_ltc_phong_begin, nusselt_ltc_phong_end,
                                                     "the table of Phong lobes that is compiled in");
    return table;
}

} // namespace nusselt::tables
