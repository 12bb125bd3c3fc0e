#pragma once
/// Switches the floating-point unit to flushing denormals, on x86 and on 64-bit ARM.

#if !defined(__aarch64__)
#include <xmmintrin.h>
#endif

namespace nusselt_test {

#if defined(__aarch64__)
inline unsigned floating_point_mode() { return __builtin_aarch64_get_fpcr(); }
inline void set_floating_point_mode(unsigned mode) { __builtin_aarch64_set_fpcr(mode); }
inline constexpr unsigned kFlushDenormals = 1u << 24;
#else
inline unsigned floating_point_mode() { return _mm_getcsr(); }
inline void set_floating_point_mode(unsigned mode) { _mm_setcsr(mode); }
inline constexpr unsigned kFlushDenormals = 0x8040u;
#endif

/// Makes denormal inputs and results count as zero, as in programs that link Embree.
class FlushDenormalsToZero {
public:
    FlushDenormalsToZero() : before_(floating_point_mode()) {
        set_floating_point_mode(before_ | kFlushDenormals);
    }
    ~FlushDenormalsToZero() { set_floating_point_mode(before_); }
    FlushDenormalsToZero(const FlushDenormalsToZero&) = delete;
    FlushDenormalsToZero& operator=(const FlushDenormalsToZero&) = delete;

private:
    unsigned before_;
};

} // namespace nusselt_test
