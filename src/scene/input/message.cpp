#include "scene/input/message.h"

#include <charconv>

namespace nusselt::scene {

std::string to_text(double value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string shortened(std::string_view text, std::size_t max_bytes) {
    if (text.size() <= max_bytes) return std::string(text);
    std::size_t size = max_bytes;
    const auto continues_character = [&] { return (static_cast<unsigned char>(text[size]) & 0xc0) == 0x80; };
    while (size > 0 && continues_character()) --size;
    return std::string(text.substr(0, size)) + "...";
}

std::string with_article(std::string_view noun) {
    const bool begins_with_vowel = std::string_view("aeiou").find(noun.front()) != std::string_view::npos;
    return (begins_with_vowel ? "an " : "a ") + std::string(noun);
}

std::string message_line(std::string_view message) {
    // Room for the longest path that systems know, beside words of one's own.
    constexpr std::size_t kMaxBytes = 8000;
    std::string line = shortened(message, kMaxBytes);
    unsigned char previous = 0;
    for (char& c : line) {
        const auto byte = static_cast<unsigned char>(c);
        // UTF-8 writes the control characters from U+0080 to U+009F as two bytes, c2 and themselves.
        const bool is_second_of_control = previous == 0xc2 && byte >= 0x80 && byte < 0xa0;
        if (byte < 0x20 || byte == 0x7f || is_second_of_control) c = '?';
        if (is_second_of_control) *(&c - 1) = '?';
        previous = byte;
    }
    return line;
}

} // namespace nusselt::scene
