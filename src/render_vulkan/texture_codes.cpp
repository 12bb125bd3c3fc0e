#include "render_vulkan/texture_codes.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

namespace nusselt::render_vulkan {

namespace {

constexpr std::size_t kMostValues = std::size_t{1} << 16;

/// Numbers distinct values in the order of their first occurrence.
class ValueList {
public:
    /// \param most the largest number of distinct values, at most kMostValues
    explicit ValueList(std::size_t most) : most_(most), slots_(std::bit_ceil(2 * most + 1)) {}

    /// The number of a value; empty if that would exceed the largest number.
    std::optional<std::uint16_t> number_of(std::uint32_t value) {
        const std::size_t mask = slots_.size() - 1;
        // Neighbouring floats differ in their low bits, round ones in their high bits: both reach the middle of the product.
        std::size_t slot = (std::uint64_t{value} * 0x9e3779b97f4a7c15u >> 32) & mask;
        while (slots_[slot] != 0) {
            const std::size_t number = slots_[slot] - 1;
            if (values_[number] == value) return static_cast<std::uint16_t>(number);
            slot = (slot + 1) & mask;
        }
        if (values_.size() == most_) return std::nullopt;
        values_.push_back(value);
        slots_[slot] = static_cast<std::uint32_t>(values_.size());
        return static_cast<std::uint16_t>(values_.size() - 1);
    }

    std::vector<std::uint32_t>& values() { return values_; }

private:
    std::size_t most_;
    std::vector<std::uint32_t> slots_; ///< number of the value plus 1, or 0
    std::vector<std::uint32_t> values_;
};

template <class Code>
void write_code(std::size_t code, std::byte* to) {
    const auto narrow = static_cast<Code>(code);
    std::memcpy(to, &narrow, sizeof narrow);
}

} // namespace

TextureCodes encode_texels(std::span<const float> texels) {
    // Codes of two bytes and values of four bytes save memory only if at most half of the numbers are distinct.
    const std::size_t most = std::min(kMostValues, texels.size() / 2);
    if (most == 0) return {};
    ValueList list(most);
    TextureCodes result;
    result.codes.reserve(texels.size());
    for (const float texel : texels) {
        const std::optional<std::uint16_t> code = list.number_of(std::bit_cast<std::uint32_t>(texel));
        if (!code) return {};
        result.codes.push_back(*code);
    }
    result.values = std::move(list.values());
    result.packing = result.values.size() <= 256 ? 2 : 1;
    return result;
}

std::vector<std::byte> packed_codes(const scene::Texture& texture, const TextureCodes& codes, int channels) {
    const auto from = static_cast<std::size_t>(texture.channels);
    const auto to = static_cast<std::size_t>(channels);
    const std::size_t texels = texture.texels.size() / from;
    const std::size_t code_bytes = std::size_t{4} >> codes.packing;
    std::vector<std::byte> bytes(texels * to * code_bytes);
    for (std::size_t i = 0; i < texels; ++i) {
        for (std::size_t k = 0; k < from; ++k) {
            const std::size_t number = from * i + k;
            std::byte* place = bytes.data() + (to * i + k) * code_bytes;
            switch (codes.packing) {
            case 0:
                write_code<std::uint32_t>(std::bit_cast<std::uint32_t>(texture.texels[number]), place);
                break;
            case 1:
                write_code<std::uint16_t>(codes.codes[number], place);
                break;
            default:
                write_code<std::uint8_t>(codes.codes[number], place);
            }
        }
    }
    return bytes;
}

} // namespace nusselt::render_vulkan
