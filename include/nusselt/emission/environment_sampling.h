#pragma once
/// Sampling of environment maps in proportion to radiance times the cosine at the surface, or times a glossy lobe.
///
/// A lattice of cells is chosen from in proportion to mean radiance times the mean cosine or lobe, which is estimated
/// from the mean and the variance of the directions that the radiance of a cell comes from. Samples descend grids with
/// the same product, and take a point in a texel in proportion to interpolated radiance.
/// docs/techniques/environment_map.md derives it.

#include <nusselt/core/frame.h>
#include <nusselt/emission/cell_sums.h>
#include <nusselt/emission/environment_map.h>
#include <nusselt/emission/smooth_clamp.h>
#include <nusselt/ltc/ltc.h>

NUSSELT_NAMESPACE_BEGIN

/// Diffuse surfaces: the cosine. Samples are above the horizon.
template <class T>
struct CosineFactor {
    static constexpr T kPerAlbedo = 1 / kPi<T>; ///< reflected radiance over measure

    /// The factor for directions in the space of the map.
    class InMap {
    public:
        NUSSELT_HD InMap(const CosineFactor&, const Frame<T>& frame) noexcept : normal_(frame.n) {}

        /// About the mean over directions with this mean and variance per axis.
        template <class Real>
        NUSSELT_INLINE Real mean(const Vec3<Real>& direction, const Real& variance) const noexcept {
            return smooth_clamp(dot(broadcast<Real>(normal_), direction), variance);
        }

    private:
        Vec3<T> normal_;
    };

    NUSSELT_HD bool counts(const Vec3<T>& wi) const noexcept { return wi.z > T(0); }
};

/// Glossy surfaces: the density of a lobe. Samples may lie below the surface, as those of PolygonLtc.
template <class T>
struct LobeFactor {
    static constexpr T kPerAlbedo = 1; ///< \copydoc CosineFactor::kPerAlbedo
    Ltc<T> ltc;

    /// \copydoc CosineFactor::InMap
    class InMap {
    public:
        NUSSELT_HD InMap(const LobeFactor& factor, const Frame<T>& frame) noexcept {
            const auto column = [&](const Vec3<T>& axis) { return factor.ltc.to_cosine(axis); };
            column_x_ = column(frame.to_local({T(1), T(0), T(0)}));
            column_y_ = column(frame.to_local({T(0), T(1), T(0)}));
            column_z_ = column(frame.to_local({T(0), T(0), T(1)}));
            const Vec3<T> height{column_x_.z, column_y_.z, column_z_.z};
            height_spread_ = dot(height, height);
            minor_ = factor.ltc.minor();
            // In the plane of the normal and wo, the matrix has two columns. Across, it has one number.
            const Vec3<T> tangent = column({T(1), T(0), T(0)});
            const Vec3<T> normal = column({T(0), T(0), T(1)});
            const T across = column({T(0), T(1), T(0)}).y;
            lateral_ = across * T(1 / kPi<T>);
            const T in_plane = dot(tangent, tangent) + dot(normal, normal);
            spread_ = in_plane + across * across;
            // The squared length of the shortest image of a unit vector, where the density is largest.
            const T root = sqrt(max(in_plane * in_plane - T(4) * minor_ * minor_, T(0)));
            const T shortest = min(T(2) * minor_ * minor_ / (in_plane + root), across * across);
            growth_ = max(spread_ / max(shortest, kTiny<T>) - T(3), T(0));
        }

        /// The density of the lobe in the mean direction, widened by the variance, with the same integral: the area of
        /// a narrow lobe grows with the variance, and a Lambertian lobe remains.
        template <class Real>
        NUSSELT_INLINE Real mean(const Vec3<Real>& direction, const Real& variance) const noexcept {
            const auto row = [&](const T& x, const T& y, const T& z) {
                return multiply_add(Real(x), direction.x,
                                    multiply_add(Real(y), direction.y, Real(z) * direction.z));
            };
            const Vec3<Real> o{row(column_x_.x, column_y_.x, column_z_.x),
                               row(column_x_.y, column_y_.y, column_z_.y),
                               row(column_x_.z, column_y_.z, column_z_.z)};
            const Real inverse = Real(1) / multiply_add(variance, Real(spread_), dot(o, o));
            const Real height = smooth_clamp(o.z, Real(height_spread_) * variance) *
                                multiply_add(variance, Real(growth_), Real(T(1)));
            // Each factor is in the range of float, also for narrow lobes.
            return (Real(minor_) * inverse) * (Real(lateral_) * (height * inverse));
        }

    private:
        // cosine_from_map, scaled like the matrix of the lobe.
        Vec3<T> column_x_, column_y_, column_z_;
        T height_spread_;   ///< squared norm of its last row
        T spread_;          ///< squared norm of all of it
        T growth_;          ///< of the area of the lobe per variance
        T minor_, lateral_; ///< their product is its determinant over pi
    };

    NUSSELT_HD bool counts(const Vec3<T>&) const noexcept { return true; }
};

/// \tparam T      float, double or long double. One shading point at a time: cells are lanes.
/// \tparam n      columns and rows of the lattice, 8 or 16.
/// \tparam Factor CosineFactor or LobeFactor.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space; the normal is +z. For a lobe, wo is in the xz half-plane.
/// Edge cases: black maps: pdf = 0, measure 0. Each direction that the map lights and that counts has a positive
/// density, unless its radiance is below 1e-38 (float) of the largest. Few samples end below the horizon, with pdf = 0;
/// densities above it integrate to the share of the others.
/// Cost: preparing takes a root and two divisions per cell; a sample takes four roots per grid.
template <class T, int n = 16, class Factor = CosineFactor<T>>
class EnvironmentSampler {
public:
    using Map = EnvironmentMap<T, n>;
    /// Where p is on rays to the environment [m]: its square is in the range of float.
    static constexpr T kDistance = power_of_two<T>(60);

    /// \param map    has to live as long as this.
    /// \param frame  of the shading point, in the space of the map.
    /// \param factor with the lobe, if there is one.
    NUSSELT_HD EnvironmentSampler(const Map& map, const Frame<T>& frame, const Factor& factor = {}) noexcept
        : map_(&map), frame_(frame), factor_(factor), in_map_(factor, frame) {
        using Lanes = detail::CellLanes<T>;
        using L = typename Lanes::Type;
        Vec3<L> expected{L(T(0)), L(T(0)), L(T(0))};
        for (int cell = 0; cell < Map::kCells; cell += Lanes::kCount) {
            const Vec3<L> direction{Lanes::load(map.direction[0] + cell),
                                    Lanes::load(map.direction[1] + cell),
                                    Lanes::load(map.direction[2] + cell)};
            const L mean = in_map_.mean(direction, map.variance_of(direction));
            sums_.add(cell, Lanes::load(map.weight + cell) * mean);
            const auto radiance = [&](int channel) { return Lanes::load(map.mean[channel] + cell); };
            expected.x = multiply_add(radiance(0), mean, expected.x);
            expected.y = multiply_add(radiance(1), mean, expected.y);
            expected.z = multiply_add(radiance(2), mean, expected.z);
        }
        sums_.finish();
        unshadowed_ = {Lanes::sum(expected.x), Lanes::sum(expected.y), Lanes::sum(expected.z)};
    }

    /// \param u in [0, 1)^2; x chooses along the x axis of the map, y along its y axis: some stratification survives.
    /// \return p is wi times kDistance, `at` the point of the map: look up the radiance there.
    NUSSELT_HD TexturedSample<T> sample(const Vec2<T>& u) const noexcept {
        if (!(sums_.total() > T(0))) return none();
        const CellChoice<T> cell = sums_.choose(u);
        const TexelChoice<T> texel =
            detail::descend(map_->shape, cell.column, cell.row, cell.u,
                            [&](int level, int i, int j) { return parts_of(level, i, j); });
        const detail::BilinearTexel<T> interpolant = map_->texel_at(texel.i, texel.j);
        const Vec2<T> inside = interpolant.sample(texel.u);
        const Vec2<T> at{position(texel.i, inside.x), position(texel.j, inside.y)};
        const Vec3<T> wi = frame_.to_local(octahedral_direction(at));
        return {
            {wi, density(cell.probability * texel.probability, texel, interpolant, at, wi), kDistance * wi},
            at};
    }

    /// \param wi unit.
    NUSSELT_HD T pdf(const Vec3<T>& wi) const noexcept {
        return density_at(octahedral_coordinates(frame_.to_world(wi)), wi);
    }

    /// The density of the direction of a point of the map [1/sr].
    /// \param at in [0, 1)^2.
    NUSSELT_HD T pdf_at(const Vec2<T>& at) const noexcept {
        return density_at(at, frame_.to_local(octahedral_direction(at)));
    }

    /// The random numbers for which sample() returns wi, a unit direction.
    NUSSELT_HD Vec2<T> invert(const Vec3<T>& wi) const noexcept {
        if (!(sums_.total() > T(0))) return {T(0), T(0)};
        const Vec2<T> at = octahedral_coordinates(frame_.to_world(wi));
        TexelChoice<T> texel = texel_at(at);
        texel.u = map_->texel_at(texel.i, texel.j).invert(inside_of(texel, at));
        const CellChoice<T> cell = sums_.at(at);
        return sums_.unite(cell.column, cell.row, ascend(texel).u);
    }

    /// An estimate of the integral of radiance, averaged over channels, times the cosine [W/m^2] or the density of the
    /// lobe [W/(sr m^2)]: the sum over cells of mean radiance times solid angle times the estimated mean of the factor.
    /// Of the cosine, cells well above the horizon have the exact mean, those at the horizon up to 12 % more, and
    /// something remains of those below it. Lobes narrower than a cell may be off by a factor of two.
    NUSSELT_HD T measure() const noexcept { return Map::kCellAngle * (sums_.total() / map_->scale); }

    /// The radiance that is reflected without shadows per albedo of the component, per channel [W/(sr m^2)]: the
    /// coefficient of heuristics for multiple importance sampling (estimate/mis.h), an estimate as measure().
    NUSSELT_HD Vec3<T> unshadowed() const noexcept {
        return (Factor::kPerAlbedo * Map::kCellAngle) * unshadowed_;
    }

private:
    NUSSELT_HD static TexturedSample<T> none() noexcept {
        const Vec3<T> up{T(0), T(0), T(1)};
        return {{up, T(0), up}, {T(0), T(0)}};
    }

    /// The parts of an element with the weights to choose from. Neighbouring texels have nearly the same factor.
    NUSSELT_HD detail::ElementParts<T> parts_of(int level, int i, int j) const noexcept {
        if (level == 1) {
            const T* const weight = map_->texel_weights + map_->texel_index(i, j);
            return {2, 2, {weight[0], weight[1], weight[2], weight[3]}};
        }
        const T* const part = map_->elements + map_->element_index(level, i, j);
        detail::ElementParts<T> parts{2, 2, {}};
        for (int k = 0; k < 4; ++k) {
            const Vec3<T> direction{part[4 + k], part[8 + k], part[12 + k]};
            parts.weight[k] = part[k] * in_map_.mean(direction, map_->variance_of(direction));
        }
        return parts;
    }

    NUSSELT_HD TexelChoice<T> ascend(const TexelChoice<T>& texel) const noexcept {
        return detail::ascend(map_->shape, texel,
                              [&](int level, int i, int j) { return parts_of(level, i, j); });
    }

    NUSSELT_HD TexelChoice<T> texel_at(const Vec2<T>& at) const noexcept {
        const int size = map_->radiance.size;
        const auto index = [&](const T& x) {
            return detail::clamp_index(static_cast<int>(x * static_cast<T>(size)), size);
        };
        return {index(at.x), index(at.y), T(1), {T(0), T(0)}};
    }

    /// The coordinate of a point of texel i. It never rounds to the next texel.
    NUSSELT_HD T position(int i, const T& inside) const noexcept {
        constexpr T kBelowOne = 1 - std::numeric_limits<T>::epsilon() / 2;
        const T step = T(1) / static_cast<T>(map_->radiance.size);
        return min((static_cast<T>(i) + inside) * step, kBelowOne * (static_cast<T>(i + 1) * step));
    }
    NUSSELT_HD Vec2<T> inside_of(const TexelChoice<T>& texel, const Vec2<T>& at) const noexcept {
        const auto size = static_cast<T>(map_->radiance.size);
        return {at.x * size - static_cast<T>(texel.i), at.y * size - static_cast<T>(texel.j)};
    }

    NUSSELT_HD T density_at(const Vec2<T>& at, const Vec3<T>& wi) const noexcept {
        if (!(sums_.total() > T(0))) return T(0);
        const CellChoice<T> cell = sums_.at(at);
        const TexelChoice<T> texel = texel_at(at);
        if (!(cell.probability > T(0)) || !(map_->texel_weight(texel.i, texel.j) > T(0))) return T(0);
        return density(cell.probability * ascend(texel).probability, texel, map_->texel_at(texel.i, texel.j),
                       at, wi);
    }

    /// The density of a point in a texel with this probability.
    NUSSELT_HD T density(const T& probability, const TexelChoice<T>& texel,
                         const detail::BilinearTexel<T>& interpolant, const Vec2<T>& at,
                         const Vec3<T>& wi) const noexcept {
        const T mean = map_->texel_weight(texel.i, texel.j);
        if (!(mean > T(0)) || !factor_.counts(wi)) return T(0);
        const auto size = static_cast<T>(map_->radiance.size);
        const T share = map_->scale * interpolant.at(inside_of(texel, at)) / mean;
        return probability * share * (size * size / (4 * kPi<T>));
    }

    const Map* map_;
    Frame<T> frame_;
    Factor factor_;
    typename Factor::InMap in_map_;
    CellSums<T, n> sums_;
    Vec3<T> unshadowed_; ///< sum over cells of mean radiance times the mean factor
};

/// For diffuse surfaces.
template <class T, int n = 16>
using EnvironmentCosine = EnvironmentSampler<T, n, CosineFactor<T>>;

/// For glossy surfaces.
template <class T, int n = 16>
using EnvironmentLtc = EnvironmentSampler<T, n, LobeFactor<T>>;

NUSSELT_NAMESPACE_END
