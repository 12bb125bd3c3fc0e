#pragma once
/// pbrt's option directive.

#include "scene/import/pbrt/syntax/tokenizer.h"
#include "scene/input/diagnostics.h"

#include <string>

namespace nusselt::scene {

/// Reads the value of an option, as in `Option "disablepixeljitter" true`: other than the parameters of directives, it
/// follows a name, and has no brackets in most scenes. No option has an effect here; a warning tells so where the image
/// would differ from that of pbrt, and for options that pbrt does not know.
/// \param name     what stands in quotes: the name, perhaps behind a type
/// \param location of the directive
/// \throws SceneError if there is no value, or none that pbrt takes
void read_option(const std::string& name, const Location& location, Tokenizer& tokens, Warnings& warnings);

} // namespace nusselt::scene
