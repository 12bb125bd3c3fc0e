#pragma once
/// The blue noise of data/blue-noise.bin, compiled in.

#include <nusselt/random/blue_noise.h>

namespace nusselt::tables {

/// Lives as long as the program.
BlueNoiseView blue_noise();

} // namespace nusselt::tables
