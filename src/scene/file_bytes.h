#pragma once
/// Whole files in memory, decompressed where they are gzip files.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace nusselt::scene {

/// The largest file, and the largest content of a compressed file, that is read.
constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 34;

/// The bytes of a file. The memory is not zeroed before it is read.
class FileBytes {
public:
    FileBytes() = default;
    /// Contents that begin like a gzip file are decompressed, whatever the name. Throws std::runtime_error with the
    /// reason if `path` is no readable regular file of at most kMaxFileBytes, or compressed and broken.
    explicit FileBytes(const std::filesystem::path& path);
    std::string_view view() const { return {data_.get(), size_}; }

private:
    friend FileBytes inflated(std::string_view, std::uint64_t);

    struct Free {
        void operator()(char* memory) const { std::free(memory); }
    };
    /// Keeps what is there already. Throws std::bad_alloc.
    void resize(std::size_t size);

    std::unique_ptr<char, Free> data_;
    std::size_t size_ = 0;
};

/// Where a file that a scene names is: in the first of two folders, or in the second one if it is only there.
std::filesystem::path find_file(const std::string& name, const std::filesystem::path& first_folder,
                                const std::filesystem::path& second_folder);

/// Whether these are the first bytes of a gzip file.
bool is_gzip(std::string_view bytes);

/// Decompresses a gzip file, which may consist of several parts; zeros behind the last part are padding. The memory in
/// use grows with what has been decompressed. Throws std::runtime_error with the reason if the file is broken, ends
/// early, or holds more than `max_size` bytes.
FileBytes inflated(std::string_view gzip, std::uint64_t max_size);

} // namespace nusselt::scene
