#include "image/formats/bytes.h"

#include "image/codecs.h"

#include <algorithm>
#include <stdexcept>

namespace nusselt::image {

std::string bytes_at(std::istream& file, std::int64_t begin, std::size_t count) {
    std::string bytes(count, '\0');
    file.clear();
    file.seekg(begin);
    file.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

void fail_as_cut_off() {
    throw std::runtime_error("the file is too small for its pixels; it may be truncated");
}

std::int64_t byte_count(std::istream& file) {
    file.clear();
    file.seekg(0);
    return remaining_bytes(file);
}

ByteSource::ByteSource(std::istream& file, std::int64_t begin) : file_(file) {
    file_.clear();
    file_.seekg(begin);
}

std::string_view ByteSource::take(std::size_t count) {
    constexpr std::size_t kStep = std::size_t(1) << 16;
    if (buffer_.size() - used_ < count) {
        buffer_.erase(0, used_);
        used_ = 0;
        const std::size_t left = buffer_.size();
        buffer_.resize(std::max(count, kStep));
        file_.read(buffer_.data() + left, static_cast<std::streamsize>(buffer_.size() - left));
        buffer_.resize(left + static_cast<std::size_t>(file_.gcount()));
        if (buffer_.size() < count) fail_as_cut_off();
    }
    used_ += count;
    return std::string_view(buffer_).substr(used_ - count, count);
}

} // namespace nusselt::image
