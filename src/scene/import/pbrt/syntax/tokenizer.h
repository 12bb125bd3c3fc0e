#pragma once
/// Splits pbrt text into words, quoted strings and brackets.

#include "scene/input/diagnostics.h"

#include <string>
#include <string_view>

namespace nusselt::scene {

enum class TokenKind { word, string, open_bracket, close_bracket, end };

struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view text; ///< of a string: what stands between the quotes, escapes unresolved
    int line = 0;
};

/// Reads one file; comments run from # to the end of the line.
class Tokenizer {
public:
    /// \param source  must outlive the tokenizer and its tokens
    explicit Tokenizer(const SourceFile& source);

    /// The next token without consuming it. Kind `end` at the end of the file.
    const Token& peek() const { return token_; }
    /// Consumes a token. Throws SceneError at a string that does not end in its line.
    Token next();

    Location location(const Token& token) const { return {source_, token.line}; }
    /// The text for a token in error messages.
    static std::string describe(const Token& token);

private:
    Token scan();
    void skip_space_and_comments();

    const SourceFile* source_;
    std::string_view rest_;
    int line_ = 1;
    Token token_;
};

/// Resolves the escapes \b \f \n \r \t \\ \' \" of a quoted string; other backslashes stay.
std::string unescape(std::string_view text);

} // namespace nusselt::scene
