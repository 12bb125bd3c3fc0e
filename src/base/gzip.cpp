#include "base/gzip.h"

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <zlib.h>

namespace nusselt::base {

void InflateStream::End::operator()(z_stream_s* stream) const {
    inflateEnd(stream);
    delete stream;
}

InflateStream::InflateStream() : stream_(new z_stream()) {
    constexpr int kLargestWindow = 15;
    constexpr int kGzipOnly = 16;
    if (inflateInit2(stream_.get(), kLargestWindow + kGzipOnly) != Z_OK) throw std::bad_alloc();
}

bool InflateStream::step(std::string_view& input, char*& output, std::size_t output_size) {
    constexpr std::size_t kMaxStep = std::numeric_limits<uInt>::max();
    // zlib does not write to its input.
    stream_->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(input.data()));
    stream_->avail_in = static_cast<uInt>(std::min(input.size(), kMaxStep));
    stream_->next_out = reinterpret_cast<Bytef*>(output);
    stream_->avail_out = static_cast<uInt>(std::min(output_size, kMaxStep));
    const uInt available = stream_->avail_in;
    const int result = inflate(stream_.get(), Z_NO_FLUSH);
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result == Z_BUF_ERROR && input.empty()) throw std::runtime_error("its gzip data ends early");
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
        throw std::runtime_error("its gzip data is broken" + (stream_->msg != nullptr
                                                                  ? ": " + std::string(stream_->msg)
                                                                  : std::string()));
    input.remove_prefix(available - stream_->avail_in);
    output = reinterpret_cast<char*>(stream_->next_out);
    return result == Z_STREAM_END;
}

void InflateStream::restart() { inflateReset(stream_.get()); }

} // namespace nusselt::base
