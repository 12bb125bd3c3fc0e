#pragma once
/// Files of tables of linearly transformed cosines, in memory: what data/ltc-*.bin hold, and what a program may have
/// compiled in as an array.
///
/// A header of 40 bytes: "nusselt-ltc\0\1\0\0\0"; the numbers of samples of roughness, inclination and f0, and the bytes
/// that follow the header, of 32 bits; the 64-bit FNV-1a hash of these bytes. Then five numbers u of 16 bits per sample,
/// in the order of LtcTableView. All is little-endian.
///
///     angle of the peak, angle of the horizon    u / 65535 is the angle over pi / 2
///     width_x, width_y / width_x                 u / 65535 is (log2(x) + 24) / 27
///     albedo                                     u / 65535
///
/// where the rows of cosine_from_shading are (cos peak, 0, sin peak) / width_x, (0, 1, 0) / width_y and
/// (-sin tilt, 0, cos tilt). Half floats of the matrix would be coarser where lobes are narrow.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <nusselt/ltc/table.h>

NUSSELT_NAMESPACE_BEGIN

/// A file that was checked. If anything is wrong with it, `problem` says what in a few words, and else is null.
struct LtcTableFile {
    static constexpr std::size_t kHeaderBytes = 40;
    static constexpr int kNumbers = 5;                               ///< per sample
    static constexpr int kMostSamples = 256;                         ///< along an axis
    static constexpr double kWidthOctaves = 27;                      ///< that u covers,
    static constexpr double kNarrowest = -24;                        ///< from 2 to this power on
    static constexpr unsigned char kMagic[] = "nusselt-ltc\0\1\0\0"; ///< and the 0 that ends it: 16 bytes

    const char* problem;
    const unsigned char* numbers; ///< after the header
    int roughnesses, inclinations, f0s;

    /// The number of floats that decode() writes.
    std::size_t entries() const noexcept {
        return static_cast<std::size_t>(roughnesses) * static_cast<std::size_t>(inclinations) *
               static_cast<std::size_t>(f0s) * static_cast<std::size_t>(LtcTableView::kStride);
    }

    /// The floats that LtcTableView::entries points to. \param target for entries() floats.
    void decode(float* target) const noexcept {
        const std::size_t samples = entries() / static_cast<std::size_t>(LtcTableView::kStride);
        for (std::size_t i = 0; i < samples; ++i) {
            double u[kNumbers];
            for (std::size_t k = 0; k < kNumbers; ++k)
                u[k] = static_cast<double>(little_endian(numbers + 2 * (i * kNumbers + k), 2)) / 65535;
            // Doubles keep the cosine of a right angle positive.
            const double peak = u[0] * (kPi<double> / 2), tilt = u[1] * (kPi<double> / 2);
            const double width_x = std::exp2(u[2] * kWidthOctaves + kNarrowest);
            float* const entry = target + i * static_cast<std::size_t>(LtcTableView::kStride);
            entry[0] = static_cast<float>(std::cos(peak));
            entry[1] = static_cast<float>(std::sin(peak));
            entry[2] = static_cast<float>(std::exp2(u[3] * kWidthOctaves + kNarrowest));
            entry[3] = static_cast<float>(width_x * std::sin(tilt));
            entry[4] = static_cast<float>(width_x * std::cos(tilt));
            entry[5] = static_cast<float>(u[4]);
        }
    }

    /// The number of `count` bytes from here on.
    static std::uint64_t little_endian(const unsigned char* bytes, int count) noexcept {
        std::uint64_t number = 0;
        for (int i = 0; i < count; ++i) number |= std::uint64_t{bytes[i]} << 8 * i;
        return number;
    }

    /// 64-bit FNV-1a.
    static std::uint64_t hash(const unsigned char* bytes, std::size_t count) noexcept {
        std::uint64_t value = 0xcbf29ce484222325u;
        for (std::size_t i = 0; i < count; ++i) value = (value ^ bytes[i]) * 0x100000001b3u;
        return value;
    }
};

/// Checks magic, sizes and hash of the bytes of a file. They must live as long as the result.
inline LtcTableFile open_ltc_table(const void* data, std::size_t size) noexcept {
    const auto* const bytes = static_cast<const unsigned char*>(data);
    LtcTableFile file{nullptr, bytes + LtcTableFile::kHeaderBytes, 0, 0, 0};
    const auto with_problem = [&](const char* problem) {
        file.problem = problem;
        return file;
    };
    bool is_table = size >= LtcTableFile::kHeaderBytes;
    for (std::size_t i = 0; is_table && i < sizeof LtcTableFile::kMagic; ++i)
        is_table = bytes[i] == LtcTableFile::kMagic[i];
    if (!is_table) return with_problem("not an LTC table, or of another version");

    int* const samples[] = {&file.roughnesses, &file.inclinations, &file.f0s};
    for (int i = 0; i < 3; ++i) {
        const std::uint64_t n = LtcTableFile::little_endian(bytes + 16 + 4 * i, 4);
        if (n < 2 || n > LtcTableFile::kMostSamples)
            return with_problem("less than 2 or more than 256 samples along an axis");
        *samples[i] = static_cast<int>(n);
    }
    if (file.entries() >= static_cast<std::size_t>(LtcTableView::kMostFloats))
        return with_problem("too many samples in all");
    const std::size_t length = size - LtcTableFile::kHeaderBytes;
    const std::size_t expected = file.entries() / static_cast<std::size_t>(LtcTableView::kStride) *
                                 LtcTableFile::kNumbers * sizeof(std::uint16_t);
    if (LtcTableFile::little_endian(bytes + 28, 4) != expected || length != expected)
        return with_problem("truncated or damaged: the length does not fit the numbers of samples");
    if (LtcTableFile::little_endian(bytes + 32, 8) != LtcTableFile::hash(file.numbers, length))
        return with_problem("damaged: the checksum does not match");
    return file;
}

NUSSELT_NAMESPACE_END
