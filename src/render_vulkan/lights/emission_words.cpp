#include "render_vulkan/lights/emission_words.h"

#include "render_vulkan/record_values.h"

#include <cstring>

namespace nusselt::render_vulkan {

std::uint32_t grow_words(std::vector<std::uint32_t>& words, std::size_t count) {
    const std::size_t first = words.size();
    checked_count(std::uint64_t{first} + count, "words of emission that varies");
    words.resize(first + count);
    return static_cast<std::uint32_t>(first);
}

std::uint32_t add_floats(std::span<const float> numbers, std::vector<std::uint32_t>& words) {
    const std::uint32_t first = grow_words(words, numbers.size());
    if (!numbers.empty()) std::memcpy(words.data() + first, numbers.data(), numbers.size_bytes());
    return first;
}

std::uint32_t add_texels(std::span<const Vec3<float>> texels, std::vector<std::uint32_t>& words) {
    static_assert(sizeof(Vec3<float>) == 3 * sizeof(std::uint32_t));
    const std::uint32_t first = grow_words(words, 3 * texels.size());
    if (!texels.empty()) std::memcpy(words.data() + first, texels.data(), texels.size_bytes());
    return first;
}

} // namespace nusselt::render_vulkan
