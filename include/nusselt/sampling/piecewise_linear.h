#pragma once
/// A piecewise linear density on the unit interval, and its inverse distribution.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Nodes where the density is given, at least 2. They are closer to each other near both ends.
template <class Real, int Nodes>
class PiecewiseLinear {
    static_assert(Nodes >= 2, "a segment has two ends");

public:
    static constexpr int kNodes = Nodes;

    /// The position of node i, in [0, 1].
    static constexpr scalar_t<Real> node(int i) noexcept {
        using T = scalar_t<Real>;
        const T t = static_cast<T>(i) / static_cast<T>(Nodes - 1);
        return t * t * (3 - 2 * t);
    }

    PiecewiseLinear() = default;

    /// \param value at the nodes, not negative, not normalised.
    NUSSELT_HD explicit PiecewiseLinear(const Real (&value)[Nodes]) noexcept {
        below_[0] = Real(0);
        NUSSELT_UNROLL
        for (int i = 0; i < Nodes; ++i) {
            value_[i] = value[i];
            if (i > 0) {
                const Real area = Real((node(i) - node(i - 1)) / 2) * (value[i - 1] + value[i]);
                below_[i] = below_[i - 1] + area;
            }
        }
    }

    template <class Single>
    NUSSELT_HD explicit PiecewiseLinear(const PiecewiseLinear<Single, Nodes>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// The integral over [0, 1].
    NUSSELT_HD const Real& integral() const noexcept { return below_[Nodes - 1]; }

    /// \param u in [0, 1)
    /// \return x in [0, 1] with below(x) = u integral(), increasing with u.
    NUSSELT_HD Real invert(const Real& u) const noexcept {
        const Real target = u * integral();
        const Segment s = segment([&](int i) { return target >= below_[i]; });
        const Real rest = max(target - s.below, Real(0)) / s.width;
        const Real root = sqrt(max(fma(Real(2) * (s.right - s.left), rest, s.left * s.left), Real(0)));
        const Real denominator = s.left + root;
        const Real share = Real(2) * rest / select(denominator > Real(0), denominator, Real(1));
        return fma(min(share, Real(1)), s.width, s.begin);
    }

    /// \param x in [0, 1]
    NUSSELT_HD Real value(const Real& x) const noexcept {
        const Segment s = segment_at(x);
        return fma((x - s.begin) / s.width, s.right - s.left, s.left);
    }

    /// The integral from 0 to x in [0, 1].
    NUSSELT_HD Real below(const Real& x) const noexcept {
        const Segment s = segment_at(x);
        const Real share = (x - s.begin) / s.width;
        return fma(s.width * share, fma(Real(0.5) * share, s.right - s.left, s.left), s.below);
    }

private:
    struct Segment {
        Real begin, width, left, right, below;
    };

    /// The last segment for whose begin the predicate holds.
    template <class Reaches>
    NUSSELT_HD Segment segment(const Reaches& reaches) const noexcept {
        Segment s{Real(0), Real(node(1)), value_[0], value_[1], Real(0)};
        NUSSELT_UNROLL
        for (int i = 1; i < Nodes - 1; ++i) {
            const auto inside = reaches(i);
            s.begin = select(inside, Real(node(i)), s.begin);
            s.width = select(inside, Real(node(i + 1) - node(i)), s.width);
            s.left = select(inside, value_[i], s.left);
            s.right = select(inside, value_[i + 1], s.right);
            s.below = select(inside, below_[i], s.below);
        }
        return s;
    }
    NUSSELT_HD Segment segment_at(const Real& x) const noexcept {
        return segment([&](int i) { return x >= Real(node(i)); });
    }

    Real value_[Nodes];
    Real below_[Nodes]; ///< integral from 0 to the node

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.value_, self.below_);
    }
};

NUSSELT_NAMESPACE_END
