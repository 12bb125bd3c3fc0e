#pragma once
/// Typed parameter lists: "type name" value pairs behind a directive.

#include "scene/diagnostics.h"
#include "scene/scene.h"
#include "scene/tokenizer.h"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::scene {

/// The number that `text` spells. Throws SceneError if it is none or not finite.
double parse_number(std::string_view text, const Location& location);

enum class ParameterKind { integer, real, point2, point3, colour, boolean, string, texture, unsupported };

struct Parameter {
    std::string_view type;
    std::string_view name;
    ParameterKind kind = ParameterKind::unsupported;
    Location location;
    std::vector<double> numbers;
    std::vector<std::string> strings; ///< strings, texture names, spelled spectra; "true" or "false"
    bool used = false;
};

/// The parameters of one directive. Look-ups go by name and kind and mark what they find as used, so that
/// warn_unused() can name the rest; a parameter of the right name but another kind counts as unknown.
/// All look-ups throw SceneError if the number of values is wrong.
class ParameterList {
public:
    ParameterList() = default;
    /// Reads all parameters that follow. Throws SceneError on malformed ones.
    ParameterList(Tokenizer& tokens, const Location& directive);

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
    /// Of type rgb or color. A spectrum is reduced to a grey of its mean value with a warning, or to nothing
    /// (also with a warning) if it is given by name. `real_name` of a black body likewise.
    std::optional<Float3> optional_colour(std::string_view name, Warnings& warnings);
    Float3 colour(std::string_view name, const Float3& fallback, Warnings& warnings);
    /// Name of a spectrum like "metal-Cu-eta", if the parameter is given in this way.
    std::optional<std::string> spectrum_name(std::string_view name);

    std::optional<Float3> point(std::string_view name);
    std::vector<Float3> points(std::string_view name);
    /// Pairs, of type point2 or float.
    std::vector<Float2> pairs(std::string_view name);
    std::vector<double> reals(std::string_view name);
    /// Non-negative integers below `limit`; anything else is an error that names value and position.
    std::vector<std::uint32_t> indices(std::string_view name, std::size_t limit);

    /// Marks parameters as used that have no meaning here.
    void ignore(std::initializer_list<std::string_view> names);
    /// One warning per kind of unused parameter, saying that it is ignored by `owner`.
    void warn_unused(std::string_view owner, Warnings& warnings) const;

private:
    Parameter* find(std::string_view name, ParameterKind kind);
    const Parameter* find_single(std::string_view name, ParameterKind kind);

    std::vector<Parameter> parameters_;
    Location location_;
};

} // namespace nusselt::scene
