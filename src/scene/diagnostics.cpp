#include "scene/diagnostics.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace nusselt::scene {

namespace {

constexpr std::size_t kMaxWarnings = 200;

/// Names in messages come from files and may hold anything.
std::string message_line(const Location& location, std::string_view message) {
    constexpr std::size_t kMaxBytes = 1000;
    std::string line = to_string(location) + ": " + shortened(message, kMaxBytes);
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    std::replace_if(line.begin(), line.end(), is_control, '?');
    return line;
}

} // namespace

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

std::string to_string(const Location& location) {
    return location.file->path.string() + ":" + std::to_string(location.line);
}

SceneError::SceneError(const Location& location, std::string_view message)
    : std::runtime_error(message_line(location, message)) {}

void Warnings::add(const Location& location, std::string kind, std::string_view message) {
    add_entry({std::move(kind), message_line(location, message)});
}

void Warnings::add(const Location& location, std::string_view message) {
    add(location, std::string(message), message);
}

void Warnings::append(const Warnings& other) {
    for (const Entry& entry : other.entries_) add_entry(entry);
}

void Warnings::add_entry(Entry entry) {
    if (entries_.size() > kMaxWarnings || !kinds_.insert(entry.kind).second) return;
    entries_.push_back(std::move(entry));
    if (entries_.size() == kMaxWarnings) entries_.push_back({"", "further kinds of warnings are not shown"});
}

std::vector<std::string> Warnings::lines() const {
    std::vector<std::string> result;
    for (const Entry& entry : entries_) result.push_back(entry.line);
    return result;
}

} // namespace nusselt::scene
