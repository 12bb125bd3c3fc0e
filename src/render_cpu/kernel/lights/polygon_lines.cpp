#include "render_cpu/kernel/lights/polygon_light.h"
#include "render_cpu/kernel/line_memory.h"
#include "render_cpu/kernel/line_numbers.h"
#include "render_cpu/kernel/shading_point.h"

#include <nusselt/estimate/reflected_offsets.h>
#include <nusselt/line_samples/line_family.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

using render::LineOffsets;
using render::LineOrientation;
using render::LineShading;
using render::ManyOccluders;

using Estimator = LineLight<Real, SurfaceBrdf>;

/// Points on each line that look up radiance. Of 64 lines in a penumbra, one point each has three times the error in a bit more
/// than half of the time; eight have two thirds of the error in one and a half of the time.
constexpr int kTexturePoints = 4;

/// The radiance of a light with a texture along parallel lines of it, over its mean.
class RadianceOfLines {
public:
    /// \param plane of the lines, in world space
    RadianceOfLines(const render_cpu::PolygonTexture& texture, const LinePlane<float>& plane) noexcept
        : texture_(texture),
          along_(broadcast<Real>(plane.along)),
          across_(broadcast<Real>(plane.across)),
          coordinates_(relative_plane(texture, plane)) {}

    /// \param offset of the lines
    /// \param at     coordinates along them
    Vector operator()(const Real& offset, const Real& at) const noexcept {
        return broadcast<Real>(to_vec(texture_.inverse_mean)) *
               radiance_at(texture_, coordinates_(fma(at, along_, offset * across_)));
    }

private:
    static TexturePlane<Real> relative_plane(const render_cpu::PolygonTexture& texture,
                                             const LinePlane<float>& plane) noexcept {
        const TexturePlane<float> world = plane_of(texture);
        return {broadcast<Real>(world.corner - plane.origin), broadcast<Real>(world.side_x),
                broadcast<Real>(world.side_y), broadcast<Real>(world.normal)};
    }

    const render_cpu::PolygonTexture& texture_;
    Vector along_, across_;
    TextureCoordinates<Real> coordinates_; ///< of points relative to the origin of the plane
};

/// The part of each line that is above the geometric tangent plane of the surface.
Interval<Real> above_surface(const Chord<Real>& chord, const LinePlane<float>& plane,
                             const ShadingPoint& point) noexcept {
    const Vector along = broadcast<Real>(plane.along);
    const Vector base =
        fma(chord.offset, broadcast<Real>(plane.across), broadcast<Real>(plane.origin - point.position));
    return part_above_horizon(fma(chord.extent.begin, along, base), fma(chord.extent.end, along, base),
                              broadcast<Real>(point.geometric_normal), chord.extent);
}

float sum_of_lanes(const Real& x) noexcept {
    float lanes[kLanes];
    x.store(lanes);
    float sum = 0;
    for (const float lane : lanes) sum += lane;
    return sum;
}

Vec3<float> sum_of_lanes(const Vector& v) noexcept {
    return {sum_of_lanes(v.x), sum_of_lanes(v.y), sum_of_lanes(v.z)};
}

LaneMask first_lanes(std::uint32_t count) noexcept {
    return count >= kLanes ? LaneMask(true) : LaneMask::from_bits((1u << count) - 1);
}

/// Sums over the lines of one light for one shading point.
struct LineSum {
    CompensatedSum all, diffuse;
    std::uint64_t parts = 0;
};

/// Results per shading point, in the lanes of a packet.
struct PacketResult {
    Lanes all{};
    Lanes diffuse{};
    float parts[kLanes] = {};

    void set(int lane, const LineSum& sum) noexcept {
        set(all, lane, sum_of_lanes(sum.all.sum));
        set(diffuse, lane, sum_of_lanes(sum.diffuse.sum));
        parts[lane] = static_cast<float>(sum.parts);
    }

private:
    static void set(Lanes& lanes, int lane, const Vec3<float>& v) noexcept {
        lanes.x[lane] = v.x;
        lanes.y[lane] = v.y;
        lanes.z[lane] = v.z;
    }
};

/// Takes the lines of one light, one shading point at a time.
template <int N>
class LineSampler {
public:
    /// \param texture null for uniform radiance
    LineSampler(ReflectedLight& reflected, const ConvexPolygon<float, N>& polygon,
                const render_cpu::PolygonTexture* texture, std::int32_t light) noexcept
        : reflected_(reflected),
          settings_(reflected.job().lines),
          memory_(*static_cast<LineMemory*>(reflected.line_memory())),
          light_(light),
          count_(static_cast<std::uint32_t>(settings_.count)),
          polygon_(polygon),
          texture_(texture),
          fixed_(polygon_, 0.0f),
          families_(broadcast<Real>(polygon_), common_angles()) {}

    /// Takes the lines of a shading point.
    /// \returns false where lines cannot be taken, or there are so many occluders that points are faster
    bool sample(int lane, PacketResult& result) noexcept {
        const ShadingPoint point = shading_point(reflected_.surface(), lane);
        // Uses a fixed orientation. Rounding depends on the orientation, and the choice must not depend on random
        // numbers.
        const SeenLight seen = see_light(polygon_, fixed_, point.apex, light_);
        render_cpu::TileStatistics& statistics = reflected_.statistics();
        if (needs_points(seen)) {
            ++statistics.point_lights;
            return false;
        }
        LineSum sum;
        if (!is_sound(seen))
            statistics.rejected_samples += count_;
        else if (settings_.orientation == LineOrientation::independent)
            add_independent(point, sum);
        else
            add_family(point, single_lane<Family>(families_, lane), {0, count_}, sum);
        result.set(lane, sum);
        ++statistics.line_lights;
        statistics.lines += count_;
        statistics.line_parts += sum.parts;
        return true;
    }

private:
    using Family = LineFamily<float, N>;

    struct ChosenLines {
        Real pdf; ///< of the offset [1/m]
        Real u;   ///< random number of the point on the line
        Real offset;
        Interval<Real> extent; ///< above the surface
        LaneMask drawn;
    };

    /// A range of line numbers among those of the shading point.
    struct Range {
        std::uint32_t first, count;
    };

    struct ParallelLines {
        const LinePlane<float>& plane; ///< in world space
        const LineFamily<Real, N>& family;
        const Estimator& estimator;
        const SeenLight& seen;
    };

    /// The common angle of all lines of each shading point of the packet.
    Real common_angles() const noexcept {
        if (settings_.orientation != LineOrientation::parallel) return Real(0);
        return Real(kPi<float>) * reflected_.orientation_random(light_).x;
    }

    bool needs_points(const SeenLight& seen) noexcept {
        const TickTimer timer(reflected_.statistics().line_visibility_ticks);
        const render_cpu::RenderJob& job = reflected_.job();
        if (has_partial_surfaces(*job.line_bvh, seen, counters())) return true;
        return settings_.many_occluders == ManyOccluders::points &&
               has_many_occluders(*job.line_bvh, seen, job.most_occluders, counters());
    }

    /// Whether the point and the light are finite. If they are not, no line has a density.
    static bool is_sound(const SeenLight& seen) noexcept {
        const Vec3<float>& p = seen.frame.point;
        const Vec3<float>& o = seen.frame.origin;
        return nusselt::is_finite(p.x + p.y + p.z) && nusselt::is_finite(o.x + o.y + o.z);
    }

    visibility::LineCounters& counters() noexcept { return reflected_.statistics().line_counters; }

    /// Adds lines each of which has its own angle, and thus its own family.
    void add_independent(const ShadingPoint& point, LineSum& sum) noexcept {
        for (std::uint32_t first = 0; first < count_; first += kLanes) {
            if (reflected_.stop().is_urgent()) return;
            // Uses y, not x. Jittered numbers have x in the same order in each pair, which would correlate offsets
            // with angles.
            const Real angles =
                Real(kPi<float>) * reflected_.line_random(light_, point.lane, first, kOrientationPair).y;
            const LineFamily<Real, N> families(broadcast<Real>(polygon_), angles);
            for (std::uint32_t i = 0; i < kLanes && first + i < count_; ++i) {
                const auto family = single_lane<Family>(families, static_cast<int>(i));
                add_family(point, family, {first + i, 1}, sum);
            }
        }
    }

    /// Adds parallel lines.
    void add_family(const ShadingPoint& point, const Family& family, const Range& range,
                    LineSum& sum) noexcept {
        const SeenLight seen = see_light(polygon_, family, point.apex, light_);
        const LineFamily<Real, N> lines(family);
        const Estimator estimator(
            to_shading_space(family.plane(), broadcast<Real>(point.position), point.frame),
            Real(family.reach()), point.surface);
        const auto add = [&](const auto& sample_offset) {
            add_lines(point, {family.plane(), lines, estimator, seen}, sample_offset, range, sum);
        };
        switch (settings_.offsets) {
        case LineOffsets::length:
            return add([&](const Real& u) { return lines.sample_by_length(u); });
        case LineOffsets::uniform:
            return add([&](const Real& u) { return lines.sample_uniform(u); });
        case LineOffsets::reflected:
            const ReflectedOffsets<Real, N> offsets(lines, estimator);
            return add([&](const Real& u) { return offsets.sample(u); });
        }
    }

    template <class SampleOffset>
    void add_lines(const ShadingPoint& point, const ParallelLines& lines, const SampleOffset& sample_offset,
                   const Range& range, LineSum& sum) noexcept {
        constexpr std::uint32_t kBatch = LineNumbers::kMost;
        for (std::uint32_t done = 0; done < range.count; done += kBatch) {
            if (reflected_.stop().is_urgent()) return;
            const std::uint32_t rest = range.count - done;
            ChosenLines chosen[kLargestLinePackCount];
            TracedLines<Real> traced[kLargestLinePackCount];
            const int packs = choose(point, lines, sample_offset,
                                     {range.first + done, rest < kBatch ? rest : kBatch}, chosen);
            for (int i = 0; i < packs; ++i)
                traced[i] = make_traced(chosen[i], chosen[i].extent, i * kPartsPerLine, kPartsPerLine);
            find_visible_parts(lines.seen, traced, packs);
            for (int i = 0; i < packs; ++i)
                if (!has_lost_parts(traced[i])) add_pack(point, lines, chosen[i], traced[i], sum);
            // Comes last because it overwrites the memory of the other packs.
            for (int i = 0; i < packs; ++i)
                if (has_lost_parts(traced[i]))
                    add_crowded(point, lines, chosen[i], chosen[i].extent, kMostHalvings, sum);
        }
    }

    /// Adds a part of the lines of a pack with many visible parts. Uses all memory, and halves the lines if even that
    /// does not suffice. Each half is estimated like a separate line; their sum is the estimate of the whole.
    void add_crowded(const ShadingPoint& point, const ParallelLines& lines, const ChosenLines& chosen,
                     const Interval<Real>& extent, int halvings, LineSum& sum) noexcept {
        TracedLines<Real> traced = make_traced(chosen, extent, 0, kPartsInMemory);
        find_visible_parts(lines.seen, &traced, 1);
        if (halvings == 0 || !has_lost_parts(traced)) return add_pack(point, lines, chosen, traced, sum);
        const Real middle = fma(Real(0.5f), extent.end - extent.begin, extent.begin);
        add_crowded(point, lines, chosen, {extent.begin, middle}, halvings - 1, sum);
        add_crowded(point, lines, chosen, {middle, extent.end}, halvings - 1, sum);
    }

    static bool has_lost_parts(const TracedLines<Real>& lines) noexcept {
        return any(lines.parts.lost() > Real(0));
    }

    /// \param first first slot in the memory
    TracedLines<Real> make_traced(const ChosenLines& chosen, const Interval<Real>& extent, int first,
                                  int capacity) noexcept {
        TracedLines<Real> lines{chosen.offset, VisibleParts<Real>(memory_.parts + first, capacity)};
        const Interval<Real> none = empty_interval<Real>();
        lines.parts.reset(
            {select(chosen.drawn, extent.begin, none.begin), select(chosen.drawn, extent.end, none.end)});
        return lines;
    }

    /// \returns the number of packs
    template <class SampleOffset>
    int choose(const ShadingPoint& point, const ParallelLines& lines, const SampleOffset& sample_offset,
               const Range& range, ChosenLines* chosen) noexcept {
        const LineNumbers numbers(range.count, [&](std::uint32_t k) {
            return reflected_.line_random(light_, point.lane, range.first + k, kLinePair);
        });
        int packs = 0;
        for (std::uint32_t k = 0; k < range.count; k += kLanes, ++packs) {
            const Vec2<Real> u = numbers.pack(k);
            const LineChoice<Real> choice = sample_offset(u.x);
            // Comparisons with NaN are false. Negated, they keep NaN, so that it is counted.
            const LaneMask drawn = first_lanes(range.count - k) & !(choice.pdf <= Real(0));
            const Chord<Real> chord = lines.family.chord(choice.offset);
            chosen[packs] = {choice.pdf, u.y, choice.offset, above_surface(chord, lines.plane, point), drawn};
        }
        return packs;
    }

    void find_visible_parts(const SeenLight& seen, TracedLines<Real>* lines, int packs) noexcept {
        const TickTimer timer(reflected_.statistics().line_visibility_ticks);
        LineTracer<Real>(*reflected_.job().line_bvh, seen, lines, packs, counters()).trace();
    }

    BrdfComponents<Real> estimate(const ShadingPoint& point, const ParallelLines& lines, const Real& u,
                                  const TracedLines<Real>& traced) const noexcept {
        const VisibleParts<Real>& parts = traced.parts;
        if (texture_ != nullptr) {
            const RadianceOfLines radiance(*texture_, lines.plane);
            return lines.estimator.template textured<kTexturePoints>(
                traced.offset, parts, u, [&](const Real& at) { return radiance(traced.offset, at); });
        }
        const bool is_closed_form = settings_.shading == LineShading::analytic || point.is_closed_form;
        return is_closed_form ? lines.estimator.analytic(traced.offset, parts)
                              : lines.estimator.unbiased(traced.offset, parts, u);
    }

    void add_pack(const ShadingPoint& point, const ParallelLines& lines, const ChosenLines& chosen,
                  const TracedLines<Real>& traced, LineSum& sum) noexcept {
        const VisibleParts<Real>& parts = traced.parts;
        for (int i = 0; i < parts.count(); ++i) sum.parts += count_lanes(parts[i].begin < parts[i].end);
        const BrdfComponents<Real> light = estimate(point, lines, chosen.u, traced);
        const Real weight = Real(1) / select(chosen.drawn, chosen.pdf, Real(1));
        const Vector diffuse = weight * light.diffuse;
        const Vector all = diffuse + weight * light.specular;
        const LaneMask sound = is_finite(all);
        reflected_.statistics().rejected_samples += count_lanes(chosen.drawn & !sound);
        const Vector zero{Real(0), Real(0), Real(0)};
        sum.all.add(select(chosen.drawn & sound, all, zero));
        sum.diffuse.add(select(chosen.drawn & sound, diffuse, zero));
    }

    ReflectedLight& reflected_;
    const render::LineSettings& settings_;
    LineMemory& memory_;
    std::int32_t light_;
    std::uint32_t count_;
    ConvexPolygon<float, N> polygon_; ///< in world space
    const render_cpu::PolygonTexture* texture_;
    Family fixed_;
    LineFamily<Real, N> families_; ///< one for each shading point of the packet
};

template <int N>
void add_points(ReflectedLight& reflected, const render_cpu::LightSet& lights, std::int32_t index,
                LaneMask lanes) noexcept {
    const render_cpu::RenderJob& job = reflected.job();
    ReflectedLight others = reflected.with(lanes, job.points_in_place_of_lines);
    const bool has_texture = texture_of(lights, index) != nullptr;
    (has_texture ? textured_points<N>(job) : polygon_points<N>(job))(others, lights, index);
    reflected.add(others);
}

template <int N>
void add_lines(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
               std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    auto light = PolygonLight<N>::local(reflected, lights, index);
    const std::uint32_t lit = light.lit.bits();
    if (lit == 0) return;
    const render_cpu::RenderJob& job = reflected.job();
    if (job.lines.many_occluders == ManyOccluders::points && job.most_occluders < 0) {
        reflected.statistics().point_lights += count_lanes(light.lit);
        add_points<N>(reflected, lights, index, light.lit);
        return;
    }
    PacketResult result;
    std::uint32_t with_points = 0;
    LineSampler<N> sampler(reflected, PolygonLight<N>::world(lights, index), light.shape.texture,
                           lights.first + index);
    for (int lane = 0; lane < kLanes; ++lane)
        if ((lit >> lane & 1u) != 0 && !sampler.sample(lane, result)) with_points |= 1u << lane;
    light.lit = LaneMask::from_bits(lit & ~with_points);
    const auto lines = static_cast<float>(job.lines.count);
    reflected.add_known(light, {Real(1 / lines) * load(result.all), Real(1 / lines) * load(result.diffuse)});
    reflected.add_pieces(select(light.lit, Real(lines), Real(0)), Real::load(result.parts));
    if (with_points != 0) add_points<N>(reflected, lights, index, LaneMask::from_bits(with_points));
}

} // namespace

template <>
render_cpu::AddLight polygon_lines<4>() noexcept {
    return &add_lines<4>;
}
template <>
render_cpu::AddLight polygon_lines<8>() noexcept {
    return &add_lines<8>;
}

} // namespace kernel
NUSSELT_NAMESPACE_END
