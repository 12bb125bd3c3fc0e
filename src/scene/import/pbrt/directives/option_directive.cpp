#include "scene/import/pbrt/directives/option_directive.h"

#include "scene/import/pbrt/syntax/name_table.h"
#include "scene/import/pbrt/syntax/parameters.h"

#include <cctype>
#include <string_view>
#include <utility>
#include <vector>

namespace nusselt::scene {

namespace {

/// What a value must be.
struct OptionType {
    const char* expected;
    bool (*fits)(const Token& value);
};

bool is_boolean(const Token& value) {
    return value.kind == TokenKind::word && (value.text == "true" || value.text == "false");
}

bool is_number(const Token& value) { return value.kind == TokenKind::word && number_of(value.text); }

bool is_string(const Token& value) { return value.kind == TokenKind::string; }

constexpr OptionType kBoolean = {"true or false", is_boolean};
constexpr OptionType kNumber = {"a number", is_number};
constexpr OptionType kString = {"a string", is_string};

/// The options of pbrt.
constexpr std::pair<std::string_view, const OptionType*> kOptions[] = {{"disablepixeljitter", &kBoolean},
                                                                       {"disabletexturefiltering", &kBoolean},
                                                                       {"disablewavelengthjitter", &kBoolean},
                                                                       {"displacementedgescale", &kNumber},
                                                                       {"forcediffuse", &kBoolean},
                                                                       {"msereferenceimage", &kString},
                                                                       {"msereferenceout", &kString},
                                                                       {"pixelstats", &kBoolean},
                                                                       {"rendercoordsys", &kString},
                                                                       {"seed", &kNumber},
                                                                       {"wavefront", &kBoolean}};

/// Options that change images, and what to do about it.
constexpr std::pair<std::string_view, const char*> kRemedies[] = {
    {"disablepixeljitter", "`--pixel-center` sends camera rays through pixel centres"},
    {"disabletexturefiltering", "`\"string filter\" \"point\"` does the same for a texture"},
    {"forcediffuse", "`--brdf lambert` renders all materials as diffuse"},
    {"seed", "`--seed` chooses the random numbers"}};

/// As pbrt compares names: without the type, in lower case, without underscores and hyphens.
std::string plain_name(const std::string& name) {
    std::string result;
    for (const char c : name.substr(name.find_last_of(" \t") + 1))
        if (c != '_' && c != '-') result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

/// The values, which may stand in brackets.
std::vector<Token> read_values(const Location& location, Tokenizer& tokens) {
    const Token first = tokens.next();
    if (first.kind == TokenKind::end || first.kind == TokenKind::close_bracket)
        throw SceneError(location, "Option: expected a value, found " + Tokenizer::describe(first));
    if (first.kind != TokenKind::open_bracket) return {first};
    std::vector<Token> values;
    while (tokens.peek().kind != TokenKind::end) {
        const Token value = tokens.next();
        if (value.kind == TokenKind::close_bracket) return values;
        values.push_back(value);
    }
    throw SceneError(location, "Option: the bracket is not closed");
}

} // namespace

void read_option(const std::string& name, const Location& location, Tokenizer& tokens, Warnings& warnings) {
    const std::vector<Token> values = read_values(location, tokens);
    const std::string plain = plain_name(name);
    const std::string option = "Option \"" + shortened(name) + "\"";
    const OptionType* const type = find_named(kOptions, plain);
    if (type == nullptr) {
        warnings.add(location, option + " is unknown and ignored");
        return;
    }
    // A value that does not fit may be the next directive.
    if (values.size() != 1 || !type->fits(values.front()))
        throw SceneError(location, option + ": expected " + type->expected + ", found " +
                                       (values.size() == 1 ? Tokenizer::describe(values.front())
                                                           : std::to_string(values.size()) + " values"));
    const char* const remedy = find_named(kRemedies, plain);
    if (remedy != nullptr && values.front().text != "false")
        warnings.add(location, option + " is ignored; " + remedy);
}

} // namespace nusselt::scene
