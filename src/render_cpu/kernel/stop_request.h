#pragma once
/// Notices in time that a rendering is to stop.

#include <nusselt/core/config.h>

#include <cstdint>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The request to stop, and how urgent it is for the present camera ray of a packet.
class StopRequest {
public:
    /// \param requested see RenderJob::stop_requested
    explicit StopRequest(const unsigned char* requested) noexcept : requested_(requested) {}

    /// Starts the next camera ray.
    void begin_ray() noexcept { ray_begin_ = __builtin_ia32_rdtsc(); }

    /// No further camera ray is to be begun.
    bool is_made() const noexcept { return __atomic_load_n(requested_, __ATOMIC_RELAXED) != 0; }

    /// The camera ray takes so long that it is to be given up. Then this stays true.
    bool is_urgent() const noexcept {
        return is_made() && __builtin_ia32_rdtsc() - ray_begin_ > kPatienceTicks;
    }

private:
    /// A tenth to half a second, in ticks of the time stamp counter.
    static constexpr std::uint64_t kPatienceTicks = 500'000'000;

    const unsigned char* requested_;
    std::uint64_t ray_begin_ = 0;
};

} // namespace kernel
NUSSELT_NAMESPACE_END
