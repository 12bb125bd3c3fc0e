#include "scene/input/file_bytes.h"

#include "base/gzip.h"

#include <algorithm>
#include <fstream>
#include <new>
#include <stdexcept>
#include <system_error>

namespace nusselt::scene {

FileBytes::FileBytes(const std::filesystem::path& path, Budget& inflated_bytes) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw std::runtime_error("no such file");
    if (!std::filesystem::is_regular_file(status)) throw std::runtime_error("not a regular file");
    const auto size = std::filesystem::file_size(path, error);
    std::ifstream stream(path, std::ios::binary);
    if (error || !stream) throw std::runtime_error("cannot be opened");
    if (size > kMaxFileBytes)
        throw std::runtime_error("larger than " + std::to_string(kMaxFileBytes) + " bytes");
    resize(size);
    stream.read(data_.get(), static_cast<std::streamsize>(size));
    if (!stream) throw std::runtime_error("cannot be read");
    if (is_gzip(view())) *this = inflated(view(), inflated_bytes);
}

void FileBytes::resize(std::size_t size) {
    void* const memory = std::realloc(data_.get(), std::max<std::size_t>(size, 1));
    if (memory == nullptr) throw std::bad_alloc();
    static_cast<void>(data_.release());
    data_.reset(static_cast<char*>(memory));
    size_ = size;
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
