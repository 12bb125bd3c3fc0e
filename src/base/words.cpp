#include "base/words.h"

#include <algorithm>
#include <numeric>

namespace nusselt::base {

namespace {

/// The distance to a longer text is at least the difference of the lengths, so no more is compared.
constexpr std::size_t kMaxCompared = 64;

/// Number of insertions, removals and replacements of a character that turn one text into the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string shell_word(const std::string& word) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string listing(const std::vector<std::string>& words, const std::string& conjunction) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 < words.size() ? ", " : " " + conjunction + " ";
        text += words[i];
    }
    return text;
}

std::optional<std::string> likely_meant(std::string_view word, const std::vector<std::string>& known) {
    if (known.empty()) return std::nullopt;
    const std::string_view head = word.substr(0, kMaxCompared);
    const std::string& best =
        *std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
            return edit_distance(head, a) < edit_distance(head, b);
        });
    const std::size_t most_errors = std::max<std::size_t>(1, best.size() / 3);
    if (edit_distance(head, best) > most_errors) return std::nullopt;
    return best;
}

} // namespace nusselt::base
