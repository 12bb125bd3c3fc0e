#pragma once
/// The numbers of an IES file.

#include "scene/input/diagnostics.h"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::scene {

/// Whether a line ends with this character: lines end with LF, CR LF, or with CR alone as on old Macintoshes.
bool ends_line(std::string_view text, std::size_t at);

/// Reads numbers that are separated by blanks, commas and line ends. Messages name what was expected, and its line.
class IesNumbers {
public:
    /// \param source  must outlive this
    /// \param text    a part of the file
    /// \param line    of the file, where the text begins
    IesNumbers(const SourceFile& source, std::string_view text, int line)
        : source_(&source), rest_(text), line_(line), line_of_last_(line) {}

    /// Throws SceneError if the next word is missing or is not a finite number.
    double number(std::string_view what);
    /// The same for one of many numbers. \param what tells what it is; called for messages only
    template <std::invocable What>
    double number(const What& what) {
        const std::string_view text = word();
        const double value = parsed(text);
        if (std::isnan(value)) fail_to_parse(text, what());
        return value;
    }
    /// The same for a number above zero.
    double positive(std::string_view what);
    /// A whole number, which may be written "3.0". Throws SceneError also if it is not in [least, most].
    std::size_t whole(std::string_view what, std::size_t least, std::size_t most);
    /// Reads `count` numbers.
    /// \param what  one of them, for messages: "vertical angle 3 of 19"
    std::vector<double> list(std::string_view what, std::size_t count);
    /// The same for angles [degrees]. Throws SceneError if they do not increase or are not in [least, most].
    std::vector<double> increasing(std::string_view what, std::size_t count, double least, double most);

    /// Throws SceneError if the rest of the file has no room for `count` numbers. Memory may then be taken for them.
    void check_room(std::uint64_t count) const;
    /// Throws SceneError if there is more in the file than blanks.
    void expect_end();

    /// Throws SceneError at the last number that was read.
    [[noreturn]] void fail(const std::string& message) const;

private:
    std::string_view word();
    /// NaN if the word is not a finite number.
    static double parsed(std::string_view word);
    [[noreturn]] void fail_to_parse(std::string_view word, const std::string& what) const;

    const SourceFile* source_;
    std::string_view rest_;
    int line_;
    int line_of_last_;
};

} // namespace nusselt::scene
