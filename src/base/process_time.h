#pragma once
/// Time that does not depend on what else runs on the machine.

namespace nusselt::base {

/// For which all threads of this program ran so far, on processors of their own or not [s].
double process_seconds();

} // namespace nusselt::base
