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
template <class Real>
struct CosineFactor {
    static constexpr scalar_t<Real> kPerAlbedo = 1 / kPi<scalar_t<Real>>; ///< reflected radiance over measure

    /// The factor for directions in the space of the map.
    class InMap {
    public:
        NUSSELT_HD InMap(const CosineFactor&, const Frame<Real>& frame) noexcept : normal_(frame.n) {}

        /// About the mean over directions with this mean and variance per axis.
        /// \tparam L Real, or a pack of directions for one surface.
        template <class L>
        NUSSELT_INLINE L mean(const Vec3<L>& direction, const L& variance) const noexcept {
            return smooth_clamp(dot(broadcast<L>(normal_), direction), variance);
        }

    private:
        Vec3<Real> normal_;
    };

    NUSSELT_HD mask_t<Real> counts(const Vec3<Real>& wi) const noexcept { return wi.z > Real(0); }
};

/// Glossy surfaces: the density of a lobe. Samples may lie below the surface, as those of PolygonLtc.
template <class Real>
struct LobeFactor {
    using T = scalar_t<Real>;
    static constexpr T kPerAlbedo = 1; ///< \copydoc CosineFactor::kPerAlbedo
    Ltc<Real> ltc;

    /// \copydoc CosineFactor::InMap
    class InMap {
    public:
        NUSSELT_HD InMap(const LobeFactor& factor, const Frame<Real>& frame) noexcept {
            const Real zero = Real(0), one = Real(1);
            const auto column = [&](const Vec3<Real>& axis) { return factor.ltc.to_cosine(axis); };
            column_x_ = column(frame.to_local({one, zero, zero}));
            column_y_ = column(frame.to_local({zero, one, zero}));
            column_z_ = column(frame.to_local({zero, zero, one}));
            const Vec3<Real> height{column_x_.z, column_y_.z, column_z_.z};
            height_spread_ = dot(height, height);
            minor_ = factor.ltc.minor();
            // In the plane of the normal and wo, the matrix has two columns. Across, it has one number.
            const Vec3<Real> tangent = column({one, zero, zero});
            const Vec3<Real> normal = column({zero, zero, one});
            const Real across = column({zero, one, zero}).y;
            lateral_ = across * Real(T(1 / kPi<T>));
            const Real in_plane = dot(tangent, tangent) + dot(normal, normal);
            spread_ = in_plane + across * across;
            // The squared length of the shortest image of a unit vector, where the density is largest.
            const Real root = sqrt(max(in_plane * in_plane - Real(4) * minor_ * minor_, zero));
            const Real shortest = min(Real(2) * minor_ * minor_ / (in_plane + root), across * across);
            growth_ = max(spread_ / max(shortest, Real(kTiny<T>)) - Real(3), zero);
        }

        /// The density of the lobe in the mean direction, widened by the variance, with the same integral: the area of
        /// a narrow lobe grows with the variance, and a Lambertian lobe remains.
        /// \tparam L Real, or a pack of directions for one surface.
        template <class L>
        NUSSELT_INLINE L mean(const Vec3<L>& direction, const L& variance) const noexcept {
            const auto row = [&](const Real& x, const Real& y, const Real& z) {
                return multiply_add(L(x), direction.x, multiply_add(L(y), direction.y, L(z) * direction.z));
            };
            const Vec3<L> o{row(column_x_.x, column_y_.x, column_z_.x),
                            row(column_x_.y, column_y_.y, column_z_.y),
                            row(column_x_.z, column_y_.z, column_z_.z)};
            const L inverse = L(T(1)) / multiply_add(variance, L(spread_), dot(o, o));
            const L height =
                smooth_clamp(o.z, L(height_spread_) * variance) * multiply_add(variance, L(growth_), L(T(1)));
            // Each factor is in the range of float, also for narrow lobes.
            return (L(minor_) * inverse) * (L(lateral_) * (height * inverse));
        }

    private:
        // cosine_from_map, scaled like the matrix of the lobe.
        Vec3<Real> column_x_, column_y_, column_z_;
        Real height_spread_;   ///< squared norm of its last row
        Real spread_;          ///< squared norm of all of it
        Real growth_;          ///< of the area of the lobe per variance
        Real minor_, lateral_; ///< their product is its determinant over pi
    };

    NUSSELT_HD mask_t<Real> counts(const Vec3<Real>&) const noexcept { return mask_t<Real>(true); }
};

/// \tparam Real   float, double, long double, or a pack with a shading point per lane.
/// \tparam n      columns and rows of the lattice, 8 or 16.
/// \tparam Factor CosineFactor or LobeFactor.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space; the normal is +z. For a lobe, wo is in the xz half-plane.
/// Edge cases: black maps: pdf = 0, measure 0. Each direction that the map lights and that counts has a positive
/// density, unless its radiance is below 1e-38 (float) of the largest. Few samples end below the horizon, with pdf = 0;
/// densities above it integrate to the share of the others.
/// Cost: preparing takes a root and two divisions per cell; a sample takes four roots per grid.
template <class Real, int n = 16, class Factor = CosineFactor<Real>>
class EnvironmentSampler {
    using T = scalar_t<Real>;
    using Mask = mask_t<Real>;
    using Index = detail::index_t<Real>;

public:
    using Map = EnvironmentMap<T, n>;
    /// Where p is on rays to the environment [m]: its square is in the range of float.
    static constexpr T kDistance = power_of_two<T>(60);

    /// \param map    has to live as long as this.
    /// \param frame  of the shading point, in the space of the map.
    /// \param factor with the lobe, if there is one.
    NUSSELT_HD EnvironmentSampler(const Map& map, const Frame<Real>& frame,
                                  const Factor& factor = {}) noexcept
        : map_(&map), frame_(frame), factor_(factor), in_map_(factor, frame) {
        using Lanes = detail::CellLanes<Real>;
        using L = typename Lanes::Type;
        Vec3<L> expected{L(T(0)), L(T(0)), L(T(0))};
        for (int cell = 0; cell < Map::kCells; cell += Lanes::kCount) {
            const auto of_cells = [&](const T* numbers) { return Lanes::load_shared(numbers + cell); };
            const Vec3<L> direction{of_cells(map.direction[0]), of_cells(map.direction[1]),
                                    of_cells(map.direction[2])};
            const L mean = in_map_.mean(direction, map.variance_of(direction));
            sums_.add(cell, of_cells(map.weight) * mean);
            expected.x = multiply_add(of_cells(map.mean[0]), mean, expected.x);
            expected.y = multiply_add(of_cells(map.mean[1]), mean, expected.y);
            expected.z = multiply_add(of_cells(map.mean[2]), mean, expected.z);
        }
        sums_.finish();
        unshadowed_ = {Lanes::sum(expected.x), Lanes::sum(expected.y), Lanes::sum(expected.z)};
    }

    /// \param u in [0, 1)^2; x chooses along the x axis of the map, y along its y axis: some stratification survives.
    /// \return p is wi times kDistance, `at` the point of the map: look up the radiance there.
    NUSSELT_HD TexturedSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Mask lit = sums_.total() > Real(0);
        const Vec3<Real> up{Real(0), Real(0), Real(1)};
        const Vec2<Real> corner{Real(0), Real(0)};
        if (!any(lit)) return {{up, Real(0), up}, corner};
        const CellChoice<Real> cell = sums_.choose(u);
        const TexelChoice<Real> texel =
            detail::descend(map_->shape, cell.column, cell.row, cell.u,
                            [&](int level, const Index& i, const Index& j) { return parts_of(level, i, j); });
        const detail::BilinearTexel<Real> interpolant = map_->template texel_at<Real>(texel.i, texel.j);
        const Vec2<Real> inside = interpolant.sample(texel.u);
        const Vec2<Real> at{position(texel.i, inside.x), position(texel.j, inside.y)};
        const Vec3<Real> wi = frame_.to_local(octahedral_direction(at));
        const Real pdf = density(cell.probability * texel.probability, texel, interpolant, at, wi);
        return {{select(lit, wi, up), select(lit, pdf, Real(0)), select(lit, Real(kDistance) * wi, up)},
                select(lit, at, corner)};
    }

    /// \param wi unit.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        return density_at(octahedral_coordinates(frame_.to_world(wi)), wi);
    }

    /// The density of the direction of a point of the map [1/sr].
    /// \param at in [0, 1)^2.
    NUSSELT_HD Real pdf_at(const Vec2<Real>& at) const noexcept {
        return density_at(at, frame_.to_local(octahedral_direction(at)));
    }

    /// The random numbers for which sample() returns wi, a unit direction.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Mask lit = sums_.total() > Real(0);
        const Vec2<Real> zero{Real(0), Real(0)};
        if (!any(lit)) return zero;
        const Vec2<Real> at = octahedral_coordinates(frame_.to_world(wi));
        TexelChoice<Real> texel = texel_at(at);
        texel.u = map_->template texel_at<Real>(texel.i, texel.j).invert(inside_of(texel, at));
        const CellChoice<Real> cell = sums_.at(at);
        return select(lit, sums_.unite(cell.column, cell.row, ascend(texel).u), zero);
    }

    /// An estimate of the integral of radiance, averaged over channels, times the cosine [W/m^2] or the density of the
    /// lobe [W/(sr m^2)]: the sum over cells of mean radiance times solid angle times the estimated mean of the factor.
    /// Of the cosine, cells well above the horizon have the exact mean, those at the horizon up to 12 % more, and
    /// something remains of those below it. Lobes narrower than a cell may be off by a factor of two.
    NUSSELT_HD Real measure() const noexcept {
        return Real(Map::kCellAngle) * (sums_.total() / Real(map_->scale));
    }

    /// The radiance that is reflected without shadows per albedo of the component, per channel [W/(sr m^2)]: the
    /// coefficient of heuristics for multiple importance sampling (estimate/mis.h), an estimate as measure().
    NUSSELT_HD Vec3<Real> unshadowed() const noexcept {
        return Real(Factor::kPerAlbedo * Map::kCellAngle) * unshadowed_;
    }

private:
    /// The parts of an element with the weights to choose from. Neighbouring texels have nearly the same factor.
    NUSSELT_HD detail::ElementParts<Real> parts_of(int level, const Index& i, const Index& j) const noexcept {
        const PyramidShape& shape = map_->shape;
        detail::ElementParts<Real> parts{2, 2, {}};
        if (level == 1) {
            const auto place = detail::places<Real>(Index(4) * i, j, 4 * shape.width_of(1));
            for (int k = 0; k < 4; ++k) parts.weight[k] = place.load(map_->texel_weights + k);
            return parts;
        }
        constexpr int kNumbers = Map::kPerElement;
        const auto place = detail::places<Real>(Index(kNumbers) * i, j, kNumbers * shape.width_of(level));
        const T* const element = map_->elements + kNumbers * (shape.offset[level] - shape.offset[2]);
        using Lanes = detail::CellLanes<Real>;
        if constexpr (Lanes::kArePacks) {
            // The parts as lanes.
            using L = Pack<T, 4>;
            const T* const part = element + place.lane[0];
            const Vec3<L> direction{L::load(part + 4), L::load(part + 8), L::load(part + 12)};
            (L::load(part) * in_map_.mean(direction, map_->variance_of(direction))).store(parts.weight);
        } else {
            for (int k = 0; k < 4; ++k) {
                const T* const part = element + k;
                const Vec3<Real> direction{place.load(part + 4), place.load(part + 8), place.load(part + 12)};
                parts.weight[k] = place.load(part) * in_map_.mean(direction, map_->variance_of(direction));
            }
        }
        return parts;
    }

    NUSSELT_HD TexelChoice<Real> ascend(const TexelChoice<Real>& texel) const noexcept {
        return detail::ascend(map_->shape, texel, [&](int level, const Index& i, const Index& j) {
            return parts_of(level, i, j);
        });
    }

    NUSSELT_HD TexelChoice<Real> texel_at(const Vec2<Real>& at) const noexcept {
        const int size = map_->radiance.size;
        return {detail::index_below<Real>(at.x * Real(static_cast<T>(size)), size),
                detail::index_below<Real>(at.y * Real(static_cast<T>(size)), size),
                Real(1),
                {Real(0), Real(0)}};
    }

    /// The weight of a texel.
    NUSSELT_HD Real weight_of(const TexelChoice<Real>& texel) const noexcept {
        const auto columns = detail::places<Real>(texel.i, Index(0), 0);
        const auto rows = detail::places<Real>(texel.j, Index(0), 0);
        T weight[RealTraits<Real>::kLanes];
        for (int k = 0; k < RealTraits<Real>::kLanes; ++k)
            weight[k] = map_->texel_weight(columns.lane[k], rows.lane[k]);
        return detail::load_lanes<Real>(weight);
    }

    /// The coordinate of a point of texel i. It never rounds to the next texel.
    NUSSELT_HD Real position(const Index& i, const Real& inside) const noexcept {
        constexpr T kBelowOne = 1 - std::numeric_limits<T>::epsilon() / 2;
        const Real step = Real(T(1) / static_cast<T>(map_->radiance.size));
        const Real texel = detail::number_of<Real>(i);
        return min((texel + inside) * step, Real(kBelowOne) * ((texel + Real(1)) * step));
    }
    NUSSELT_HD Vec2<Real> inside_of(const TexelChoice<Real>& texel, const Vec2<Real>& at) const noexcept {
        const Real size = Real(static_cast<T>(map_->radiance.size));
        return {at.x * size - detail::number_of<Real>(texel.i),
                at.y * size - detail::number_of<Real>(texel.j)};
    }

    NUSSELT_HD Real density_at(const Vec2<Real>& at, const Vec3<Real>& wi) const noexcept {
        if (!any(sums_.total() > Real(0))) return Real(0);
        const CellChoice<Real> cell = sums_.at(at);
        const TexelChoice<Real> texel = texel_at(at);
        const Mask lit = (sums_.total() > Real(0)) & (cell.probability > Real(0));
        if (!any(lit)) return Real(0);
        const Real pdf = density(cell.probability * ascend(texel).probability, texel,
                                 map_->template texel_at<Real>(texel.i, texel.j), at, wi);
        return select(lit, pdf, Real(0));
    }

    /// The density of a point in a texel with this probability.
    NUSSELT_HD Real density(const Real& probability, const TexelChoice<Real>& texel,
                            const detail::BilinearTexel<Real>& interpolant, const Vec2<Real>& at,
                            const Vec3<Real>& wi) const noexcept {
        const Real mean = weight_of(texel);
        const Mask counts = (mean > Real(0)) & factor_.counts(wi);
        const auto size = static_cast<T>(map_->radiance.size);
        const Real share =
            Real(map_->scale) * interpolant.at(inside_of(texel, at)) / select(counts, mean, Real(1));
        return select(counts, probability * share * Real(size * size / (4 * kPi<T>)), Real(0));
    }

    const Map* map_;
    Frame<Real> frame_;
    Factor factor_;
    typename Factor::InMap in_map_;
    CellSums<Real, n> sums_;
    Vec3<Real> unshadowed_; ///< sum over cells of mean radiance times the mean factor
};

/// For diffuse surfaces.
template <class Real, int n = 16>
using EnvironmentCosine = EnvironmentSampler<Real, n, CosineFactor<Real>>;

/// For glossy surfaces.
template <class Real, int n = 16>
using EnvironmentLtc = EnvironmentSampler<Real, n, LobeFactor<Real>>;

NUSSELT_NAMESPACE_END
