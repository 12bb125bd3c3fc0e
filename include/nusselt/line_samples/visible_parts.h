#pragma once
/// What remains visible of lines while occluders are found one after the other.

#include <nusselt/line_samples/line_family.h>

NUSSELT_NAMESPACE_BEGIN

/// Gaps between shadows shorter than this share of the line are rounding.
template <class Scalar>
inline constexpr Scalar kShortestPart = Scalar(1e-6);

/// Disjoint parts of lines, in memory of the caller.
/// \tparam Real a line per lane.
template <class Real>
class VisibleParts {
public:
    /// \param storage  for `capacity` intervals, which outlives this object.
    /// \param capacity at least 1. Parts of a line beyond that many are merged with what hides them in between.
    NUSSELT_HD VisibleParts(Interval<Real>* storage, int capacity) noexcept
        : part_(storage), capacity_(capacity) {}

    /// Back to whole lines.
    NUSSELT_HD void reset(const Interval<Real>& whole) noexcept {
        part_[0] = whole;
        count_ = 1;
        shortest_ = Real(kShortestPart<scalar_t<Real>>) * (whole.end - whole.begin);
    }

    /// Slots in use, some of which may be empty in some lanes.
    NUSSELT_HD int count() const noexcept { return count_; }

    /// In no order. Empty where begin >= end.
    NUSSELT_HD const Interval<Real>& operator[](int slot) const noexcept { return part_[slot]; }

    /// Lanes in which anything is visible.
    NUSSELT_HD mask_t<Real> lit() const noexcept {
        auto lit = mask_t<Real>(false);
        for (int k = 0; k < count_; ++k) lit = lit | (part_[k].begin < part_[k].end);
        return lit;
    }

    /// Takes away what an occluder hides.
    NUSSELT_HD void cut(const Interval<Real>& hidden) noexcept {
        for (int k = count_ - 1; k >= 0; --k) {
            const Interval<Real> part = part_[k];
            const auto overlaps =
                (hidden.begin < hidden.end) & (hidden.begin < part.end) & (hidden.end > part.begin);
            if (!any(overlaps)) continue;
            const auto has_left = hidden.begin - part.begin > shortest_;
            const auto has_right = part.end - hidden.end > shortest_;
            auto splits = overlaps & has_left & has_right;
            if (any(splits)) splits = splits & !add({hidden.end, part.end}, splits);
            // What found no room keeps its shadow.
            const auto shrinks = overlaps & !splits;
            part_[k].end = select(shrinks & has_left, hidden.begin, part.end);
            const Real begin = select(has_right, hidden.end, part.end);
            part_[k].begin = select(shrinks & !has_left, begin, part.begin);
        }
    }

private:
    /// Stores another part of some lanes. \returns those for which there was no room
    NUSSELT_HD mask_t<Real> add(const Interval<Real>& part, mask_t<Real> lanes) noexcept {
        for (int k = 0; any(lanes); ++k) {
            if (k == count_) {
                if (count_ == capacity_) break;
                part_[count_++] = {Real(0), Real(0)};
            }
            const auto fits = lanes & !(part_[k].begin < part_[k].end);
            part_[k] = {select(fits, part.begin, part_[k].begin), select(fits, part.end, part_[k].end)};
            lanes = lanes & !fits;
        }
        return lanes;
    }

    Interval<Real>* part_;
    int capacity_;
    int count_ = 0;
    Real shortest_ = Real(0);
};

NUSSELT_NAMESPACE_END
