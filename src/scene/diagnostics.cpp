#include "scene/diagnostics.h"

#include <charconv>
#include <fstream>
#include <system_error>

namespace nusselt::scene {

FileBytes::FileBytes(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw std::runtime_error("no such file");
    if (!std::filesystem::is_regular_file(status)) throw std::runtime_error("not a regular file");
    const auto size = std::filesystem::file_size(path, error);
    std::ifstream stream(path, std::ios::binary);
    if (error || !stream) throw std::runtime_error("cannot be opened");
    data_ = std::make_unique_for_overwrite<char[]>(size);
    stream.read(data_.get(), static_cast<std::streamsize>(size));
    if (!stream) throw std::runtime_error("cannot be read");
    size_ = size;
}

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
