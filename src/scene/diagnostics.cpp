#include "scene/diagnostics.h"

#include <charconv>
#include <utility>

namespace nusselt::scene {

std::string to_text(double value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string to_string(const Location& location) {
    return location.file->path.string() + ":" + std::to_string(location.line);
}

SceneError::SceneError(const Location& location, std::string_view message)
    : std::runtime_error(to_string(location) + ": " + std::string(message)) {}

void Warnings::add(const Location& location, std::string kind, std::string_view message) {
    add_entry({std::move(kind), to_string(location) + ": " + std::string(message)});
}

void Warnings::add(const Location& location, std::string_view message) {
    add(location, std::string(message), message);
}

void Warnings::append(const Warnings& other) {
    for (const Entry& entry : other.entries_) add_entry(entry);
}

void Warnings::add_entry(Entry entry) {
    if (kinds_.insert(entry.kind).second) entries_.push_back(std::move(entry));
}

std::vector<std::string> Warnings::lines() const {
    std::vector<std::string> result;
    for (const Entry& entry : entries_) result.push_back(entry.line);
    return result;
}

} // namespace nusselt::scene
