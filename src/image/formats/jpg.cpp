#include "image/formats/jpg.h"

#include "image/formats/bytes.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio> // jpeglib.h needs it
#include <istream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <jpeglib.h>

#include <jerror.h> // the numbers of its messages depend on what jpeglib.h says

namespace nusselt::image {

namespace {

/// Progressive files refine the whole image in each scan; a small file could ask for very many.
constexpr int kLargestScanCount = 500;

/// The data that libjpeg passes to the functions below. They jump out of it, which runs no destructors.
struct ErrorManager {
    jpeg_error_mgr base; ///< first, as libjpeg knows this part only
    std::jmp_buf before_step;
    std::array<char, JMSG_LENGTH_MAX> message;
};

ErrorManager& manager_of(j_common_ptr info) { return *reinterpret_cast<ErrorManager*>(info->err); }

[[noreturn]] void jump_with_message(j_common_ptr info) {
    ErrorManager& manager = manager_of(info);
    manager.base.format_message(info, manager.message.data());
    std::longjmp(manager.before_step, 1);
}

/// libjpeg goes on after damage, with pixels of its own invention. Messages that do not tell of damage are ignored.
void fail_for_damage(j_common_ptr info, int level) {
    if (level >= 0) return;
    constexpr std::array kDamages = {JWRN_ARITH_BAD_CODE, JWRN_HIT_MARKER, JWRN_HUFF_BAD_CODE, JWRN_JPEG_EOF,
                                     JWRN_MUST_RESYNC};
    if (std::find(kDamages.begin(), kDamages.end(), info->err->msg_code) != kDamages.end())
        jump_with_message(info);
}

/// The source of bytes that libjpeg passes to the functions below.
struct StreamSource {
    jpeg_source_mgr base; ///< first, as libjpeg knows this part only
    std::istream* file;
    std::array<JOCTET, 1 << 16> buffer;
};

boolean fill_buffer(j_decompress_ptr info) {
    StreamSource& source = *reinterpret_cast<StreamSource*>(info->src);
    source.file->read(reinterpret_cast<char*>(source.buffer.data()),
                      static_cast<std::streamsize>(source.buffer.size()));
    source.base.next_input_byte = source.buffer.data();
    source.base.bytes_in_buffer = static_cast<std::size_t>(source.file->gcount());
    if (source.base.bytes_in_buffer == 0) {
        info->err->msg_code = JERR_INPUT_EOF;
        jump_with_message(reinterpret_cast<j_common_ptr>(info));
    }
    return TRUE;
}

void skip_bytes(j_decompress_ptr info, long count) {
    for (auto left = static_cast<std::size_t>(std::max(count, 0l)); left > 0;) {
        if (info->src->bytes_in_buffer == 0) fill_buffer(info);
        const std::size_t step = std::min(left, info->src->bytes_in_buffer);
        info->src->next_input_byte += step;
        info->src->bytes_in_buffer -= step;
        left -= step;
    }
}

void do_nothing(j_decompress_ptr) {}

void limit_scans(j_common_ptr info) {
    if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= kLargestScanCount) return;
    ErrorManager& manager = manager_of(info);
    std::snprintf(manager.message.data(), manager.message.size(), "more than %d scans", kLargestScanCount);
    std::longjmp(manager.before_step, 1);
}

std::uint8_t product(unsigned a, unsigned b) { return static_cast<std::uint8_t>((a * b + 127) / 255); }

/// Ink to light, in place: three codes for each four.
/// \param is_inverted  whether codes are 255 without ink, as Adobe's programs write them
void rgb_from_cmyk(std::vector<std::uint8_t>& row, bool is_inverted) {
    const unsigned flip = is_inverted ? 0 : 255;
    for (std::size_t i = 0; i < row.size() / 4; ++i) {
        const unsigned black = row[4 * i + 3] ^ flip;
        for (std::size_t c = 0; c < 3; ++c) row[3 * i + c] = product(row[4 * i + c] ^ flip, black);
    }
}

struct Decompressor : jpeg_decompress_struct {
    Decompressor() : jpeg_decompress_struct() {}
    ~Decompressor() { jpeg_destroy_decompress(this); }
    Decompressor(const Decompressor&) = delete;
    Decompressor& operator=(const Decompressor&) = delete;
};

class JpgReader {
public:
    /// Reads everything before the pixels.
    explicit JpgReader(std::istream& file);

    CodedHeader header() const { return header_; }
    void read_rows(CodeRows& rows);

private:
    /// Runs `step`, which calls libjpeg and has no objects with destructors.
    template <class Step>
    void call(const Step& step);

    ErrorManager errors_ = {};
    StreamSource source_ = {};
    jpeg_progress_mgr progress_ = {};
    Decompressor jpeg_;
    CodedHeader header_;
};

template <class Step>
void JpgReader::call(const Step& step) {
    if (setjmp(errors_.before_step) == 0) return step();
    if (errors_.base.msg_code == JERR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error("cannot decode its JPEG data (" + std::string(errors_.message.data()) +
                             "); the file may be damaged or truncated");
}

JpgReader::JpgReader(std::istream& file) {
    const std::int64_t file_size = byte_count(file);
    source_.file = &file;
    source_.base.init_source = do_nothing;
    source_.base.fill_input_buffer = fill_buffer;
    source_.base.skip_input_data = skip_bytes;
    source_.base.resync_to_restart = jpeg_resync_to_restart;
    source_.base.term_source = do_nothing;
    jpeg_.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = jump_with_message;
    errors_.base.emit_message = fail_for_damage;
    progress_.progress_monitor = limit_scans;
    call([&] {
        jpeg_create_decompress(&jpeg_);
        jpeg_.progress = &progress_;
        jpeg_.src = &source_.base;
        jpeg_read_header(&jpeg_, TRUE);
    });
    header_.width = static_cast<int>(jpeg_.image_width);
    header_.height = static_cast<int>(jpeg_.image_height);
    header_.channels = jpeg_.num_components == 1 ? 1 : 3;
    // A block of 8 x 8 pixels takes one bit at least, so a byte makes up to 512 pixels, twice that with subsampled
    // channels.
    check_claims(file_size, header_, 1024);
}

void JpgReader::read_rows(CodeRows& rows) {
    const bool is_cmyk = jpeg_.num_components == 4;
    call([&] {
        if (is_cmyk) jpeg_.out_color_space = JCS_CMYK; // libjpeg has no way from there to RGB
        jpeg_start_decompress(&jpeg_);
    });
    std::vector<std::uint8_t> row(static_cast<std::size_t>(header_.width) *
                                  static_cast<std::size_t>(jpeg_.output_components));
    JSAMPROW target = row.data();
    for (std::size_t y = 0; y < static_cast<std::size_t>(header_.height); ++y) {
        call([&] { jpeg_read_scanlines(&jpeg_, &target, 1); });
        if (is_cmyk) rgb_from_cmyk(row, jpeg_.saw_Adobe_marker != FALSE);
        rows.put(row.data(), static_cast<std::size_t>(header_.width), {.y = y});
    }
    call([&] { jpeg_finish_decompress(&jpeg_); });
}

} // namespace

CodedHeader read_jpg_header(std::istream& file) { return JpgReader(file).header(); }

void decode_jpg(std::istream& file, CodeRows& rows) { JpgReader(file).read_rows(rows); }

} // namespace nusselt::image
