#include <nusselt.h>

#include "use_techniques.h"

void use_packs();

int main() {
    for (int seed = 0; seed < 20; ++seed) use_techniques::use_all<float>(seed);
    use_packs();
}
