#pragma once
/// Floating-point mode of the threads that render.

#include <immintrin.h>

namespace nusselt::base {

/// Denormals count as zero on this thread while this lives: Embree asks for it, and all threads shall compute
/// alike.
class FlushDenormals {
public:
    FlushDenormals() { _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero); }
    ~FlushDenormals() { _mm_setcsr(saved_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    static constexpr unsigned kFlushToZero = 1u << 15;
    static constexpr unsigned kDenormalsAreZero = 1u << 6;
    unsigned saved_ = _mm_getcsr();
};

} // namespace nusselt::base
