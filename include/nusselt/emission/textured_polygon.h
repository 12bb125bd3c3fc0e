#pragma once
/// Sampling of polygons with a texture in proportion to radiance times the cosine at the surface, or times a glossy lobe.
///
/// A lattice of cells is chosen from in proportion to mean radiance times closed-form projected solid angle
/// (cell_lattice.h). In a cell, samples are uniform in projected solid angle where the texture is smoother than the cosine
/// per area, and else go to single texels (cell_descent.h). Where the texture is constant in each cell, the density is that
/// of the product. docs/techniques/textured_polygon.md derives all of it.

#include <nusselt/emission/cell_descent.h>
#include <nusselt/emission/cell_sums.h>
#include <nusselt/sampling/polygon_ltc.h>

NUSSELT_NAMESPACE_BEGIN

/// The measure of cells for diffuse surfaces: projected solid angle. Samples are above the horizon.
template <class Real>
struct ProjectedCells {
    static constexpr scalar_t<Real> kUnit = 1; ///< measure of a cell over its projected solid angle
    static constexpr bool kImageIsLight = true;

    NUSSELT_HD TexturePlane<Real> image_of(const TexturePlane<Real>& plane) const noexcept { return plane; }
    template <int N>
    NUSSELT_HD PolygonProjectedSolidAngle<Real, N>
    technique_for(const ConvexPolygon<Real, N>& cell) const noexcept {
        return PolygonProjectedSolidAngle<Real, N>(cell);
    }
    NUSSELT_HD mask_t<Real> counts(const Vec3<Real>& wi) const noexcept { return wi.z > Real(0); }
    /// What the measure of a cell is the integral of, over solid angle.
    NUSSELT_HD Real integrand(const Vec3<Real>& wi) const noexcept { return max(wi.z, Real(0)); }
};

/// The measure of cells for glossy surfaces: the integral of a lobe, which is the projected solid angle of the image of the
/// cell in cosine space over pi. Samples may lie below the surface, as those of PolygonLtc.
template <class Real>
struct LobeCells {
    static constexpr scalar_t<Real> kUnit = 1 / kPi<scalar_t<Real>>; ///< \copydoc ProjectedCells::kUnit
    static constexpr bool kImageIsLight = false;
    Ltc<Real> ltc;

    NUSSELT_HD TexturePlane<Real> image_of(const TexturePlane<Real>& plane) const noexcept {
        return {ltc.to_cosine(plane.corner), ltc.to_cosine(plane.side_x), ltc.to_cosine(plane.side_y),
                normalize(ltc.normal_to_cosine(plane.normal))};
    }
    template <int N>
    NUSSELT_HD PolygonLtc<Real, N> technique_for(const ConvexPolygon<Real, N>& cell) const noexcept {
        return PolygonLtc<Real, N>(cell, ltc);
    }
    NUSSELT_HD mask_t<Real> counts(const Vec3<Real>&) const noexcept { return mask_t<Real>(true); }
    /// \copydoc ProjectedCells::integrand
    NUSSELT_HD Real integrand(const Vec3<Real>& wi) const noexcept { return ltc.density(wi); }
};

/// \tparam Real    float, double, long double, or a pack with a shading point and its view of the light per lane.
/// \tparam n       columns and rows of the lattice, 8 or 16.
/// \tparam Descent DescentByRadiance; DescentByProduct for few cells.
/// \tparam Measure ProjectedCells or LobeCells.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space; the shading point is the origin, the normal +z. For a lobe, wo is in the xz half-plane.
/// Edge cases: nothing of the light above the horizon or in the lobe, black light, no area, origin in the plane of the light:
/// pdf = 0, measure 0. Black texels are never chosen, black cells neither. A texel that the horizon cuts may give a sample
/// with pdf = 0; densities above the horizon then integrate to the share of the others.
template <class Real, int n = 16, class Descent = DescentByRadiance, class Measure = ProjectedCells<Real>>
class TexturedPolygon {
    using T = scalar_t<Real>;
    using Mask = mask_t<Real>;
    using Index = detail::index_t<Real>;

public:
    using Light = TexturedLight<T, n>;

    /// \param plane of the texture in shading space [m].
    /// \param light has to live as long as this.
    /// \param measure with the lobe, if there is one.
    NUSSELT_HD TexturedPolygon(const TexturePlane<Real>& plane, const Light& light,
                               const Measure& measure = {}) noexcept
        : light_(&light), measure_(measure) {
        // Scale the plane to coordinates of order one.
        Vec3<Real> reach{Real(0), Real(0), Real(0)};
        for (const T x : {T(0), T(1)}) {
            for (const T y : {T(0), T(1)}) {
                const Vec3<Real> p = plane.point_at({Real(x), Real(y)});
                reach = max(reach, {abs(p.x), abs(p.y), abs(p.z)});
            }
        }
        const Real scale = reciprocal_power_of_two(max(max(reach.x, reach.y), reach.z));
        inverse_scale_ = Real(1) / scale;
        plane_ = {without_tiny(scale * plane.corner), scale * plane.side_x, scale * plane.side_y,
                  plane.normal};
        image_ = measure_.image_of(plane_);
        image_area_ = image_.area();
        area_ = Measure::kImageIsLight ? image_area_ : plane_.area();

        // Add up the weights of cells along columns.
        using Lanes = detail::CellLanes<Real>;
        using L = typename Lanes::Type;
        const CellLattice<Real, n> lattice(image_, light);
        alignas(Real) T angles[Light::kCells * Lanes::kPoints];
        lattice.find_angles(angles);
        Vec3<L> expected{L(T(0)), L(T(0)), L(T(0))};
        for (int cell = 0; cell < Light::kCells; cell += Lanes::kCount) {
            const L angle = Lanes::load(angles + Lanes::kPoints * cell);
            const L weight = Lanes::load_shared(light.weight + cell) * angle;
            sums_.add(cell, weight);
            const auto mean = [&](int channel) { return Lanes::load_shared(light.mean[channel] + cell); };
            expected.x = multiply_add(mean(0), angle, expected.x);
            expected.y = multiply_add(mean(1), angle, expected.y);
            expected.z = multiply_add(mean(2), angle, expected.z);
        }
        distance_ = abs(Measure::kImageIsLight ? lattice.signed_distance() : plane_distance(whole(plane_)));
        sums_.finish();
        sums_.clear(!((image_area_ > Real(0)) & (distance_ > Real(0))));
        unshadowed_ = {Lanes::sum(expected.x), Lanes::sum(expected.y), Lanes::sum(expected.z)};
    }

    /// \param u in [0, 1)^2; x chooses along the x axis of the texture, y along its y axis: stratification survives in part.
    NUSSELT_HD TexturedSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Mask lit = sums_.total() > Real(0);
        const Vec3<Real> up{Real(0), Real(0), Real(1)};
        TexturedSample<Real> result{{up, Real(0), up}, {Real(0), Real(0)}};
        if (!any(lit)) return result;
        const Cell cell = make_cell(sums_.choose(u));
        const Mask smooth = lit & is_smooth(cell);
        if (any(smooth)) {
            const LightSample<Real> s = with_technique(
                cell, smooth, [&](const auto& technique) { return technique.sample(cell.choice.u); });
            const TextureCoordinates<Real> coordinates(plane_);
            const Vec2<Real> at = clamped(coordinates(s.p), cell.low, cell.high);
            // The same point up to rounding, but in the plane in any case.
            const Vec3<Real> p = inverse_scale_ * plane_.point_at(at);
            result = chosen(smooth, {{s.wi, cell.choice.probability * s.pdf, p}, at}, result);
        }
        const Mask busy = lit & !smooth;
        if (any(busy)) result = chosen(busy, sample_texel(cell, busy), result);
        return result;
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept { return density(wi, hit(wi)); }

    /// The density of the direction to the point with these texture coordinates [1/sr].
    NUSSELT_HD Real pdf_at(const Vec2<Real>& at) const noexcept {
        return density(normalize(plane_.point_at(at)), at);
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Mask lit = sums_.total() > Real(0);
        Vec2<Real> u{Real(0), Real(0)};
        if (!any(lit)) return u;
        const Vec2<Real> at = hit(wi);
        const Cell cell = make_cell(sums_.at(at));
        const Mask smooth = lit & is_smooth(cell);
        if (any(smooth))
            u = with_technique(cell, smooth, [&](const auto& technique) { return technique.invert(wi); });
        const Mask busy = lit & !smooth;
        if (any(busy)) {
            TexelChoice<Real> texel = texel_at(at);
            const Texel area = texel_of(cell, texel, busy);
            texel.u = {below_one((at.x - area.low.x) / (area.high.x - area.low.x)),
                       below_one((at.y - area.low.y) / (area.high.y - area.low.y))};
            if (any(area.cut))
                texel.u = per_lane(area.cut, texel.u, area, at,
                                   [](const TexturePart<T>& part, const Vec2<T>& point) {
                                       return detail::invert_part(part, point);
                                   });
            u = select(busy, Descent::invert(light_->pyramid, image_, texel), u);
        }
        return select(lit, sums_.unite(cell.choice.column, cell.choice.row, u), Vec2<Real>{Real(0), Real(0)});
    }

    /// The sum over cells of mean radiance, averaged over channels, times projected solid angle, or times the integral of
    /// the lobe [W/m^2, W/(sr m^2)].
    NUSSELT_HD Real measure() const noexcept { return Real(Measure::kUnit) * sums_.total(); }

    /// The radiance that is reflected without shadows per albedo of the component, per channel [W/(sr m^2)]: the coefficient
    /// of heuristics for multiple importance sampling (estimate/mis.h). Exact where the texture is constant in each cell.
    NUSSELT_HD Vec3<Real> unshadowed() const noexcept {
        const Vec3<Real> dark{Real(0), Real(0), Real(0)};
        return select(sums_.total() > Real(0), Real(T(1 / kPi<T>)) * unshadowed_, dark);
    }

private:
    struct Cell {
        CellChoice<Real> choice;
        detail::LanePlaces<Real> place; ///< of numbers per cell
        Vec2<Real> low, high;           ///< texture coordinates
    };
    struct Texel {
        Vec2<Real> low, high; ///< texture coordinates
        Mask cut;             ///< by the outline
    };

    NUSSELT_HD static TexturedSample<Real> chosen(const Mask& mask, const TexturedSample<Real>& a,
                                                  const TexturedSample<Real>& b) noexcept {
        return {{select(mask, a.wi, b.wi), select(mask, a.pdf, b.pdf), select(mask, a.p, b.p)},
                select(mask, a.at, b.at)};
    }
    NUSSELT_HD static LightSample<Real> chosen(const Mask& mask, const LightSample<Real>& a,
                                               const LightSample<Real>& b) noexcept {
        return {select(mask, a.wi, b.wi), select(mask, a.pdf, b.pdf), select(mask, a.p, b.p)};
    }
    NUSSELT_HD static Vec2<Real> chosen(const Mask& mask, const Vec2<Real>& a, const Vec2<Real>& b) noexcept {
        return select(mask, a, b);
    }
    NUSSELT_HD static Real chosen(const Mask& mask, const Real& a, const Real& b) noexcept {
        return select(mask, a, b);
    }

    NUSSELT_HD static ConvexPolygon<Real, 4> whole(const TexturePlane<Real>& plane) noexcept {
        return rectangle_in<Real>(plane, {Real(0), Real(0)}, {Real(1), Real(1)});
    }

    NUSSELT_HD static Vec2<Real> clamped(const Vec2<Real>& at, const Vec2<Real>& low,
                                         const Vec2<Real>& high) noexcept {
        const Real below = Real(1 - std::numeric_limits<T>::epsilon() / 2);
        return {max(min(at.x, below * high.x), low.x), max(min(at.y, below * high.y), low.y)};
    }

    NUSSELT_HD static Cell make_cell(const CellChoice<Real>& choice) noexcept {
        const auto line = [](const Real& i) { return i * Real(T(1) / T(n)); };
        const Real column = detail::number_of<Real>(choice.column);
        const Real row = detail::number_of<Real>(choice.row);
        return {choice,
                choice.place(n),
                {line(column), line(row)},
                {line(column + Real(1)), line(row + Real(1))}};
    }

    NUSSELT_HD TexelChoice<Real> texel_at(const Vec2<Real>& at) const noexcept {
        const int width = light_->pyramid.shape.width_of(0);
        const int height = light_->pyramid.shape.height_of(0);
        return {detail::index_below<Real>(at.x * Real(width), width),
                detail::index_below<Real>(at.y * Real(height), height),
                Real(1),
                {Real(0), Real(0)}};
    }

    /// Where a texel is.
    /// \param lanes that ask.
    NUSSELT_HD Texel texel_of(const Cell& cell, const TexelChoice<Real>& texel,
                              const Mask& lanes) const noexcept {
        const Real step_x = Real(T(1) / static_cast<T>(light_->pyramid.shape.width_of(0)));
        const Real step_y = Real(T(1) / static_cast<T>(light_->pyramid.shape.height_of(0)));
        const Real i = detail::number_of<Real>(texel.i);
        const Real j = detail::number_of<Real>(texel.j);
        Texel result{{i * step_x, j * step_y}, {(i + Real(1)) * step_x, (j + Real(1)) * step_y}, Mask(false)};
        const Mask in_cut_cell = lanes & (cell.place.load(light_->cover) != Real(1));
        if (any(in_cut_cell)) result.cut = in_cut_cell & !light_->outline.contains(result.low, result.high);
        return result;
    }

    /// What f(part, argument) returns for the parts of texels inside of the outline, in some lanes; else `others`.
    template <class Function>
    NUSSELT_HD Vec2<Real> per_lane(const Mask& lanes, const Vec2<Real>& others, const Texel& texel,
                                   const Vec2<Real>& argument, const Function& f) const noexcept {
        Vec2<Real> result = others;
        detail::for_each_lane(lanes, [&](int lane) {
            const TexturePart<T> part =
                light_->outline.part_in(detail::lane_of(texel.low, lane), detail::lane_of(texel.high, lane));
            detail::set_lane(result, lane, f(part, detail::lane_of(argument, lane)));
        });
        return result;
    }

    /// Shares of the texture that texels take inside of the outline.
    NUSSELT_HD Real size_of(const Texel& texel) const noexcept {
        const Real size = (texel.high.x - texel.low.x) * (texel.high.y - texel.low.y);
        if (!any(texel.cut)) return size;
        return per_lane(texel.cut, {size, size}, texel, {size, size},
                        [](const TexturePart<T>& part, const Vec2<T>&) {
                            const T area = part.area();
                            return Vec2<T>{area, area};
                        })
            .x;
    }

    /// Whether the texture varies less in a cell than the cosine, in terms of squared coefficients of variation.
    ///
    /// The variation of the cosine is that of its values at the corners and the centre. Where one point of a close cell is
    /// much closer than all of these, it is of the order of area over squared distance.
    NUSSELT_HD Mask is_smooth(const Cell& cell) const noexcept {
        const Real variation = cell.place.load(light_->variation);
        const Vec2<Real> middle = Real(0.5) * (cell.low + cell.high);
        const Vec3<Real> centre = image_.point_at(middle);
        const Mask close = !(variation * dot(centre, centre) * Real(Light::kCells) > image_area_);
        if (all(close)) return close;

        using Lanes = detail::CellLanes<Real>;
        using L = typename Lanes::Type;
        static constexpr T kX[8] = {0, 0, 1, 1, T(0.5), T(0.5), T(0.5), T(0.5)};
        static constexpr T kY[8] = {0, 1, 0, 1, T(0.5), T(0.5), T(0.5), T(0.5)};
        L lanes[8 / Lanes::kCount]{};
        for (int k = 0; k < 5; k += Lanes::kCount) {
            const L x = multiply_add(Lanes::load_shared(kX + k), L(T(1) / T(n)), L(cell.low.x));
            const L y = multiply_add(Lanes::load_shared(kY + k), L(T(1) / T(n)), L(cell.low.y));
            lanes[k / Lanes::kCount] = detail::relative_cosine(image_, x, y);
        }
        Real value[8];
        detail::spread_cells<Real>(lanes, value);
        const Real corners = (value[0] + value[1]) + (value[2] + value[3]);
        const Real mean = Real(T(2) / T(3)) * value[4] + Real(T(1) / T(12)) * corners;
        const Mask seen = mean > Real(0);
        const Real inverse = select(seen, Real(1) / mean, Real(0));
        Real spread = Real(0);
        for (int k = 0; k < 5; ++k) {
            const Real deviation = value[k] * inverse - Real(1);
            spread += Real(T(k < 4 ? 1 : 8) / T(12)) * deviation * deviation;
        }
        return close | !(variation > spread) | !seen;
    }

    /// f(technique) with the technique for the part of a cell inside of the outline.
    /// \param lanes that ask.
    template <class Function>
    NUSSELT_HD auto with_technique(const Cell& cell, const Mask& lanes, const Function& f) const noexcept {
        const Mask cut = lanes & (cell.place.load(light_->cover) != Real(1));
        if (!any(cut)) return f(measure_.technique_for(rectangle_in(plane_, cell.low, cell.high)));

        Vec2<Real> corner[8];
        for (Vec2<Real>& c : corner) c = cell.low;
        detail::for_each_lane(cut, [&](int lane) {
            const TexturePart<T> part =
                light_->outline.part_in(detail::lane_of(cell.low, lane), detail::lane_of(cell.high, lane));
            // Nothing of a cell without weight is sampled, but a technique needs a polygon. No smooth cell has more corners.
            for (int k = 0; k < 8 && part.count > 0; ++k)
                detail::set_lane(corner[k], lane, part.corner[k < part.count ? k : part.count - 1]);
        });
        const auto value = f(measure_.technique_for(polygon_in<8>(plane_, corner, 8)));
        const Mask uncut = lanes & !cut;
        if (!any(uncut)) return value;
        return chosen(cut, value, f(measure_.technique_for(rectangle_in(plane_, cell.low, cell.high))));
    }

    /// \param lanes that ask.
    NUSSELT_HD TexturedSample<Real> sample_texel(const Cell& cell, const Mask& lanes) const noexcept {
        const TexelChoice<Real> texel =
            Descent::choose(light_->pyramid, image_, cell.choice.column, cell.choice.row, cell.choice.u);
        const Texel area = texel_of(cell, texel, lanes);
        Vec2<Real> at{area.low.x + texel.u.x * (area.high.x - area.low.x),
                      area.low.y + texel.u.y * (area.high.y - area.low.y)};
        if (any(area.cut))
            at = per_lane(area.cut, at, area, texel.u, [](const TexturePart<T>& part, const Vec2<T>& u) {
                return detail::sample_part(part, u);
            });
        at = clamped(at, area.low, area.high);
        const Vec3<Real> p = plane_.point_at(at);
        const Vec3<Real> wi = normalize(p);
        const Real probability = cell.choice.probability * texel.probability;
        return {{wi, texel_density(probability, size_of(area), wi, p), inverse_scale_ * p}, at};
    }

    /// Texture coordinates of the point in a direction.
    NUSSELT_HD Vec2<Real> hit(const Vec3<Real>& wi) const noexcept {
        Real farthest = Real(0);
        for (const T x : {T(0), T(1)})
            for (const T y : {T(0), T(1)})
                farthest = max(farthest, length(plane_.point_at({Real(x), Real(y)})));
        const Real sign = copysign(Real(1), dot(plane_.normal, wi));
        const LightPlane<Real> plane{plane_.normal, sign * distance_, farthest};
        return TextureCoordinates<Real>(plane_)(plane.distance_along(wi) * wi);
    }

    NUSSELT_HD Real density(const Vec3<Real>& wi, const Vec2<Real>& at) const noexcept {
        if (!any(sums_.total() > Real(0))) return Real(0);
        const Cell cell = make_cell(sums_.at(at));
        const Mask lit = (sums_.total() > Real(0)) & (cell.choice.probability > Real(0));
        if (!any(lit)) return Real(0);
        const Mask smooth = lit & is_smooth(cell);
        Real result = Real(0);
        if (any(smooth))
            result = select(
                smooth,
                cell.choice.probability *
                    with_technique(cell, smooth, [&](const auto& technique) { return technique.pdf(wi); }),
                result);
        const Mask busy = lit & !smooth;
        if (any(busy)) {
            const TexelChoice<Real> texel = texel_at(at);
            const Real probability =
                cell.choice.probability * Descent::probability(light_->pyramid, image_, texel.i, texel.j);
            const Real size = size_of(texel_of(cell, texel, busy));
            result = select(busy, texel_density(probability, size, wi, plane_.point_at(at)), result);
        }
        return result;
    }

    /// The density of a direction to a point that is uniform in a part of the texture.
    NUSSELT_HD Real texel_density(const Real& probability, const Real& size, const Vec3<Real>& wi,
                                  const Vec3<Real>& p) const noexcept {
        const Mask counts = (probability > Real(0)) & (size > Real(0)) & measure_.counts(wi);
        const Real distance_to_point = dot(wi, p);
        const Real projected = size / select(counts, probability, Real(1)) *
                               (area_ * distance_ / max(distance_to_point, Real(kTiny<T>)));
        return select(counts, detail::area_density(distance_to_point, projected), Real(0));
    }

    const Light* light_;
    Measure measure_;
    TexturePlane<Real> plane_; ///< scaled to coordinates of order one
    TexturePlane<Real> image_; ///< in the space where the measure is the projected solid angle
    Real image_area_;
    Real area_;          ///< of the texture
    Real distance_;      ///< of its plane
    Real inverse_scale_; ///< a power of two
    CellSums<Real, n> sums_;
    Vec3<Real> unshadowed_; ///< sum of mean radiance times projected solid angle
};

/// For glossy surfaces.
template <class Real, int n = 16, class Descent = DescentByRadiance>
using TexturedPolygonLtc = TexturedPolygon<Real, n, Descent, LobeCells<Real>>;

NUSSELT_NAMESPACE_END
