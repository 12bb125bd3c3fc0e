#include <nusselt/nusselt.h>
#include <nusselt/simd/pack.h>

#include "use_techniques.h"

int main() {
    for (int seed = 0; seed < 20; ++seed) use_techniques::use_all<float>(seed);
    for (int seed = 0; seed < 20; ++seed) use_techniques::use_all<nusselt::Pack<double, 4>>(seed);
}
