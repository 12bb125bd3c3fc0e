#pragma once
/// Amounts of memory in messages.

#include <string>

namespace nusselt::base {

/// Such as "36 MB" or "1.5 GB", never less than the amount below a gigabyte. \param bytes not negative
std::string memory_text(double bytes);

} // namespace nusselt::base
