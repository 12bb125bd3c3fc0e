/// The loop as a function that Python's ctypes calls, so that both sides are timed in turn in one process.
#include "python/bench/pack_loop.h"

/// \param isa the number of a base::Isa that the processor supports
extern "C" __attribute__((visibility("default"))) void nusselt_pack_loop(int isa, const float* corners,
                                                                         std::size_t count, const float* u,
                                                                         float* wi, float* pdf, float* p) {
    using namespace nusselt;
    const python::PackLoop loop = {corners, count, u, wi, pdf, p};
    base::dispatch(static_cast<base::Isa>(isa),
                   [&]<base::Isa chosen> { python::sample_in_packs<chosen>(loop); });
}
