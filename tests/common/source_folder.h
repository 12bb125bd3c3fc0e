#pragma once
/// The folder of scenes, tables and documents for tests. Objects that do not contain the path of the checkout can be
/// shared between checkouts by a compiler cache.

namespace nusselt_test {

/// The root of the repository, without a slash at its end.
extern const char* const kSourceFolder;

} // namespace nusselt_test
