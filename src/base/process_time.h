#pragma once
/// Time that does not depend on what else runs on the machine.

namespace nusselt::base {

/// The processor time of all threads of this program so far [s].
double process_seconds();

} // namespace nusselt::base
