#pragma once
/// The sectors into which projected solid angle sampling cuts a polygon, stored so that a random number finds its sector.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672:
/// Sec. 3.2 (central case) and 3.3 to 3.7 (decentral case).

#include <nusselt/core/broadcast.h>
#include <nusselt/sampling/decentral_sector.h>
#include <nusselt/simd/across_lanes.h>

NUSSELT_NAMESPACE_BEGIN

/// The great circle of an edge in the central case: the point at angle a is cos(a) begin + sin(a) tangent.
template <class Real>
struct EdgeCircle {
    Vec3<Real> begin, tangent; ///< unit vectors
    Real angle_per_area;       ///< per doubled area
};

/// Calls visit(member of to, member of from) for all members of two records.
template <class To, class From, class Visit>
NUSSELT_INLINE void visit_members(EdgeCircle<To>& to, const EdgeCircle<From>& from,
                                  const Visit& visit) noexcept {
    visit_members(to.begin, from.begin, visit);
    visit_members(to.tangent, from.tangent, visit);
    visit(to.angle_per_area, from.angle_per_area);
}

/// The arc that a segment is projected to; of any direction if it lies on a line through the origin.
template <class Real>
NUSSELT_INLINE EdgeCircle<Real> arc_of(const Vec3<Real>& begin, const Vec3<Real>& chord,
                                       const Real& angle_per_area) noexcept {
    const Vec3<Real> n = cross(begin, chord);
    const Vec3<Real> unit = inverse_length(begin) * begin;
    return {unit, inverse_length(n) * cross(n, unit), angle_per_area};
}

/// A decentral sector with what follows from it.
template <class Real>
struct PreparedSector {
    DecentralSector<Real> sector;
    SectorPlanes<Real> planes;
    SectorQuads<Real> quads;
};

/// K sectors, a light per lane. What samples need beside the geometry of their sector is computed for each sample.
/// \tparam Angles see PolygonProjectedSolidAngle.
template <class Real, int K, class Angles>
class ProjectedSectors {
public:
    /// The sector of a random number.
    struct Selection {
        Vec3<Real> begin, chord;
        Real begin_gap, end_gap, angle_per_area, doubled_area;
        Real rest; ///< of the doubled area, up to the sample
    };

    ProjectedSectors() = default;

    /// The same sectors in all lanes.
    template <class Single>
    NUSSELT_HD explicit ProjectedSectors(const ProjectedSectors<Single, K, Angles>& single) noexcept {
        NUSSELT_UNROLL
        for (int k = 0; k < K; ++k) {
            const DecentralSector<Single> sector = single.sector(k);
            begin_[k] = broadcast<Real>(sector.begin);
            chord_[k] = broadcast<Real>(sector.chord);
            begin_gap_[k] = Real(sector.begin_gap);
            end_gap_[k] = Real(sector.end_gap);
            angle_per_area_[k] = Real(single.angle_per_area(k));
            doubled_area_[k] = Real(single.doubled_area(k));
        }
    }

    /// Makes the sectors from `first` to before `end` empty.
    NUSSELT_HD void clear(int first, int end) noexcept {
        for (int k = first; k < end; ++k) {
            begin_[k] = chord_[k] = {Real(0), Real(0), Real(0)};
            begin_gap_[k] = end_gap_[k] = angle_per_area_[k] = doubled_area_[k] = Real(0);
        }
    }

    /// Makes sector k a decentral one in all lanes.
    NUSSELT_HD void set_decentral(int k, const DecentralSector<Real>& sector, const Real& area) noexcept {
        begin_[k] = sector.begin;
        chord_[k] = sector.chord;
        begin_gap_[k] = sector.begin_gap;
        end_gap_[k] = sector.end_gap;
        angle_per_area_[k] = Real(0);
        doubled_area_[k] = area;
    }
    /// Makes sector k a central one where the mask is set.
    NUSSELT_HD void set_central(int k, const mask_t<Real>& mask, const Vec3<Real>& begin,
                                const Vec3<Real>& chord, const Real& angle_per_area,
                                const Real& area) noexcept {
        begin_[k] = select(mask, begin, begin_[k]);
        chord_[k] = select(mask, chord, chord_[k]);
        angle_per_area_[k] = angle_per_area;
        doubled_area_[k] = select(mask, area, doubled_area_[k]);
    }
    /// To be called once all sectors are set. Returns twice the area of all sectors.
    NUSSELT_HD Real complete(const mask_t<Real>& /*central*/) noexcept {
        Real total = Real(0);
        NUSSELT_UNROLL
        for (int k = 0; k < K; ++k) total = total + doubled_area_[k];
        return total;
    }

    /// Sector k. In the central case, the gaps mean nothing.
    NUSSELT_HD DecentralSector<Real> sector(int k) const noexcept {
        return {begin_[k], chord_[k], begin_gap_[k], end_gap_[k], det(xy(begin_[k]), xy(chord_[k]))};
    }
    NUSSELT_HD const Real& doubled_area(int k) const noexcept { return doubled_area_[k]; }
    NUSSELT_HD const Real& angle_per_area(int k) const noexcept { return angle_per_area_[k]; }

    /// \param u             a random number.
    /// \param doubled_total twice the area of all sectors.
    NUSSELT_HD Selection select_sector(const Real& u, const Real& doubled_total) const noexcept {
        // Walk along the sectors up to the area that the random number demands.
        const Real target = u * doubled_total;
        Selection s{begin_[0],          chord_[0],        begin_gap_[0], end_gap_[0],
                    angle_per_area_[0], doubled_area_[0], Real(0)};
        Real before = Real(0);
        Real first = Real(0);
        NUSSELT_UNROLL
        for (int k = 0; k < K; ++k) {
            const auto reached = (doubled_area_[k] > Real(0)) & (target >= before);
            s.begin = select(reached, begin_[k], s.begin);
            s.chord = select(reached, chord_[k], s.chord);
            s.begin_gap = select(reached, begin_gap_[k], s.begin_gap);
            s.end_gap = select(reached, end_gap_[k], s.end_gap);
            s.angle_per_area = select(reached, angle_per_area_[k], s.angle_per_area);
            s.doubled_area = select(reached, doubled_area_[k], s.doubled_area);
            first = select(reached, before, first);
            before = before + doubled_area_[k];
        }
        s.rest = min(max(fma(u, doubled_total, -first), Real(0)), s.doubled_area);
        return s;
    }

    NUSSELT_HD EdgeCircle<Real> central(const Selection& s) const noexcept {
        return arc_of(s.begin, s.chord, s.angle_per_area);
    }
    NUSSELT_HD PreparedSector<Real> decentral(const Selection& s) const noexcept {
        const DecentralSector<Real> sector{s.begin, s.chord, s.begin_gap, s.end_gap,
                                           det(xy(s.begin), xy(s.chord))};
        return {sector, sector.planes(), sector.quads()};
    }

private:
    Vec3<Real> begin_[K]; ///< where the outer edge of each sector begins, in order of azimuth
    Vec3<Real> chord_[K]; ///< the part of the edge in the sector
    Real begin_gap_[K];   ///< see DecentralSector; decentral case only
    Real end_gap_[K];
    Real angle_per_area_[K]; ///< see EdgeCircle; central case only
    Real doubled_area_[K];   ///< twice the area of each sector, 0 for those without light
};

#if NUSSELT_HAS_VERTEX_LANES
/// The sectors of one light, as lanes. What samples need is prepared for all sectors at once, which costs less than to
/// compute it for one sample.
template <int K, class Angles>
class ProjectedSectors<float, K, Angles> {
    static constexpr int kLanes = lanes_for(K);
    using Stored = StoredLanes<kLanes>;

public:
    struct Selection {
        int index;
        float doubled_area;
        float rest; ///< of the doubled area, up to the sample
    };

    /// Makes the sectors from `first` to before `end` empty.
    void clear(int first, int end) noexcept {
        constexpr Vec3<float> kAnywhere{1, 0, 0};
        for (int k = first; k < end; ++k) set_decentral(k, {kAnywhere, {0, 0, 0}, 0, 0, 0}, 0);
    }

    void set_decentral(int k, const DecentralSector<float>& sector, float area) noexcept {
        visit_members(sector_, sector, [k](Stored& to, float from) { to.lane[k] = from; });
        arc_.angle_per_area.lane[k] = 0;
        doubled_area_.lane[k] = area;
    }
    void set_central(int k, bool mask, const Vec3<float>& begin, const Vec3<float>& chord,
                     float angle_per_area, float area) noexcept {
        if (!mask) return;
        set_decentral(k, {begin, chord, 0, 0, det(xy(begin), xy(chord))}, area);
        arc_.angle_per_area.lane[k] = angle_per_area;
    }
    float complete(bool central) noexcept {
        clear(K, kLanes);
        using P = Pack<float, kLanes>;
        DecentralSector<P> sector;
        visit_members(sector, sector_, [](P& to, const Stored& from) { to = P::load(from.lane); });
        if (central)
            store(arc_, arc_of(sector.begin, sector.chord, P::load(arc_.angle_per_area.lane)));
        else
            store_followers(sector, sector.planes());
        return sum_areas(kLanes);
    }

    /// Sets all sectors as decentral ones.
    /// \param present whether a lane has a sector.
    /// \returns twice their area
    template <int L>
    float set_all_decentral(const DecentralSector<Pack<float, L>>& sector,
                            const Mask<float, L>& present) noexcept {
        using P = Pack<float, L>;
        const SectorPlanes<P> planes = sector.planes();
        const P area = sector.template doubled_area_to<Angles>(P(1), planes);
        select(present & is_finite(area), area, P(0)).store(doubled_area_.lane);
        store(sector_, sector);
        store_followers(sector, planes);
        arc_.angle_per_area = {};
        clear(L, K);
        return sum_areas(L);
    }
    /// Sets all sectors as central ones.
    template <int L>
    float set_all_central(const Vec3<Pack<float, L>>& begin, const Vec3<Pack<float, L>>& chord,
                          const Pack<float, L>& angle_per_area, const Pack<float, L>& area) noexcept {
        visit_members(sector_.begin, begin,
                      [](Stored& to, const Pack<float, L>& from) { from.store(to.lane); });
        visit_members(sector_.chord, chord,
                      [](Stored& to, const Pack<float, L>& from) { from.store(to.lane); });
        sector_.begin_gap = sector_.end_gap = sector_.doubled_triangle = {};
        store(arc_, arc_of(begin, chord, angle_per_area));
        area.store(doubled_area_.lane);
        clear(L, K);
        return sum_areas(L);
    }

    DecentralSector<float> sector(int k) const noexcept {
        DecentralSector<float> result = read<DecentralSector<float>>(sector_, k);
        result.doubled_triangle = det(xy(result.begin), xy(result.chord));
        return result;
    }
    float doubled_area(int k) const noexcept { return doubled_area_.lane[k]; }
    float angle_per_area(int k) const noexcept { return arc_.angle_per_area.lane[k]; }

    Selection select_sector(float u, float doubled_total) const noexcept {
        using P = Pack<float, kLanes>;
        // Sectors begin in order; those without light begin nowhere.
        const std::uint32_t reached = (P::load(before_.lane) <= P(u * doubled_total)).bits();
        int index = 0;
        for (int step = kLanes / 2; step > 0; step /= 2)
            if (reached >> (index + step) != 0) index += step;
        const float area = doubled_area_.lane[index];
        return {index, area, min(max(fma(u, doubled_total, -before_.lane[index]), 0.0f), area)};
    }

    EdgeCircle<float> central(const Selection& s) const noexcept {
        return read<EdgeCircle<float>>(arc_, s.index);
    }
    PreparedSector<float> decentral(const Selection& s) const noexcept {
        return {read<DecentralSector<float>>(sector_, s.index), read<SectorPlanes<float>>(planes_, s.index),
                read<SectorQuads<float>>(quads_, s.index)};
    }

private:
    template <template <class> class Record, int L>
    static void store(Record<Stored>& to, const Record<Pack<float, L>>& from) noexcept {
        visit_members(to, from, [](Stored& lanes, const Pack<float, L>& pack) { pack.store(lanes.lane); });
    }
    template <class Record, class From>
    static Record read(const From& from, int k) noexcept {
        Record result;
        visit_members(result, from, [k](float& to, const Stored& lanes) { to = lanes.lane[k]; });
        return result;
    }

    template <int L>
    void store_followers(const DecentralSector<Pack<float, L>>& sector,
                         const SectorPlanes<Pack<float, L>>& planes) noexcept {
        store(planes_, planes);
        store(quads_, sector.quads());
    }

    float sum_areas(int count) noexcept {
        float total = 0;
        for (int k = 0; k < kLanes; ++k) {
            const float area = k < count ? doubled_area_.lane[k] : 0;
            before_.lane[k] = area > 0 ? total : std::numeric_limits<float>::infinity();
            doubled_area_.lane[k] = area;
            total += area;
        }
        return total;
    }

    DecentralSector<Stored> sector_;
    SectorPlanes<Stored> planes_; ///< decentral case only, like the quads
    SectorQuads<Stored> quads_;
    EdgeCircle<Stored> arc_; ///< central case only
    Stored doubled_area_;    ///< 0 for those without light
    Stored before_;          ///< twice the area of the sectors before; infinite for those without light
};
#endif

NUSSELT_NAMESPACE_END
