#pragma once
/// A format for tests: a line of text for each thing. It shows what another format takes: this folder, and a row in the
/// table of importers.
///
///     toy
///     film WIDTH HEIGHT
///     camera X Y Z                                 looks along +z
///     object NAME                                  begins an object, which ends with `end`
///     mesh R G B  X Y Z  X Y Z  X Y Z ...          a fan of triangles of this albedo
///     light R G B  X Y Z  X Y Z  X Y Z ...         a black fan that emits
///     tube R G B  X Y Z  X Y Z  RADIUS             a tubular light
///     instance NAME X Y Z                          a copy of an object, moved
///
/// Empty lines and those that begin with # are skipped.

#include "scene/import/importers.h"

namespace nusselt::scene {

SceneDescription read_toy(const std::filesystem::path& path);
bool looks_like_toy(std::string_view contents);

inline constexpr Importer kToyImporter = {"toy", ".toy", read_toy, looks_like_toy};

} // namespace nusselt::scene
