/// Compiled once per instruction set.
#include "python/bench/pack_loop.h"

#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/simd/pack.h>

namespace nusselt::python {

template <>
void sample_in_packs<base::Isa::NUSSELT_UNIT_ISA>(const PackLoop& loop) {
    constexpr int kLanes = base::lane_count(base::Isa::NUSSELT_UNIT_ISA);
    using Floats = Pack<float, kLanes>;
    Vec3<Floats> corners[4];
    for (int j = 0; j < 4; ++j)
        corners[j] = {Floats(loop.corners[3 * j]), Floats(loop.corners[3 * j + 1]),
                      Floats(loop.corners[3 * j + 2])};
    const PolygonProjectedSolidAngle<Floats, 4> technique(make_polygon<4>(corners, 4));
    for (std::size_t begin = 0; begin < loop.count; begin += kLanes) {
        float u[2][kLanes];
        for (int i = 0; i < kLanes; ++i)
            for (int c = 0; c < 2; ++c) u[c][i] = loop.u[2 * (begin + std::size_t(i)) + std::size_t(c)];
        const auto sample = technique.sample({Floats::load(u[0]), Floats::load(u[1])});
        sample.pdf.store(loop.pdf + begin);
        float v[6][kLanes];
        const Floats numbers[] = {sample.wi.x, sample.wi.y, sample.wi.z, sample.p.x, sample.p.y, sample.p.z};
        for (int c = 0; c < 6; ++c) numbers[c].store(v[c]);
        for (int i = 0; i < kLanes; ++i)
            for (int c = 0; c < 3; ++c) {
                loop.wi[3 * (begin + std::size_t(i)) + std::size_t(c)] = v[c][i];
                loop.p[3 * (begin + std::size_t(i)) + std::size_t(c)] = v[3 + c][i];
            }
    }
}

} // namespace nusselt::python
