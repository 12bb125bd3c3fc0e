#pragma once
/// Where the tests find scenes, tables and documents: objects that do not know the path of the checkout can be shared
/// between checkouts by a compiler cache.

namespace nusselt_test {

/// The root of the repository, without a slash at its end.
extern const char* const kSourceFolder;

} // namespace nusselt_test
