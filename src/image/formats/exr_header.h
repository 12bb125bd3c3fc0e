#pragma once
/// A look at EXR headers before OpenEXR reads them.

#include <istream>

namespace nusselt::image {

/// OpenEXR allocates what headers ask for before it finds that the file is shorter. This reads their attributes, at the
/// beginning of the stream, and leaves the stream there. What else is wrong with a file is left to OpenEXR.
/// \throws std::runtime_error  if an attribute claims more bytes than the file has, or other than OpenEXR reads for it
void check_exr_attributes(std::istream& stream);

} // namespace nusselt::image
