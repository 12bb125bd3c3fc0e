#pragma once
/// The parts of lines that remain visible while occluders are found one after the other.

#include <nusselt/line_samples/line_family.h>

NUSSELT_NAMESPACE_BEGIN

/// Gaps between shadows shorter than this share of the line are rounding: those of meshes whose neighbours do not share
/// all corners. So each occluder may hide that share too much, which is far below what rounding moves shadows by anyway.
template <class Scalar>
inline constexpr Scalar kShortestPart = Scalar(1e-6);

/// Disjoint parts of lines, in memory of the caller.
/// \tparam Real a line per lane.
template <class Real>
class VisibleParts {
public:
    /// An object without storage, to be assigned to before it is used.
    VisibleParts() noexcept = default;

    /// \param storage  for `capacity` intervals, which outlives this object.
    /// \param capacity at least 1. Of a line that falls into more parts, each further cut drops the shorter remainder of
    ///                 what it splits: results are much too dark where that happens often, check lost().
    NUSSELT_HD VisibleParts(Interval<Real>* storage, int capacity) noexcept
        : part_(storage), capacity_(capacity) {}

    /// Goes back to whole lines. It is empty where begin >= end (or NaN).
    NUSSELT_HD void reset(const Interval<Real>& whole) noexcept {
        const auto lit = whole.begin < whole.end;
        const Interval<Real> none = empty_interval<Real>();
        bounds_ = {select(lit, whole.begin, none.begin), select(lit, whole.end, none.end)};
        part_[0] = bounds_;
        count_ = 1;
        lost_ = Real(0);
        shortest_ = Real(kShortestPart<scalar_t<Real>>) * select(lit, whole.end - whole.begin, Real(0));
    }

    /// Slots in use, some of which may be empty in some lanes.
    NUSSELT_HD int count() const noexcept { return count_; }

    /// Part `slot`, in no order; empty where begin >= end.
    NUSSELT_HD const Interval<Real>& operator[](int slot) const noexcept { return part_[slot]; }

    /// The least interval that has all parts of a line; empty where begin >= end.
    NUSSELT_HD const Interval<Real>& bounds() const noexcept { return bounds_; }

    /// Lanes in which anything is visible.
    NUSSELT_HD mask_t<Real> lit() const noexcept { return bounds_.begin < bounds_.end; }

    /// Lanes in which something between begin and end is visible.
    NUSSELT_HD mask_t<Real> overlap(const Interval<Real>& interval) const noexcept {
        auto result = mask_t<Real>(false);
        for (int k = 0; k < count_; ++k)
            result = result | ((interval.begin < part_[k].end) & (interval.end > part_[k].begin));
        return result;
    }

    /// The number of parts that were taken for hidden since there was no room for them.
    NUSSELT_HD const Real& lost() const noexcept { return lost_; }

    /// Takes away what an occluder hides. Where begin >= end (or NaN) it hides nothing.
    NUSSELT_HD void cut(const Interval<Real>& hidden) noexcept {
        const auto hides = hidden.begin < hidden.end;
        if (!any(hides & (hidden.begin < bounds_.end) & (hidden.end > bounds_.begin))) return;
        const Interval<Real> none = empty_interval<Real>();
        Interval<Real> bounds = none;
        for (int k = count_ - 1; k >= 0; --k) {
            Interval<Real> part = part_[k];
            const auto overlaps = hides & (hidden.begin < part.end) & (hidden.end > part.begin);
            if (any(overlaps)) {
                const auto keeps_left = hidden.begin - part.begin > shortest_;
                const auto keeps_right = part.end - hidden.end > shortest_;
                const auto splits = overlaps & keeps_left & keeps_right;
                mask_t<Real> starts_later = overlaps & !keeps_left;
                if (any(splits)) {
                    const auto no_room = add({hidden.end, part.end}, splits);
                    bounds.end = max(bounds.end, select(splits & !no_room, part.end, none.end));
                    const auto right_is_longer = part.end - hidden.end > hidden.begin - part.begin;
                    starts_later = starts_later | (no_room & right_is_longer);
                }
                const auto shortens = overlaps & !starts_later;
                part.end = select(shortens, hidden.begin, part.end);
                part.begin = select(starts_later, hidden.end, part.begin);
                const auto ends = starts_later & !keeps_right;
                part = {select(ends, none.begin, part.begin), select(ends, none.end, part.end)};
                part_[k] = part;
            }
            bounds = {min(bounds.begin, part.begin), max(bounds.end, part.end)};
        }
        bounds_ = bounds;
        while (count_ > 0 && !any(part_[count_ - 1].begin < part_[count_ - 1].end)) --count_;
    }

private:
    /// Stores another part of some lanes.
    /// \returns lanes that have no room for it
    NUSSELT_HD mask_t<Real> add(const Interval<Real>& part, mask_t<Real> lanes) noexcept {
        for (int k = 0; any(lanes); ++k) {
            if (k == count_) {
                if (count_ == capacity_) break;
                part_[count_++] = empty_interval<Real>();
            }
            const auto fits = lanes & !(part_[k].begin < part_[k].end);
            part_[k] = {select(fits, part.begin, part_[k].begin), select(fits, part.end, part_[k].end)};
            lanes = lanes & !fits;
        }
        lost_ = lost_ + select(lanes, Real(1), Real(0));
        return lanes;
    }

    Interval<Real>* part_ = nullptr;
    int capacity_ = 0;
    int count_ = 0;
    Real shortest_ = Real(0);
    Real lost_ = Real(0);
    Interval<Real> bounds_ = empty_interval<Real>();
};

NUSSELT_NAMESPACE_END
