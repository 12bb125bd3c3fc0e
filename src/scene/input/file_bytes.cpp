#include "scene/input/file_bytes.h"

#include "base/gzip.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace nusselt::scene {

namespace {

/// A readable regular file of at most kMaxFileBytes.
struct OpenFile {
    std::ifstream stream;
    std::uintmax_t size;
};

OpenFile open_file(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::status_known(status))
        throw std::runtime_error("not accessible (" + error.message() + ")");
    if (!std::filesystem::exists(status)) throw std::runtime_error("no such file");
    if (std::filesystem::is_directory(status)) throw std::runtime_error("a folder, not a file");
    if (!std::filesystem::is_regular_file(status))
        throw std::runtime_error("a pipe or a device, not a file; copy its contents into a file");
    const auto size = std::filesystem::file_size(path, error);
    std::ifstream stream(path, std::ios::binary);
    if (error || !stream) throw std::runtime_error("cannot be opened");
    if (size > kMaxFileBytes)
        throw std::runtime_error("larger than " + std::to_string(kMaxFileBytes) + " bytes");
    return {std::move(stream), size};
}

} // namespace

FileBytes::FileBytes(const std::filesystem::path& path, Budget& inflated_bytes) {
    auto [stream, size] = open_file(path);
    resize(size);
    stream.read(data_.get(), static_cast<std::streamsize>(size));
    if (!stream) throw std::runtime_error("cannot be read");
    if (!is_gzip(view())) return;
    *this = inflated(view(), inflated_bytes);
    if (is_gzip(view())) throw std::runtime_error("compressed twice; decompress it once (gunzip)");
}

void FileBytes::resize(std::size_t size) {
    void* const memory = std::realloc(data_.get(), std::max<std::size_t>(size, 1));
    if (memory == nullptr) throw std::bad_alloc();
    static_cast<void>(data_.release());
    data_.reset(static_cast<char*>(memory));
    size_ = size;
}

void FileBytes::release_before(const char* position) {
    constexpr std::size_t kStep = std::size_t{1} << 20;
    const auto end = static_cast<std::size_t>(position - data_.get());
    if (end < released_ + kStep) return;
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGE_SIZE));
    const auto rounded_up = [&](std::size_t offset) {
        return (reinterpret_cast<std::uintptr_t>(data_.get()) + offset + page - 1) / page * page;
    };
    // The page with the position itself is still needed.
    const std::uintptr_t first = rounded_up(released_);
    const std::uintptr_t last = rounded_up(end) - page;
    released_ = end - page;
    if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
}

std::unique_ptr<std::istream> open_contents(const std::filesystem::path& path, Budget& inflated_bytes) {
    auto file = std::make_unique<std::ifstream>(open_file(path).stream);
    std::array<char, 2> begin = {};
    file->read(begin.data(), begin.size());
    if (is_gzip({begin.data(), begin.size()}))
        return std::make_unique<std::istringstream>(std::string(FileBytes(path, inflated_bytes).view()));
    file->clear();
    file->seekg(0);
    return file;
}

std::filesystem::path find_file(const std::string& name, const std::filesystem::path& first_folder,
                                const std::filesystem::path& second_folder) {
    std::error_code ignored;
    const std::filesystem::path first = first_folder / name;
    if (std::filesystem::exists(first, ignored)) return first;
    const std::filesystem::path second = second_folder / name;
    return std::filesystem::exists(second, ignored) ? second : first;
}

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

FileBytes inflated(std::string_view gzip, Budget& bytes) {
    // So little that it does not matter if a budget is exceeded before it is asked.
    constexpr std::size_t kMaxStep = std::size_t{1} << 20;
    base::InflateStream stream;
    FileBytes result;
    std::size_t used = 0;
    std::string_view rest = gzip;
    for (bool is_complete = false; !is_complete;) {
        if (used == result.size_) result.resize(std::max<std::size_t>(4 * gzip.size(), 2 * used));
        char* output = result.data_.get() + used;
        const bool part_ends = stream.step(rest, output, std::min(result.size_ - used, kMaxStep));
        const auto end = static_cast<std::size_t>(output - result.data_.get());
        if (end > kFreelyInflated + kMaxInflation * gzip.size())
            throw std::runtime_error("decompresses to more than " + std::to_string(kMaxInflation) +
                                     " times its size; decompress it (gunzip) if this is intended");
        bytes.take(end - used);
        used = end;
        if (!part_ends) continue;
        is_complete = rest.find_first_not_of('\0') == std::string_view::npos;
        stream.restart();
    }
    result.resize(used);
    return result;
}

std::uint64_t claimed_size(const std::filesystem::path& path) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error) return 0;
    char first[2] = {};
    unsigned char last[4] = {};
    std::ifstream stream(path, std::ios::binary);
    stream.read(first, sizeof first);
    if (!is_gzip({first, sizeof first})) return size;
    stream.seekg(-static_cast<std::streamoff>(sizeof last), std::ios::end);
    stream.read(reinterpret_cast<char*>(last), sizeof last);
    const auto claim = last[0] | last[1] << 8 | last[2] << 16 | std::uint64_t{last[3]} << 24;
    return std::max<std::uint64_t>(size, claim);
}

} // namespace nusselt::scene
