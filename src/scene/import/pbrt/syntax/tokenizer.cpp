#include "scene/import/pbrt/syntax/tokenizer.h"

namespace nusselt::scene {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }
bool ends_word(char c) { return is_space(c) || c == '"' || c == '[' || c == ']' || c == '#'; }

} // namespace

Tokenizer::Tokenizer(const SourceFile& source) : source_(&source), rest_(source.bytes.view()) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
    token_ = scan();
}

Token Tokenizer::next() {
    const Token result = token_;
    token_ = scan();
    return result;
}

void Tokenizer::skip_space_and_comments() {
    std::size_t i = 0;
    while (i < rest_.size()) {
        if (rest_[i] == '#') {
            while (i < rest_.size() && rest_[i] != '\n') ++i;
        } else if (is_space(rest_[i])) {
            if (rest_[i] == '\n') ++line_;
            ++i;
        } else {
            break;
        }
    }
    rest_.remove_prefix(i);
}

Token Tokenizer::scan() {
    skip_space_and_comments();
    if (rest_.empty()) return {TokenKind::end, {}, line_};
    const auto take = [&](TokenKind kind, std::size_t begin, std::size_t end, std::size_t consumed) {
        const Token token{kind, rest_.substr(begin, end - begin), line_};
        rest_.remove_prefix(consumed);
        return token;
    };
    switch (rest_.front()) {
    case '[':
        return take(TokenKind::open_bracket, 0, 1, 1);
    case ']':
        return take(TokenKind::close_bracket, 0, 1, 1);
    case '"':
        for (std::size_t i = 1; i < rest_.size() && rest_[i] != '\n'; ++i) {
            if (rest_[i] == '"') return take(TokenKind::string, 1, i, i + 1);
            if (rest_[i] == '\\') ++i;
        }
        throw SceneError({source_, line_},
                         "string without closing quote: " + shortened(rest_.substr(0, rest_.find('\n'))));
    default:
        break;
    }
    std::size_t end = 1;
    while (end < rest_.size() && !ends_word(rest_[end])) ++end;
    return take(TokenKind::word, 0, end, end);
}

std::string Tokenizer::describe(const Token& token) {
    switch (token.kind) {
    case TokenKind::string:
        return '"' + shortened(token.text) + '"';
    case TokenKind::end:
        return "the end of the file";
    default:
        return "'" + shortened(token.text) + "'";
    }
}

std::string unescape(std::string_view text) {
    constexpr std::string_view kCodes = "bfnrt\\'\"";
    constexpr std::string_view kCharacters = "\b\f\n\r\t\\'\"";
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::size_t code =
            text[i] == '\\' && i + 1 < text.size() ? kCodes.find(text[i + 1]) : std::string_view::npos;
        if (code == std::string_view::npos) {
            result += text[i];
        } else {
            result += kCharacters[code];
            ++i;
        }
    }
    return result;
}

} // namespace nusselt::scene
