#include "base/process_time.h"

#include <time.h>

namespace nusselt::base {

double process_seconds() {
    timespec time;
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace nusselt::base
