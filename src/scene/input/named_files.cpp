#include "scene/input/named_files.h"

#include <system_error>
#include <utility>

namespace nusselt::scene {

bool NamedFiles::note(const Location& location, std::string_view kind, const std::filesystem::path& path) {
    return note_with_message(location, std::string(kind) + " '" + path.string() + "': no such file", path);
}

bool NamedFiles::note_with_message(const Location& location, std::string message,
                                   const std::filesystem::path& path) {
    const std::filesystem::path normal = path.lexically_normal();
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::status(path, error))) {
        existing_.insert(normal);
        return true;
    }
    if (missing_paths_.insert(normal.string()).second)
        missing_.push_back({location, std::move(message), path});
    return false;
}

void NamedFiles::report_missing() const {
    if (missing_.empty()) return;
    const Missing& first = missing_.front();
    if (missing_.size() == 1) throw SceneError(first.location, first.message);
    constexpr std::size_t kMaxListed = 700; // bytes
    std::string text = std::to_string(missing_.size()) + " files do not exist: ";
    std::size_t listed = 0;
    for (const Missing& file : missing_) {
        const std::string item = "'" + file.path.string() + "' (" + to_string(file.location) + ")";
        if (listed > 0 && text.size() + item.size() > kMaxListed) break;
        text += (listed++ == 0 ? "" : ", ") + item;
    }
    if (listed < missing_.size()) text += " and " + std::to_string(missing_.size() - listed) + " more";
    throw SceneError(first.location, text);
}

} // namespace nusselt::scene
