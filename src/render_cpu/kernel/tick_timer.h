#pragma once

#include <nusselt/core/config.h>

#include <cstdint>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Adds its lifetime to a sum [ticks of the time stamp counter].
class TickTimer {
public:
    explicit TickTimer(std::uint64_t& sum) noexcept : sum_(sum) {}
    ~TickTimer() { sum_ += __builtin_ia32_rdtsc() - begin_; }
    TickTimer(const TickTimer&) = delete;
    TickTimer& operator=(const TickTimer&) = delete;

private:
    std::uint64_t& sum_;
    std::uint64_t begin_ = __builtin_ia32_rdtsc();
};

} // namespace kernel
NUSSELT_NAMESPACE_END
