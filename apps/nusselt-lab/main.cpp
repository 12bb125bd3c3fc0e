#include "apps/common/program.h"
#include "apps/nusselt-lab/bench/bench.h"
#include "apps/nusselt-lab/evidence/blue_noise.h"
#include "apps/nusselt-lab/evidence/fit_ltc.h"
#include "apps/nusselt-lab/evidence/fuzz.h"
#include "apps/nusselt-lab/evidence/gather.h"
#include "apps/nusselt-lab/evidence/map.h"
#include "apps/nusselt-lab/evidence/reproduce.h"
#include "apps/nusselt-lab/evidence/submit.h"
#include "apps/nusselt-lab/gpu/gpu.h"

int main(int argc, char** argv) {
    using namespace nusselt::app;
    return run_program(
        {"nusselt-lab",
         "Nusselt's laboratory measures, tests and reproduces the claims of the library and the renderer.",
         "Examples:\n"
         "  nusselt-lab reproduce line-diffuse -o pages\n"
         "  nusselt-lab bench rays scenes/room.pbrt --resolution 640x360\n"
         "\n"
         "`nusselt-lab COMMAND --help` explains a command.\n"
         "Exit codes: 0 success, 1 error or broken expectation, 2 wrong usage, 3 an expectation\n"
         "was not evaluated; 130 stopped by Ctrl-C, 143 by SIGTERM, 129 by SIGHUP, 152 by SIGXCPU, 138 by "
         "SIGUSR1.",
         {setup_reproduce, setup_bench, setup_gpu, setup_map, setup_fuzz, setup_submit, setup_gather,
          setup_fit_ltc, setup_blue_noise}},
        argc, argv);
}
