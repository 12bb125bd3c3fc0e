#include "tables/engine_table.h"

#include <Imath/half.h>
#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

namespace nusselt::tables {

namespace {

constexpr float kScale = 1024;
constexpr int kHalves = 6;

void append(std::string& bytes, float value) {
    const auto bits = Imath::half(value).bits();
    bytes += static_cast<char>(bits & 0xff);
    bytes += static_cast<char>(bits >> 8);
}

float read(std::string_view bytes, std::size_t index) {
    Imath::half value;
    value.setBits(static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[2 * index]) |
                                             static_cast<unsigned char>(bytes[2 * index + 1]) << 8));
    return value;
}

} // namespace

std::string encode_for_engines(const LtcTable& table, float f0) {
    const auto last = static_cast<std::size_t>(table.f0s - 1);
    const auto shape = static_cast<std::size_t>(std::lround(f0 * static_cast<float>(last)));
    std::string bytes;
    for (int cell = 0; cell < table.roughnesses * table.inclinations; ++cell) {
        const float* row = &table.entries[static_cast<std::size_t>(cell * table.f0s) * LtcTableView::kStride];
        const float* entry = row + shape * LtcTableView::kStride;
        const float inverse_m11 = kScale * entry[2];
        append(bytes, entry[0] * inverse_m11);
        append(bytes, -entry[3] * inverse_m11);
        append(bytes, entry[1] * inverse_m11);
        append(bytes, entry[4] * inverse_m11);
        const float bias = row[LtcTableView::kStride - 1];
        append(bytes, row[(last + 1) * LtcTableView::kStride - 1] - bias);
        append(bytes, bias);
    }
    return bytes;
}

LtcTable decode_for_engines(std::string_view bytes, int roughnesses, int inclinations,
                            const std::string& name) {
    const auto count = static_cast<std::size_t>(roughnesses * inclinations);
    if (bytes.size() != count * kHalves * 2)
        throw std::runtime_error(
            fmt::format("{}: found {} bytes, expected {}", name, bytes.size(), count * kHalves * 2));
    LtcTable table{roughnesses, inclinations, 2, {}};
    for (std::size_t i = 0; i < count; ++i) {
        float halves[kHalves];
        for (std::size_t k = 0; k < kHalves; ++k) halves[k] = read(bytes, i * kHalves + k);
        const float length = std::hypot(halves[0], halves[2]);
        for (const float f0 : {0.0f, 1.0f})
            table.entries.insert(table.entries.end(),
                                 {halves[0] / length, halves[2] / length, length / kScale,
                                  -halves[1] / length, halves[3] / length, f0 * halves[4] + halves[5]});
    }
    return table;
}

} // namespace nusselt::tables
