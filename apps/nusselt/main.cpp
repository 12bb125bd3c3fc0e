#include "apps/common/program.h"
#include "apps/nusselt/image/compare.h"
#include "apps/nusselt/image/convert.h"
#include "apps/nusselt/render/merge.h"
#include "apps/nusselt/render/render.h"
#include "apps/nusselt/render/submit.h"
#include "apps/nusselt/scene/camera.h"
#include "apps/nusselt/scene/info.h"
#include "apps/nusselt/scene/lights.h"
#include "apps/nusselt/scene/techniques.h"
#include "apps/nusselt/view/view.h"

int main(int argc, char** argv) {
    using namespace nusselt::app;
    return run_program(
        {"nusselt",
         "Nusselt renders direct light of polygonal, round and linear lights with little noise.",
         "Examples:\n"
         "  nusselt render scene.pbrt --spp 16 -o image.exr -o image.png\n"
         "  nusselt compare image.exr reference.exr --metrics rmse,flip\n"
         "\n"
         "`nusselt COMMAND --help` explains a command.\n"
         "Exit codes: 0 success, 1 error, 2 wrong usage, 3 broken limit of compare; 130 stopped by Ctrl-C,\n"
         "143 by SIGTERM, 129 by SIGHUP, 152 by SIGXCPU, 138 by SIGUSR1.",
         {setup_render, setup_view, setup_submit, setup_merge, setup_info, setup_lights, setup_camera,
          setup_techniques, setup_compare, setup_convert}},
        argc, argv);
}
