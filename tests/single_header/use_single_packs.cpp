#include <nusselt.h>

#include "use_techniques.h"

/// The second file that includes the library.
void use_packs() {
    for (int seed = 0; seed < 20; ++seed) use_techniques::use_all<nusselt::Pack<double, 4>>(seed);
}
