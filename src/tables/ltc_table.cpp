#include "tables/ltc_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

// The linker includes the file: a C++ array of a million numbers would take a compiler a minute.
asm(".section .rodata\n"
    ".balign 16\n"
    ".global nusselt_ltc_frostbite_begin\n"
    ".global nusselt_ltc_frostbite_end\n"
    "nusselt_ltc_frostbite_begin:\n"
    ".incbin \"" NUSSELT_LTC_FROSTBITE "\"\n"
    "nusselt_ltc_frostbite_end:\n"
    ".previous\n");
extern "C" const char nusselt_ltc_frostbite_begin[];
extern "C" const char nusselt_ltc_frostbite_end[];

namespace nusselt::tables {

namespace {

constexpr std::string_view kMagic("nusselt-ltc\0\1\0\0\0", 16);
constexpr std::size_t kHeaderBytes = 40;
constexpr int kNumbers = 5;
constexpr int kMostSamples = 256; ///< along an axis
constexpr float kLargest = 65535;
constexpr float kRightAngle = kPi<float> / 2;

using Numbers = std::uint16_t[kNumbers];

std::uint16_t number_of(float fraction) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(fraction, 0.0f, 1.0f) * kLargest));
}
float fraction_of(std::uint16_t number) { return static_cast<float>(number) / kLargest; }

std::uint16_t number_of_width(float width) { return number_of((std::log2(width) + 24) / 27); }
float width_of(std::uint16_t number) { return std::exp2(fraction_of(number) * 27 - 24); }

void encode_entry(const float* entry, Numbers& numbers) {
    numbers[0] = number_of(std::atan2(entry[1], entry[0]) / kRightAngle);
    numbers[1] = number_of(std::atan2(entry[3], entry[4]) / kRightAngle);
    numbers[2] = number_of_width(std::hypot(entry[3], entry[4]));
    numbers[3] = number_of_width(entry[2]);
    numbers[4] = number_of(entry[5]);
}

void decode_entry(const Numbers& numbers, float* entry) {
    // In double, so that the cosine of a right angle stays positive.
    const double peak = fraction_of(numbers[0]) * (kPi<double> / 2);
    const double tilt = fraction_of(numbers[1]) * (kPi<double> / 2);
    const double width_x = width_of(numbers[2]);
    entry[0] = static_cast<float>(std::cos(peak));
    entry[1] = static_cast<float>(std::sin(peak));
    entry[2] = width_of(numbers[3]);
    entry[3] = static_cast<float>(width_x * std::sin(tilt));
    entry[4] = static_cast<float>(width_x * std::cos(tilt));
    entry[5] = fraction_of(numbers[4]);
}

template <class Integer>
void append(std::string& bytes, Integer value) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
}

template <class Integer>
Integer read(std::string_view bytes, std::size_t offset) {
    Integer value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
        value = static_cast<Integer>(
            value | static_cast<Integer>(static_cast<unsigned char>(bytes[offset + i])) << 8 * i);
    return value;
}

std::uint64_t fnv1a(std::string_view bytes) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
    return hash;
}

} // namespace

std::string encode(const LtcTable& table) {
    std::string payload;
    for (std::size_t i = 0; i < table.entries.size(); i += LtcTableView::kStride) {
        Numbers numbers;
        encode_entry(&table.entries[i], numbers);
        for (const std::uint16_t number : numbers) append(payload, number);
    }
    std::string bytes(kMagic);
    for (const int samples : {table.roughnesses, table.inclinations, table.f0s})
        append(bytes, static_cast<std::uint32_t>(samples));
    append(bytes, static_cast<std::uint32_t>(payload.size()));
    append(bytes, fnv1a(payload));
    return bytes + payload;
}

LtcTable decode(std::string_view bytes, const std::string& name) {
    const auto fail = [&](const std::string& problem) {
        throw std::runtime_error(fmt::format("{}: {}", name, problem));
    };
    if (bytes.size() < kHeaderBytes || bytes.substr(0, kMagic.size()) != kMagic)
        fail("not an LTC table, or of another version; `nusselt fit-ltc` writes them");
    std::uint32_t samples[3];
    std::size_t offset = kMagic.size();
    for (std::uint32_t& n : samples) {
        n = read<std::uint32_t>(bytes, offset);
        offset += sizeof n;
        if (n < 2 || n > kMostSamples)
            fail(fmt::format("{} samples along an axis; there must be 2 to {}", n, kMostSamples));
    }
    const std::size_t count = std::size_t{samples[0]} * samples[1] * samples[2];
    const std::size_t payload_bytes = count * sizeof(Numbers);
    if (read<std::uint32_t>(bytes, offset) != payload_bytes || bytes.size() != kHeaderBytes + payload_bytes)
        fail(fmt::format("{} bytes instead of {}; the file is truncated or damaged", bytes.size(),
                         kHeaderBytes + payload_bytes));
    if (read<std::uint64_t>(bytes, kHeaderBytes - sizeof(std::uint64_t)) != checksum_of(bytes))
        fail("the checksum does not match; the file is damaged");

    LtcTable table{
        static_cast<int>(samples[0]), static_cast<int>(samples[1]), static_cast<int>(samples[2]), {}};
    table.entries.resize(count * LtcTableView::kStride);
    for (std::size_t i = 0; i < count; ++i) {
        Numbers numbers;
        for (std::size_t k = 0; k < kNumbers; ++k)
            numbers[k] = read<std::uint16_t>(bytes, kHeaderBytes + (i * kNumbers + k) * sizeof numbers[k]);
        decode_entry(numbers, &table.entries[i * LtcTableView::kStride]);
    }
    return table;
}

std::uint64_t checksum_of(std::string_view bytes) { return fnv1a(bytes.substr(kHeaderBytes)); }

LtcTable load_ltc_table(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
    return decode(bytes, path.string());
}

const LtcTable& frostbite_ltc_table() {
    static const LtcTable table =
        decode({nusselt_ltc_frostbite_begin,
                static_cast<std::size_t>(nusselt_ltc_frostbite_end - nusselt_ltc_frostbite_begin)},
               "the table of the Frostbite BRDF that is compiled in");
    return table;
}

} // namespace nusselt::tables
