#include "scene/input/json_node.h"

#include "base/words.h"
#include "scene/input/file_bytes.h"
#include "scene/input/message.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace nusselt::scene {

namespace {

using nlohmann::json;

constexpr int kMaxDepth = 32;

/// "line:column", both counted from 1.
std::string position_text(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_begin = before.rfind('\n') + 1; // npos + 1 is 0
    return std::to_string(line) + ":" + std::to_string(before.size() - line_begin + 1);
}

/// The reason in the words of the parser, without its name and its description of the position.
std::string syntax_reason(std::string_view what) {
    const std::size_t colon = what.find(": ");
    const std::string_view reason = colon == what.npos ? what : what.substr(colon + 2);
    // The last words that it read may be any bytes.
    return "invalid JSON: " + std::string(reason.substr(0, reason.find("; last read")));
}

/// The position of a number that the parser could not represent. Its message quotes the number, but lacks the position.
std::size_t offset_of_number(std::string_view text, std::string_view what) {
    const std::size_t begin = std::min(what.find('\''), what.size() - 1) + 1;
    const std::size_t offset = text.find(what.substr(begin, what.rfind('\'') - begin));
    return std::min(offset, text.size());
}

/// Makes the checks that the parser itself does not make, as its callback.
class StructureCheck {
public:
    explicit StructureCheck(std::string file) : file_(std::move(file)) {}

    bool operator()(int depth, json::parse_event_t event, const json& parsed) {
        using Event = json::parse_event_t;
        if ((event == Event::object_start || event == Event::array_start) && depth >= kMaxDepth)
            fail("objects and arrays are nested more than " + std::to_string(kMaxDepth) + " deep");
        if (event == Event::object_start) fields_.emplace_back();
        if (event == Event::object_end) fields_.pop_back();
        if (event == Event::key && !fields_.back().insert(parsed.get<std::string>()).second)
            fail("the field " + shortened(parsed.dump()) +
                 " appears twice in one object; remove one of them");
        return true;
    }

private:
    [[noreturn]] void fail(const std::string& message) const {
        throw std::runtime_error(message_line(file_ + ": " + message));
    }

    std::string file_;
    std::vector<std::set<std::string>> fields_; ///< seen so far in the objects around
};

/// A value as JSON, shortened, in one line.
std::string excerpt(const json& value) {
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    if (value.is_object()) return "an object";
    constexpr std::size_t kMaxLength = 40;
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() > kMaxLength) text = text.substr(0, kMaxLength) + "...";
    return text;
}

/// \param name of a field that is not known
std::string advice_on_field(const std::string& name, std::span<const std::string_view> known,
                            std::span<const FieldSynonym> synonyms) {
    const std::vector<std::string> fields(known.begin(), known.end());
    std::optional<std::string> meant = base::likely_meant(name, fields);
    for (const FieldSynonym& synonym : synonyms)
        if (synonym.word == name) meant = synonym.field;
    if (meant) return "did you mean \"" + *meant + "\"?";
    return "supported are " + base::listing(fields, "and");
}

std::string range_text(std::string_view kind, double low, double high) {
    const std::string start(kind);
    return start + " from " + to_text(low) + " to " + to_text(high);
}

} // namespace

json read_json(const std::filesystem::path& path) {
    const auto fail = [&](const std::string& message) {
        throw std::runtime_error(message_line(path.string() + ": " + message));
    };
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (!error && size > kMaxJsonBytes)
        fail("has " + std::to_string(size) + " bytes; at most " + std::to_string(kMaxJsonBytes) +
             " are supported");
    FileBytes bytes;
    try {
        Budget inflated_bytes(kMaxJsonBytes,
                              "decompresses to more than " + std::to_string(kMaxJsonBytes) + " bytes");
        bytes = FileBytes(path, inflated_bytes);
    } catch (const std::runtime_error& reason) {
        fail(reason.what());
    }
    return parse_json(bytes.view(), path);
}

json parse_json(std::string_view text, const std::filesystem::path& name) {
    const auto syntax_error = [&](std::size_t offset, const std::string& reason) {
        return std::runtime_error(
            message_line(name.string() + ":" + position_text(text, offset) + ": " + reason));
    };
    // The parser takes it for the end of the text.
    if (const std::size_t nul = text.find('\0'); nul != text.npos)
        throw syntax_error(nul, "invalid JSON: a NUL byte; save the file as UTF-8 text");
    try {
        return json::parse(text.begin(), text.end(), StructureCheck(name.string()));
    } catch (const json::parse_error& reason) {
        // The parser counts the bytes that it has read, with the one over which it stumbled.
        throw syntax_error(std::max<std::size_t>(reason.byte, 1) - 1, syntax_reason(reason.what()));
    } catch (const json::out_of_range& reason) {
        throw syntax_error(offset_of_number(text, reason.what()), "this number is too large");
    }
}

void JsonNode::fail(std::string_view message) const {
    throw std::runtime_error(message_line(where() + ": " + std::string(message)));
}

void JsonNode::fail_type(std::string_view expected) const {
    fail("must be " + std::string(expected) + ", found " + excerpt(*value_));
}

void JsonNode::check_fields(std::span<const std::string_view> known,
                            std::span<const FieldSynonym> synonyms) const {
    if (!value_->is_object()) fail_type("an object, in braces");
    for (const auto& [name, value] : value_->items())
        if (std::find(known.begin(), known.end(), name) == known.end())
            fail("unknown field " + excerpt(name) + "; " + advice_on_field(name, known, synonyms));
}

std::optional<JsonNode> JsonNode::find(std::string_view field) const {
    const auto entry = value_->find(field);
    if (entry == value_->end()) return std::nullopt;
    return JsonNode(*entry, file_, (path_.empty() ? "" : path_ + ".") + std::string(field));
}

JsonNode JsonNode::at(std::string_view field) const {
    if (std::optional<JsonNode> node = find(field)) return *std::move(node);
    fail("must have the field \"" + std::string(field) + '"');
}

std::vector<JsonNode> JsonNode::elements() const {
    if (!value_->is_array()) fail_type("an array, in brackets");
    std::vector<JsonNode> result;
    result.reserve(value_->size());
    for (const json& element : *value_)
        result.push_back(JsonNode(element, file_, path_ + "[" + std::to_string(result.size()) + "]"));
    return result;
}

bool JsonNode::boolean() const {
    if (!value_->is_boolean()) fail_type("true or false");
    return value_->get<bool>();
}

std::string JsonNode::text() const {
    if (!value_->is_string() || value_->get_ref<const std::string&>().empty())
        fail_type("a non-empty text in quotes");
    return value_->get<std::string>();
}

double JsonNode::number(double low, double high) const {
    const double number = value_->is_number() ? value_->get<double>() : -1;
    if (!value_->is_number() || number < low || number > high) fail_type(range_text("a number", low, high));
    return number;
}

double JsonNode::positive_number(double high) const {
    const double number = value_->is_number() ? value_->get<double>() : 0;
    if (!(number > 0 && number <= high)) fail_type("a number above 0 and at most " + to_text(high));
    return number;
}

std::size_t JsonNode::integer(std::size_t low, std::size_t high) const {
    const bool is_valid = value_->is_number_unsigned() && value_->get<std::size_t>() >= low &&
                          value_->get<std::size_t>() <= high;
    if (!is_valid)
        fail_type(low == high ? "the number " + std::to_string(low)
                              : "an integer from " + std::to_string(low) + " to " + std::to_string(high));
    return value_->get<std::size_t>();
}

std::array<float, 3> JsonNode::triple(double low, double high) const {
    if (!value_->is_array() || value_->size() != 3) fail_type("an array of 3 numbers");
    std::array<float, 3> entries{};
    std::size_t i = 0;
    for (const JsonNode& element : elements()) entries[i++] = static_cast<float>(element.number(low, high));
    return entries;
}

std::array<float, 3> JsonNode::triple_or_number(double low, double high) const {
    if (!value_->is_number()) {
        if (!value_->is_array() || value_->size() != 3) fail_type("a number or an array of 3 numbers");
        return triple(low, high);
    }
    const auto grey = static_cast<float>(number(low, high));
    return {grey, grey, grey};
}

} // namespace nusselt::scene
