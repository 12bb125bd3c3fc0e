#include "scene/input/missing_files.h"

#include <system_error>
#include <utility>

namespace nusselt::scene {

bool MissingFiles::note(const Location& location, std::string_view kind, const std::filesystem::path& path) {
    return note_with_message(location, std::string(kind) + " '" + path.string() + "': no such file", path);
}

bool MissingFiles::note_with_message(const Location& location, std::string message,
                                     const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::exists(status)) return false;
    if (paths_.insert(path.lexically_normal().string()).second)
        entries_.push_back({location, std::move(message), path});
    return true;
}

void MissingFiles::report() const {
    if (entries_.empty()) return;
    const Entry& first = entries_.front();
    if (entries_.size() == 1) throw SceneError(first.location, first.message);
    constexpr std::size_t kMaxListed = 700; // bytes
    std::string text = std::to_string(entries_.size()) + " files do not exist: ";
    std::size_t listed = 0;
    for (const Entry& entry : entries_) {
        const std::string item = "'" + entry.path.string() + "' (" + to_string(entry.location) + ")";
        if (listed > 0 && text.size() + item.size() > kMaxListed) break;
        text += (listed++ == 0 ? "" : ", ") + item;
    }
    if (listed < entries_.size()) text += " and " + std::to_string(entries_.size() - listed) + " more";
    throw SceneError(first.location, text);
}

} // namespace nusselt::scene
