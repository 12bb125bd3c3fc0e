#include "base/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace nusselt::base {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& problem) {
    throw std::runtime_error("cannot write '" + path.string() + "': " + problem);
}

/// Unique among the processes and threads that may write into one folder at the same time.
std::filesystem::path temporary_path(const std::filesystem::path& path) {
    static std::atomic<unsigned> counter = 0;
    const std::string unique = std::to_string(::getpid()) + "-" + std::to_string(counter++);
    // Without the name of the file, which may be as long as names can be.
    return path.parent_path() / (".nusselt-" + unique + ".tmp");
}

/// Waits until the disk has all bytes of a file, or all names of a folder.
/// \returns 0 or the number of an error
int store(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return errno;
    const int error = ::fsync(descriptor) == 0 ? 0 : errno;
    ::close(descriptor);
    return error == EINVAL || error == EROFS ? 0 : error; // file systems without a disk
}

/// Removes the file at the end of the scope; without effect once the file was renamed.
class RemoveAtExit {
public:
    explicit RemoveAtExit(const std::filesystem::path& path) : path_(path) {}
    RemoveAtExit(const RemoveAtExit&) = delete;
    RemoveAtExit& operator=(const RemoveAtExit&) = delete;
    ~RemoveAtExit() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }

private:
    const std::filesystem::path& path_;
};

/// The file to which a path leads through symbolic links, which may not exist yet; the path itself without links.
std::filesystem::path target_of(const std::filesystem::path& path) {
    // As many as Linux follows.
    constexpr int kMaxLinks = 40;
    std::filesystem::path target = path;
    std::error_code error;
    for (int i = 0; i < kMaxLinks; ++i) {
        const std::filesystem::path next = std::filesystem::read_symlink(target, error);
        if (error) return target;
        target = target.parent_path() / next; // an absolute path replaces the folder
    }
    fail(path, "its symbolic links form a loop; remove them or choose another name");
}

} // namespace

void write_atomically(const std::filesystem::path& name, const std::function<void(std::ofstream&)>& write) {
    if (name.empty()) fail(name, "the name of the file is empty");
    std::error_code error;
    // Renaming would replace a link instead of the file to which it leads.
    const std::filesystem::path path = target_of(name);
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    const std::filesystem::file_status folder_status = std::filesystem::status(folder, error);
    if (!std::filesystem::status_known(folder_status)) {
        fail(name, "the folder '" + folder.string() + "' is not accessible (" + error.message() +
                       "); check the permissions of the folders above it or choose another path");
    }
    if (!std::filesystem::is_directory(folder_status))
        fail(name, "the folder '" + folder.string() + "' does not exist; create it or choose another path");
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::status_known(status)) fail(name, error.message() + "; choose another name");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        fail(name, "this is a folder or a device; use the name of a file");

    const std::filesystem::path temporary = temporary_path(path);
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (!stream) {
        fail(name, "cannot create a file in '" + folder.string() + "' (" + std::strerror(errno) +
                       "); check its permissions or choose another folder");
    }
    const RemoveAtExit remove_temporary(temporary);
    // Before there is anything to read: who may not read the old contents may not read the new ones. store() reads.
    if (std::filesystem::exists(status)) {
        const std::filesystem::perms rights = status.permissions() & std::filesystem::perms::all;
        // Errors are ignored: file systems without permissions give all files the same ones.
        std::filesystem::permissions(temporary, rights | std::filesystem::perms::owner_read, error);
    }
    errno = 0;
    try {
        write(stream);
    } catch (...) {
        if (stream) throw; // what a failed stream made `write` throw is reported below
    }
    stream.close();
    if (!stream)
        fail(name, errno == EFBIG
                       ? "cannot store the data; it exceeds the limit on the size of files (see ulimit -f)"
                       : "cannot store the data; check the free space of the disk");
    // Without this, a crash of the machine could leave the new name with the bytes of neither file.
    if (const int problem = store(temporary); problem != 0)
        fail(name, std::string("cannot store the data (") + std::strerror(problem) + "); check the disk");
    std::filesystem::rename(temporary, path, error);
    if (error) fail(name, "cannot rename the temporary file (" + error.message() + ")");
    // Errors are ignored: without read permission for the folder, the system decides when the name is stored.
    store(folder);
}

void check_writable(const std::filesystem::path& path) {
    struct Abandoned {};
    try {
        write_atomically(path, [](std::ofstream&) { throw Abandoned(); });
    } catch (const Abandoned&) {
        // The exception shows success: the temporary file could be created, and is removed again.
    }
}

} // namespace nusselt::base
