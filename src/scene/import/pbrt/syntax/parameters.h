#pragma once
/// Typed parameter lists: "type name" value pairs behind a directive.

#include "scene/build/limits.h"
#include "scene/colour/colour_space.h"
#include "scene/import/pbrt/syntax/tokenizer.h"
#include "scene/input/diagnostics.h"
#include "scene/input/named_files.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::scene {

/// The number that `text` spells, perhaps infinite or NaN; nothing if it is none.
std::optional<double> number_of(std::string_view text);

/// The number that `text` spells. Throws SceneError if it is none or not finite.
double parse_number(std::string_view text, const Location& location);

enum class ParameterKind { integer, real, point2, point3, colour, boolean, string, texture, unsupported };

struct Parameter {
    std::string type;
    std::string name;
    ParameterKind kind = ParameterKind::unsupported;
    Location location;
    std::vector<double> numbers;
    std::vector<std::string> strings; ///< strings, texture names, spelled spectra; "true" or "false"
    bool used = false;
};

/// The text for a parameter in messages: its quoted type and name.
std::string declaration(const Parameter& parameter);

/// The version of pbrt that a scene was written for.
enum class PbrtVersion { v3, v4 };

/// The context on which the meaning of parameters depends.
struct ParameterContext {
    PbrtVersion version = PbrtVersion::v4;
    const ColourSpace* colour_space = &kSrgb;
    const SourceFile* main_file = nullptr; ///< files are looked for beside it too; may be null
    SceneBudget* budget = nullptr;         ///< that files are read on; null where no parameter names any
    NamedFiles* named_files = nullptr;     ///< likewise
    /// Parameters that apply where a directive does not name them, the most important one last; may be null.
    std::shared_ptr<const std::vector<Parameter>> defaults;
};

/// The parameters of one directive. Look-ups go by name and kind and mark what they find as used, so that
/// warn_unused() can name the rest; a parameter of the right name but another kind counts as unknown.
/// All look-ups throw SceneError if the number of values is wrong.
class ParameterList {
public:
    ParameterList() = default;
    /// Reads all parameters that follow. Throws SceneError on malformed ones.
    ParameterList(Tokenizer& tokens, const Location& directive, ParameterContext context = {});

    /// The budget that reading of files is charged to.
    SceneBudget& budget() const { return *context_.budget; }
    NamedFiles& named_files() const { return *context_.named_files; }
    /// Position of the directive.
    const Location& location() const { return location_; }
    /// Position of the parameter, or of the directive if there is no such parameter.
    Location location_of(std::string_view name) const;

    double real(std::string_view name, double fallback) { return optional_real(name).value_or(fallback); }
    std::optional<double> optional_real(std::string_view name);
    int integer(std::string_view name, int fallback);
    bool boolean(std::string_view name, bool fallback);
    std::string string(std::string_view name, std::string_view fallback);
    /// All values of a parameter of type string; none if it is missing.
    std::vector<std::string> strings(std::string_view name);
    std::optional<std::string> texture(std::string_view name);
    /// A colour in linear sRGB, from any type of colour or spectrum; docs/materials.md has the rules. Negative where
    /// the text gives negative numbers; what lies outside the gamut is clamped with a warning. Throws SceneError if
    /// a file of samples cannot be read or the values do not fit the type.
    std::optional<Float3> optional_colour(std::string_view name, Warnings& warnings,
                                          SpectrumUse use = SpectrumUse::albedo);
    Float3 colour(std::string_view name, const Float3& fallback, Warnings& warnings,
                  SpectrumUse use = SpectrumUse::albedo) {
        return optional_colour(name, warnings, use).value_or(fallback);
    }

    std::optional<Float3> point(std::string_view name);
    std::vector<Float3> points(std::string_view name);
    /// Pairs, of type point2 or float.
    std::vector<Float2> pairs(std::string_view name);
    std::vector<double> reals(std::string_view name);
    std::vector<double> integers(std::string_view name);
    /// Non-negative integers below `limit`; anything else is an error that names value and position.
    std::vector<std::uint32_t> indices(std::string_view name, std::size_t limit);

    /// Numbers and strings of all parameters.
    std::size_t value_count() const;
    /// Marks parameters as used that have no meaning here.
    void ignore(std::initializer_list<std::string_view> names);
    /// Parameters of this list behind those of `outer`.
    std::vector<Parameter> appended_to(const std::vector<Parameter>& outer) const;
    /// One warning per kind of unused parameter, saying that it is ignored by `owner`.
    void warn_unused(std::string_view owner, Warnings& warnings) const;

private:
    const Parameter* find(std::string_view name, ParameterKind kind);
    const Parameter* find_single(std::string_view name, ParameterKind kind);

    std::vector<Parameter> parameters_;
    Location location_;
    ParameterContext context_;
};

} // namespace nusselt::scene
