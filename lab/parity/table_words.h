#pragma once
/// Tables in the form in which buffers hold them.

#include "tables/blue_noise.h"
#include "tables/ltc_table.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace nusselt::parity {

inline std::vector<std::uint32_t> words_of(const std::string& bytes) {
    std::vector<std::uint32_t> words((bytes.size() + 3) / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

/// The words of the shipped table's file.
inline std::vector<std::uint32_t> table_words() {
    return words_of(tables::encode(tables::frostbite_ltc_table()));
}

/// The words of the shipped blue noise.
inline std::vector<std::uint32_t> blue_noise_words() {
    std::vector<std::uint32_t> words(BlueNoiseView::kBytes / 4);
    std::memcpy(words.data(), tables::blue_noise().bytes, BlueNoiseView::kBytes);
    return words;
}

} // namespace nusselt::parity
