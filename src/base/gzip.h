#pragma once
/// Decompression of gzip files in steps.

#include <cstddef>
#include <memory>
#include <string_view>

struct z_stream_s;

namespace nusselt::base {

/// zlib's stream of one gzip file.
class InflateStream {
public:
    /// Throws std::bad_alloc.
    InflateStream();

    /// Moves bytes from the front of `input` to the front of `output`, which both shrink. Throws std::runtime_error with
    /// the reason if the file is broken or ends early, and std::bad_alloc.
    /// \return whether a part of the file is complete
    bool step(std::string_view& input, char*& output, std::size_t output_size);

    /// Begins the next part of a file.
    void restart();

private:
    struct End {
        void operator()(z_stream_s* stream) const;
    };
    std::unique_ptr<z_stream_s, End> stream_;
};

} // namespace nusselt::base
