#pragma once
/// Reading of JSON files that people write by hand: each value is checked, and each error names the file, the path of
/// the value in it, what was found and what is expected.

#include <array>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::scene {

/// Parses a file. Throws std::runtime_error if it cannot be read, has more than 256 MiB before or after decompression,
/// is no JSON as a whole (with line and column), repeats a field of an object or nests more than 32 deep.
nlohmann::json read_json(const std::filesystem::path& path);

/// Parses a text likewise. \param name of the text, with which messages begin
nlohmann::json parse_json(std::string_view text, const std::filesystem::path& name);

/// What people may call a field that has another name.
struct FieldSynonym {
    std::string_view word;
    std::string_view field;
};

/// A value in a file, with a description of its position. It refers to the document, which must outlive it.
class JsonNode {
public:
    JsonNode(const nlohmann::json& document, const std::filesystem::path& file)
        : value_(&document), file_(file.string()) {}

    /// "file: lights[2].radiance"
    std::string where() const { return path_.empty() ? file_ : file_ + ": " + path_; }
    /// Throws std::runtime_error with "where(): message".
    [[noreturn]] void fail(std::string_view message) const;
    /// "must be `expected`, found ..."
    [[noreturn]] void fail_type(std::string_view expected) const;

    bool is_number() const { return value_->is_number(); }
    bool is_text() const { return value_->is_string(); }

    /// Throws unless this is an object all of whose fields are among these. \param synonyms for suggestions
    void check_fields(std::span<const std::string_view> known,
                      std::span<const FieldSynonym> synonyms = {}) const;
    void check_fields(std::initializer_list<std::string_view> known,
                      std::span<const FieldSynonym> synonyms = {}) const {
        check_fields(std::span(known.begin(), known.size()), synonyms);
    }
    /// The field of an object, nothing if it has none.
    std::optional<JsonNode> find(std::string_view field) const;
    /// The field of an object. Throws if it has none.
    JsonNode at(std::string_view field) const;
    /// The elements of an array. Throws if this node is not an array.
    std::vector<JsonNode> elements() const;

    bool boolean() const;
    /// Throws if it is no string or an empty one.
    std::string text() const;
    /// Throws unless it lies in [low, high].
    double number(double low, double high) const;
    /// Throws unless it lies in (0, high].
    double positive_number(double high) const;
    std::size_t integer(std::size_t low, std::size_t high) const;
    /// Three numbers, each in [low, high].
    std::array<float, 3> triple(double low, double high) const;
    /// Three numbers, or one that stands for all three, each in [low, high].
    std::array<float, 3> triple_or_number(double low, double high) const;

private:
    JsonNode(const nlohmann::json& value, std::string file, std::string path)
        : value_(&value), file_(std::move(file)), path_(std::move(path)) {}

    const nlohmann::json* value_;
    std::string file_;
    std::string path_;
};

} // namespace nusselt::scene
