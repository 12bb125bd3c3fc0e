#pragma once
/// Contents of files, decompressed where they are gzip files.

#include "scene/input/limits.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <istream>
#include <memory>
#include <string>
#include <string_view>

namespace nusselt::scene {

/// The bytes of a file. The memory is not zeroed before it is read.
class FileBytes {
public:
    FileBytes() = default;
    /// Contents that begin like a gzip file are decompressed, whatever the name. Throws std::runtime_error with the
    /// reason if `path` is no readable regular file of at most kMaxFileBytes, or compressed and broken.
    /// \param inflated_bytes  from which decompressed contents are taken
    FileBytes(const std::filesystem::path& path, Budget& inflated_bytes);
    std::string_view view() const { return {data_.get(), size_}; }

    /// Gives the memory in front of a position back to the system, in steps of some size. What the view has there must
    /// not be read any more.
    void release_before(const char* position);

private:
    friend FileBytes inflated(std::string_view, Budget&);

    struct Free {
        void operator()(char* memory) const { std::free(memory); }
    };
    /// Keeps what is there already. Throws std::bad_alloc.
    void resize(std::size_t size);

    std::unique_ptr<char, Free> data_;
    std::size_t size_ = 0;
    std::size_t released_ = 0; ///< bytes in front
};

/// The contents of a file to read piece by piece. Those of gzip files are decompressed and stay in memory as a whole.
/// Throws like the constructor of FileBytes.
std::unique_ptr<std::istream> open_contents(const std::filesystem::path& path, Budget& inflated_bytes);

/// The path of a file that a scene names: in the first of two folders, or in the second one if only that one has it.
std::filesystem::path find_file(const std::string& name, const std::filesystem::path& first_folder,
                                const std::filesystem::path& second_folder);

/// Whether these are the first bytes of a gzip file.
bool is_gzip(std::string_view bytes);

/// Decompresses a gzip file, which may consist of several parts; zeros behind the last part are padding. The memory in
/// use grows with what has been decompressed, which is taken from `bytes`. Throws std::runtime_error with the reason if
/// the file is broken, ends early, or holds more bytes than are left.
FileBytes inflated(std::string_view gzip, Budget& bytes);

/// The size of a file after decompression, provided that it is one gzip file of less than 4 GiB that states the
/// truth, else at least how many there are on the disk; 0 for what cannot be read.
std::uint64_t claimed_size(const std::filesystem::path& path);

} // namespace nusselt::scene
