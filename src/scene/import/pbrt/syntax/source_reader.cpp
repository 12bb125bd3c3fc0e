#include "scene/import/pbrt/syntax/source_reader.h"

#include "scene/import/pbrt/syntax/parameters.h"

namespace nusselt::scene {

namespace {

constexpr std::size_t kMaxIncludeDepth = 32;

// Files that are included again. Those that include others twice multiply quickly.
constexpr int kMaxRepeatedIncludes = 1000;
constexpr std::size_t kMaxRepeatedBytes = std::size_t{1} << 25;

/// \throws std::runtime_error saying why there is no text
FileBytes read_text(const std::filesystem::path& path, SceneBudget& budget) {
    FileBytes bytes(path, budget.inflated_bytes);
    if (bytes.view().starts_with("\xff\xfe") || bytes.view().starts_with("\xfe\xff"))
        throw std::runtime_error("its text is in UTF-16; convert it with `iconv -f UTF-16 -t UTF-8`");
    return bytes;
}

} // namespace

SourceReader::SourceReader(const std::filesystem::path& main_path, std::deque<SourceFile>& sources,
                           SceneBudget& budget, NamedFiles& named_files)
    : sources_(sources), budget_(budget), named_files_(named_files) {
    SourceFile& main = sources_.emplace_back(SourceFile{main_path, {}});
    try {
        main.bytes = read_text(main_path, budget_);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("scene file '" + main_path.string() + "': " + error.what());
    }
    open_files_.emplace_back(main);
}

std::filesystem::path SourceReader::resolve(const std::string& name, const Location& location) const {
    // pbrt looks beside the main file; beside the including file is what people expect.
    return find_file(name, location.file->path.parent_path(), main_file().path.parent_path());
}

bool SourceReader::open(const std::string& name, const Location& includer) {
    const std::filesystem::path path = resolve(name, includer);
    if (open_files_.size() >= kMaxIncludeDepth)
        throw SceneError(includer, "more than " + std::to_string(kMaxIncludeDepth) +
                                       " nested includes; does '" + path.string() + "' include itself?");
    if (!named_files_.note(includer, "scene file", path)) return false;
    const SourceFile*& source = by_path_[path.lexically_normal().string()];
    if (source == nullptr) {
        try {
            source = &sources_.emplace_back(SourceFile{path, read_text(path, budget_)});
        } catch (const std::runtime_error& error) {
            throw SceneError(includer, "scene file '" + path.string() + "': " + error.what());
        }
    } else {
        repeated_bytes_ += source->bytes.view().size();
        if (++repeated_includes_ > kMaxRepeatedIncludes || repeated_bytes_ > kMaxRepeatedBytes)
            throw SceneError(includer, "repeated includes exceed " + std::to_string(kMaxRepeatedIncludes) +
                                           " files or " + std::to_string(kMaxRepeatedBytes) +
                                           " bytes of text; use ObjectInstance for copies");
    }
    open_files_.emplace_back(*source);
    return true;
}

void SourceReader::release_text() {
    // Included files may be included again, and are then read from memory.
    const Token& next = tokens().peek();
    if (open_files_.size() == 1 && next.kind != TokenKind::end)
        sources_.front().bytes.release_before(next.text.data());
}

std::string SourceReader::read_string() {
    const Token token = tokens().next();
    if (token.kind != TokenKind::string)
        throw SceneError(tokens().location(token),
                         "expected a quoted string, found " + Tokenizer::describe(token));
    return unescape(token.text);
}

std::string SourceReader::read_type() {
    const Token token = tokens().peek();
    std::string type = read_string();
    if (type.find(' ') != std::string::npos)
        throw SceneError(tokens().location(token),
                         "expected the type, found the parameter " + Tokenizer::describe(token));
    return type;
}

double SourceReader::read_number() {
    const Token token = tokens().next();
    if (token.kind != TokenKind::word)
        throw SceneError(tokens().location(token), "expected a number, found " + Tokenizer::describe(token));
    return parse_number(token.text, tokens().location(token));
}

Double3 SourceReader::read_vector() {
    const double x = read_number();
    const double y = read_number();
    const double z = read_number();
    return {x, y, z};
}

Transform SourceReader::read_matrix() {
    const auto read_bracket = [&](TokenKind kind, std::string_view text) {
        const Token token = tokens().next();
        if (token.kind != kind)
            throw SceneError(tokens().location(token), "expected '" + std::string(text) +
                                                           "' around 16 numbers, found " +
                                                           Tokenizer::describe(token));
    };
    const bool has_brackets = tokens().peek().kind == TokenKind::open_bracket;
    if (has_brackets) read_bracket(TokenKind::open_bracket, "[");
    std::array<double, 16> entries{};
    for (double& entry : entries) entry = read_number();
    if (has_brackets) read_bracket(TokenKind::close_bracket, "]");
    if (const double scale = entries.back(); scale != 0 && scale != 1)
        for (double& entry : entries) entry /= scale;
    return from_columns(entries);
}

} // namespace nusselt::scene
