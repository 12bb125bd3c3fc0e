#pragma once
/// Sampling of the part of any elliptic cone above the horizon in proportion to the cosine at the surface.

#include <nusselt/cones/cone_sweep.h>
#include <nusselt/cones/whole_cone.h>

NUSSELT_NAMESPACE_BEGIN

/// The part of an elliptic cone above the horizon, whether or not the horizon cuts it.
/// \tparam Steps  of the iteration for cones above the horizon.
/// \tparam Places of the rim of a cone that the horizon cuts, kConePlaces or kFineConePlaces.
template <class Real, int Steps, int Places>
class CosineCone {
public:
    CosineCone() = default;

    NUSSELT_HD explicit CosineCone(const EllipticCone<Real>& cone) noexcept
        : is_whole_(is_above_horizon(cone)), whole_(cone), sweep_() {
        // The sweep is costly to prepare, and seldom needed.
        if (any(!is_whole_)) sweep_ = ConeSweep<Real, Places>(cone);
    }

    template <class Single>
    NUSSELT_HD explicit CosineCone(const CosineCone<Single, Steps, Places>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    NUSSELT_HD ConeSample<Real> sample(const Vec2<Real>& u) const noexcept {
        if (all(is_whole_)) return whole_.sample(u);
        const ConeSample<Real> cut = sweep_.sample(u);
        if (!any(is_whole_)) return cut;
        const ConeSample<Real> whole = whole_.sample(u);
        return {select(is_whole_, whole.wi, cut.wi), select(is_whole_, whole.disk, cut.disk)};
    }
    /// The density of a unit direction in the cone over its cosine, wi.z [1/sr].
    NUSSELT_HD Real density_per_cosine(const Vec3<Real>& wi) const noexcept {
        if (all(is_whole_)) return whole_.density_per_cosine();
        return select(is_whole_, whole_.density_per_cosine(), sweep_.density_per_cosine(wi));
    }
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        if (all(is_whole_)) return whole_.invert(wi);
        return select(is_whole_, whole_.invert(wi), sweep_.invert(wi));
    }
    NUSSELT_HD Real measure() const noexcept {
        if (all(is_whole_)) return whole_.measure();
        return select(is_whole_, whole_.measure(), sweep_.measure());
    }

private:
    mask_t<Real> is_whole_;
    WholeCone<Real, Steps> whole_;
    ConeSweep<Real, Places> sweep_; ///< only where the horizon cuts a cone in any lane

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.is_whole_, self.whole_, self.sweep_);
    }
};

/// Steps that make the backward error one of rounding.
template <class Real>
inline constexpr int kConeSteps = kIsSingle<Real> ? 2 : 3;

NUSSELT_NAMESPACE_END
