#include "tables/blue_noise.h"

// The linker includes the file, as that of the LTC table.
asm(".section .rodata\n"
    ".balign 16\n"
    ".global nusselt_blue_noise_begin\n"
    "nusselt_blue_noise_begin:\n"
    ".incbin \"" NUSSELT_BLUE_NOISE "\"\n"
    ".previous\n");
extern "C" const unsigned char nusselt_blue_noise_begin[];

namespace nusselt::tables {

BlueNoiseView blue_noise() { return {nusselt_blue_noise_begin}; }

} // namespace nusselt::tables
