#include "scene/input/diagnostics.h"

#include <algorithm>
#include <utility>

namespace nusselt::scene {

namespace {

constexpr std::size_t kMaxWarnings = 200;

std::string located_line(const Location& location, std::string_view message) {
    constexpr std::size_t kMaxBytes = 1000;
    const std::string place = location.file != nullptr ? to_string(location) + ": " : "";
    return message_line(place + std::string(shortened(message, kMaxBytes)));
}

} // namespace

std::string to_string(const Location& location) {
    const std::string path = location.file->path.string();
    return location.line > 0 ? path + ":" + std::to_string(location.line) : path;
}

SceneError::SceneError(const Location& location, std::string_view message)
    : std::runtime_error(located_line(location, message)) {}

void Warnings::add(const Location& location, std::string kind, std::string_view message) {
    add_entry({std::move(kind), located_line(location, message)});
}

void Warnings::add(const Location& location, std::string_view message) {
    add(location, std::string(message), message);
}

void Warnings::append(const Warnings& other) {
    for (const Entry& entry : other.entries_) add_entry(entry);
}

void Warnings::add_entry(Entry entry) {
    if (entries_.size() > kMaxWarnings) return;
    const auto has_kind = [&](const Entry& other) { return other.kind == entry.kind; };
    if (std::any_of(entries_.begin(), entries_.end(), has_kind)) return;
    entries_.push_back(std::move(entry));
    if (entries_.size() == kMaxWarnings) entries_.push_back({"", "further kinds of warnings are not shown"});
}

std::vector<std::string> Warnings::lines() const {
    std::vector<std::string> result;
    for (const Entry& entry : entries_) result.push_back(entry.line);
    return result;
}

} // namespace nusselt::scene
