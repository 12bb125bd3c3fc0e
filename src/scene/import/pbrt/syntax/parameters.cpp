#include "scene/import/pbrt/syntax/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>

namespace nusselt::scene {

namespace {

ParameterKind kind_of(std::string_view type) {
    static constexpr std::pair<std::string_view, ParameterKind> kKinds[] = {
        {"integer", ParameterKind::integer},  {"float", ParameterKind::real},
        {"point2", ParameterKind::point2},    {"vector2", ParameterKind::point2},
        {"point", ParameterKind::point3},     {"point3", ParameterKind::point3},
        {"vector", ParameterKind::point3},    {"vector3", ParameterKind::point3},
        {"normal", ParameterKind::point3},    {"normal3", ParameterKind::point3},
        {"rgb", ParameterKind::colour},       {"color", ParameterKind::colour},
        {"xyz", ParameterKind::colour},       {"spectrum", ParameterKind::colour},
        {"blackbody", ParameterKind::colour}, {"bool", ParameterKind::boolean},
        {"string", ParameterKind::string},    {"texture", ParameterKind::texture}};
    for (const auto& [name, kind] : kKinds)
        if (name == type) return kind;
    return ParameterKind::unsupported;
}

std::size_t components(ParameterKind kind) {
    return kind == ParameterKind::point3 ? 3 : kind == ParameterKind::point2 ? 2 : 1;
}

bool takes_numbers(const Parameter& parameter) {
    switch (parameter.kind) {
    case ParameterKind::boolean:
    case ParameterKind::string:
    case ParameterKind::texture:
        return false;
    default:
        return true;
    }
}

Float3 float3_at(const std::vector<double>& numbers, std::size_t i) {
    return {static_cast<float>(numbers[i]), static_cast<float>(numbers[i + 1]),
            static_cast<float>(numbers[i + 2])};
}

/// "type name", with any white space between.
void split_declaration(const Token& token, Parameter& parameter) {
    constexpr std::string_view kSpace = " \t";
    const std::string_view text = token.text;
    const std::size_t type_begin = text.find_first_not_of(kSpace);
    const std::size_t type_end = text.find_first_of(kSpace, type_begin);
    const std::size_t name_begin = text.find_first_not_of(kSpace, type_end);
    if (type_begin == std::string_view::npos || name_begin == std::string_view::npos)
        throw SceneError(parameter.location,
                         "expected a parameter \"type name\", found " + Tokenizer::describe(token));
    parameter.type = text.substr(type_begin, type_end - type_begin);
    parameter.name = text.substr(name_begin, text.find_last_not_of(kSpace) + 1 - name_begin);
}

void add_value(const Token& token, const Location& location, Parameter& parameter) {
    const bool is_string = token.kind == TokenKind::string;
    const bool is_word = token.kind == TokenKind::word;
    const auto fail = [&](std::string_view expected) {
        throw SceneError(location, "parameter " + declaration(parameter) + ": expected " +
                                       std::string(expected) + ", found " + Tokenizer::describe(token));
    };
    switch (parameter.kind) {
    case ParameterKind::string:
    case ParameterKind::texture:
        if (!is_string) fail("a quoted string");
        parameter.strings.push_back(unescape(token.text));
        return;
    case ParameterKind::boolean:
        if ((!is_string && !is_word) || (token.text != "true" && token.text != "false"))
            fail("true or false");
        parameter.strings.emplace_back(token.text);
        return;
    case ParameterKind::unsupported:
        if (!is_string && !is_word) fail("a value");
        return;
    case ParameterKind::colour:
        if (is_string) {
            parameter.strings.push_back(unescape(token.text));
            return;
        }
        [[fallthrough]];
    default:
        if (!is_word) fail("a number");
        parameter.numbers.push_back(parse_number(token.text, location));
    }
}

void read_values(Tokenizer& tokens, Parameter& parameter) {
    if (tokens.peek().kind != TokenKind::open_bracket) {
        const Token token = tokens.next();
        add_value(token, tokens.location(token), parameter);
        return;
    }
    tokens.next();
    while (tokens.peek().kind != TokenKind::close_bracket) {
        if (tokens.peek().kind == TokenKind::end)
            throw SceneError(parameter.location, "parameter " + declaration(parameter) + ": ']' is missing");
        const Token token = tokens.next();
        add_value(token, tokens.location(token), parameter);
    }
    tokens.next();
}

} // namespace

std::string declaration(const Parameter& parameter) {
    return '"' + shortened(parameter.type) + ' ' + shortened(parameter.name) + '"';
}

std::optional<double> number_of(std::string_view text) {
    const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size() || error == std::errc::invalid_argument) return std::nullopt;
    // from_chars reports underflow like overflow and leaves the value unset; strtod distinguishes them.
    if (error == std::errc::result_out_of_range) value = std::strtod(std::string(digits).c_str(), nullptr);
    return value;
}

double parse_number(std::string_view text, const Location& location) {
    const std::optional<double> value = number_of(text);
    if (!value) throw SceneError(location, "expected a number, found '" + shortened(text) + "'");
    if (!(std::fabs(*value) <= std::numeric_limits<float>::max()))
        throw SceneError(location, "number out of range: '" + shortened(text) + "'");
    return *value;
}

ParameterList::ParameterList(Tokenizer& tokens, const Location& directive, ParameterContext context)
    : location_(directive), context_(std::move(context)) {
    while (tokens.peek().kind == TokenKind::string) {
        const Token token = tokens.next();
        Parameter& parameter = parameters_.emplace_back();
        parameter.location = tokens.location(token);
        split_declaration(token, parameter);
        parameter.kind = kind_of(parameter.type);
        read_values(tokens, parameter);
        if (takes_numbers(parameter) && parameter.numbers.size() % components(parameter.kind) != 0)
            throw SceneError(parameter.location, "parameter " + declaration(parameter) + ": " +
                                                     std::to_string(parameter.numbers.size()) +
                                                     " values cannot be grouped into " +
                                                     std::to_string(components(parameter.kind)) +
                                                     " components each");
    }
}

Location ParameterList::location_of(std::string_view name) const {
    for (const Parameter& parameter : parameters_)
        if (parameter.name == name) return parameter.location;
    return location_;
}

const Parameter* ParameterList::find(std::string_view name, ParameterKind kind) {
    const auto is_wanted = [&](const Parameter& parameter) {
        return parameter.name == name && parameter.kind == kind;
    };
    const auto found = std::find_if(parameters_.begin(), parameters_.end(), is_wanted);
    if (found != parameters_.end()) {
        found->used = true;
        return &*found;
    }
    if (context_.defaults == nullptr) return nullptr;
    const auto fallback = std::find_if(context_.defaults->rbegin(), context_.defaults->rend(), is_wanted);
    return fallback != context_.defaults->rend() ? &*fallback : nullptr;
}

const Parameter* ParameterList::find_single(std::string_view name, ParameterKind kind) {
    const Parameter* parameter = find(name, kind);
    if (parameter == nullptr) return nullptr;
    const std::size_t count =
        (takes_numbers(*parameter) ? parameter->numbers.size() : parameter->strings.size());
    if (count != components(kind))
        throw SceneError(parameter->location, "parameter " + declaration(*parameter) + ": expected " +
                                                  std::to_string(components(kind)) + " value(s), found " +
                                                  std::to_string(count));
    return parameter;
}

std::optional<double> ParameterList::optional_real(std::string_view name) {
    const Parameter* parameter = find_single(name, ParameterKind::real);
    return parameter != nullptr ? std::optional(parameter->numbers[0]) : std::nullopt;
}

int ParameterList::integer(std::string_view name, int fallback) {
    const Parameter* parameter = find_single(name, ParameterKind::integer);
    if (parameter == nullptr) return fallback;
    const double value = parameter->numbers[0];
    if (value != std::trunc(value) || std::fabs(value) > std::numeric_limits<int>::max())
        throw SceneError(parameter->location, "parameter " + declaration(*parameter) +
                                                  ": expected an integer, found " + to_text(value));
    return static_cast<int>(value);
}

bool ParameterList::boolean(std::string_view name, bool fallback) {
    const Parameter* parameter = find_single(name, ParameterKind::boolean);
    return parameter != nullptr ? parameter->strings[0] == "true" : fallback;
}

std::string ParameterList::string(std::string_view name, std::string_view fallback) {
    const Parameter* parameter = find_single(name, ParameterKind::string);
    return parameter != nullptr ? parameter->strings[0] : std::string(fallback);
}

std::vector<std::string> ParameterList::strings(std::string_view name) {
    const Parameter* parameter = find(name, ParameterKind::string);
    return parameter != nullptr ? parameter->strings : std::vector<std::string>{};
}

std::optional<std::string> ParameterList::texture(std::string_view name) {
    const Parameter* parameter = find_single(name, ParameterKind::texture);
    return parameter != nullptr ? std::optional(parameter->strings[0]) : std::nullopt;
}

std::optional<Float3> ParameterList::point(std::string_view name) {
    const Parameter* parameter = find(name, ParameterKind::point3);
    if (parameter == nullptr) return std::nullopt;
    if (parameter->numbers.size() != 3)
        throw SceneError(parameter->location, "parameter " + declaration(*parameter) +
                                                  ": expected 3 numbers, found " +
                                                  std::to_string(parameter->numbers.size()));
    return float3_at(parameter->numbers, 0);
}

std::vector<Float3> ParameterList::points(std::string_view name) {
    std::vector<Float3> result;
    if (const Parameter* parameter = find(name, ParameterKind::point3)) {
        result.reserve(parameter->numbers.size() / 3);
        for (std::size_t i = 0; i + 2 < parameter->numbers.size(); i += 3)
            result.push_back(float3_at(parameter->numbers, i));
    }
    return result;
}

std::vector<Float2> ParameterList::pairs(std::string_view name) {
    const Parameter* parameter = find(name, ParameterKind::point2);
    if (parameter == nullptr) parameter = find(name, ParameterKind::real);
    std::vector<Float2> result;
    if (parameter == nullptr) return result;
    const std::vector<double>& numbers = parameter->numbers;
    if (numbers.size() % 2 != 0)
        throw SceneError(parameter->location, "parameter " + declaration(*parameter) +
                                                  ": expected pairs, found " +
                                                  std::to_string(numbers.size()) + " numbers");
    result.reserve(numbers.size() / 2);
    for (std::size_t i = 0; i < numbers.size(); i += 2)
        result.push_back({static_cast<float>(numbers[i]), static_cast<float>(numbers[i + 1])});
    return result;
}

std::vector<double> ParameterList::reals(std::string_view name) {
    const Parameter* parameter = find(name, ParameterKind::real);
    return parameter != nullptr ? parameter->numbers : std::vector<double>{};
}

std::vector<double> ParameterList::integers(std::string_view name) {
    const Parameter* parameter = find(name, ParameterKind::integer);
    return parameter != nullptr ? parameter->numbers : std::vector<double>{};
}

std::vector<std::uint32_t> ParameterList::indices(std::string_view name, std::size_t limit) {
    const Parameter* parameter = find(name, ParameterKind::integer);
    std::vector<std::uint32_t> result;
    if (parameter == nullptr) return result;
    result.reserve(parameter->numbers.size());
    for (const double value : parameter->numbers) {
        if (!(value >= 0 && value < static_cast<double>(limit)) || value != std::trunc(value)) {
            throw SceneError(parameter->location, "parameter " + declaration(*parameter) + ": index " +
                                                      to_text(value) + " at position " +
                                                      std::to_string(result.size()) +
                                                      " must be an integer from 0 to " +
                                                      std::to_string(limit) + " - 1, the number of vertices");
        }
        result.push_back(static_cast<std::uint32_t>(value));
    }
    return result;
}

std::size_t ParameterList::value_count() const {
    return std::accumulate(parameters_.begin(), parameters_.end(), std::size_t{0},
                           [](std::size_t sum, const Parameter& parameter) {
                               return sum + parameter.numbers.size() + parameter.strings.size();
                           });
}

void ParameterList::ignore(std::initializer_list<std::string_view> names) {
    for (Parameter& parameter : parameters_)
        if (std::find(names.begin(), names.end(), parameter.name) != names.end()) parameter.used = true;
}

std::vector<Parameter> ParameterList::appended_to(const std::vector<Parameter>& outer) const {
    std::vector<Parameter> result = outer;
    result.insert(result.end(), parameters_.begin(), parameters_.end());
    return result;
}

void ParameterList::warn_unused(std::string_view owner, Warnings& warnings) const {
    for (const Parameter& parameter : parameters_) {
        if (parameter.used) continue;
        const auto is_repeated = std::any_of(parameters_.data(), &parameter, [&](const Parameter& earlier) {
            return earlier.name == parameter.name;
        });
        warnings.add(parameter.location,
                     std::string(owner) + ": parameter " + declaration(parameter) +
                         (is_repeated ? " is given twice; the first one counts" : " is unknown and ignored"));
    }
}

} // namespace nusselt::scene
