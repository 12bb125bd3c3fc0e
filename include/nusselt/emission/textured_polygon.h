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
template <class T>
struct ProjectedCells {
    static constexpr T kUnit = 1; ///< measure of a cell over its projected solid angle
    static constexpr bool kImageIsLight = true;

    NUSSELT_HD TexturePlane<T> image_of(const TexturePlane<T>& plane) const noexcept { return plane; }
    template <int N>
    NUSSELT_HD PolygonProjectedSolidAngle<T, N>
    technique_for(const ConvexPolygon<T, N>& cell) const noexcept {
        return PolygonProjectedSolidAngle<T, N>(cell);
    }
    NUSSELT_HD bool counts(const Vec3<T>& wi) const noexcept { return wi.z > T(0); }
    /// What the measure of a cell is the integral of, over solid angle.
    NUSSELT_HD T integrand(const Vec3<T>& wi) const noexcept { return max(wi.z, T(0)); }
};

/// The measure of cells for glossy surfaces: the integral of a lobe, which is the projected solid angle of the image of the
/// cell in cosine space over pi. Samples may lie below the surface, as those of PolygonLtc.
template <class T>
struct LobeCells {
    static constexpr T kUnit = 1 / kPi<T>; ///< \copydoc ProjectedCells::kUnit
    static constexpr bool kImageIsLight = false;
    Ltc<T> ltc;

    NUSSELT_HD TexturePlane<T> image_of(const TexturePlane<T>& plane) const noexcept {
        return {ltc.to_cosine(plane.corner), ltc.to_cosine(plane.side_x), ltc.to_cosine(plane.side_y),
                normalize(ltc.normal_to_cosine(plane.normal))};
    }
    template <int N>
    NUSSELT_HD PolygonLtc<T, N> technique_for(const ConvexPolygon<T, N>& cell) const noexcept {
        return PolygonLtc<T, N>(cell, ltc);
    }
    NUSSELT_HD bool counts(const Vec3<T>&) const noexcept { return true; }
    /// \copydoc ProjectedCells::integrand
    NUSSELT_HD T integrand(const Vec3<T>& wi) const noexcept { return ltc.density(wi); }
};

/// \tparam T       float, double or long double. One light and shading point at a time: cells are lanes.
/// \tparam n       columns and rows of the lattice, 8 or 16.
/// \tparam Descent DescentByRadiance; DescentByProduct for few cells.
/// \tparam Measure ProjectedCells or LobeCells.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space; the shading point is the origin, the normal +z. For a lobe, wo is in the xz half-plane.
/// Edge cases: nothing of the light above the horizon or in the lobe, black light, no area, origin in the plane of the light:
/// pdf = 0, measure 0. Black texels are never chosen, black cells neither. A texel that the horizon cuts may give a sample
/// with pdf = 0; densities above the horizon then integrate to the share of the others.
template <class T, int n = 16, class Descent = DescentByRadiance, class Measure = ProjectedCells<T>>
class TexturedPolygon {
public:
    using Light = TexturedLight<T, n>;

    /// \param plane of the texture in shading space [m].
    /// \param light has to live as long as this.
    /// \param measure with the lobe, if there is one.
    NUSSELT_HD TexturedPolygon(const TexturePlane<T>& plane, const Light& light,
                               const Measure& measure = {}) noexcept
        : light_(&light), measure_(measure) {
        // Scale the plane to coordinates of order one.
        Vec3<T> reach{T(0), T(0), T(0)};
        for (const T x : {T(0), T(1)}) {
            for (const T y : {T(0), T(1)}) {
                const Vec3<T> p = plane.point_at({x, y});
                reach = max(reach, {abs(p.x), abs(p.y), abs(p.z)});
            }
        }
        const T scale = reciprocal_power_of_two(max(max(reach.x, reach.y), reach.z));
        inverse_scale_ = T(1) / scale;
        plane_ = {without_tiny(scale * plane.corner), scale * plane.side_x, scale * plane.side_y,
                  plane.normal};
        image_ = measure_.image_of(plane_);
        image_area_ = image_.area();
        area_ = Measure::kImageIsLight ? image_area_ : plane_.area();

        // Add up the weights of cells along columns.
        using Lanes = detail::CellLanes<T>;
        using L = typename Lanes::Type;
        const CellLattice<T, n> lattice(image_, light);
        T angles[Light::kCells];
        lattice.find_angles(angles);
        Vec3<L> expected{L(T(0)), L(T(0)), L(T(0))};
        for (int cell = 0; cell < Light::kCells; cell += Lanes::kCount) {
            const L angle = Lanes::load(angles + cell);
            const L weight = Lanes::load(light.weight + cell) * angle;
            sums_.add(cell, weight);
            const auto mean = [&](int channel) { return Lanes::load(light.mean[channel] + cell); };
            expected.x = multiply_add(mean(0), angle, expected.x);
            expected.y = multiply_add(mean(1), angle, expected.y);
            expected.z = multiply_add(mean(2), angle, expected.z);
        }
        distance_ =
            abs(Measure::kImageIsLight ? lattice.signed_distance()
                                       : plane_distance(rectangle_in<T>(plane_, {T(0), T(0)}, {T(1), T(1)})));
        sums_.finish();
        if (!(image_area_ > T(0)) || !(distance_ > T(0))) sums_.clear();
        unshadowed_ = {Lanes::sum(expected.x), Lanes::sum(expected.y), Lanes::sum(expected.z)};
    }

    /// \param u in [0, 1)^2; x chooses along the x axis of the texture, y along its y axis: stratification survives in part.
    NUSSELT_HD TexturedSample<T> sample(const Vec2<T>& u) const noexcept {
        if (!(sums_.total() > T(0))) return none();
        const Cell cell = make_cell(sums_.choose(u));
        if (is_smooth(cell)) {
            return with_technique(cell, [&](const auto& technique) -> TexturedSample<T> {
                const LightSample<T> s = technique.sample(cell.u);
                const TextureCoordinates<T> coordinates(plane_);
                const Vec2<T> at = clamped(coordinates(s.p), cell.low, cell.high);
                // The same point up to rounding, but in the plane in any case.
                return {{s.wi, cell.probability * s.pdf, inverse_scale_ * plane_.point_at(at)}, at};
            });
        }
        const TexelChoice<T> texel = Descent::choose(light_->pyramid, image_, cell.column, cell.row, cell.u);
        const Rectangle area = rectangle_of(texel);
        Vec2<T> at;
        T size;
        if (is_whole(cell, area)) {
            at = {area.low.x + texel.u.x * (area.high.x - area.low.x),
                  area.low.y + texel.u.y * (area.high.y - area.low.y)};
            size = (area.high.x - area.low.x) * (area.high.y - area.low.y);
        } else {
            const TexturePart<T> part = light_->outline.part_in(area.low, area.high);
            at = detail::sample_part(part, texel.u);
            size = part.area();
        }
        at = clamped(at, area.low, area.high);
        const Vec3<T> p = plane_.point_at(at);
        const Vec3<T> wi = normalize(p);
        return {{wi, texel_density(cell.probability * texel.probability, size, wi, p), inverse_scale_ * p},
                at};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD T pdf(const Vec3<T>& wi) const noexcept {
        return sums_.total() > T(0) ? density(wi, hit(wi)) : T(0);
    }

    /// The density of the direction to the point with these texture coordinates [1/sr].
    NUSSELT_HD T pdf_at(const Vec2<T>& at) const noexcept {
        return sums_.total() > T(0) ? density(normalize(plane_.point_at(at)), at) : T(0);
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<T> invert(const Vec3<T>& wi) const noexcept {
        if (!(sums_.total() > T(0))) return {T(0), T(0)};
        const Vec2<T> at = hit(wi);
        const Cell cell = make_cell(sums_.at(at));
        Vec2<T> u;
        if (is_smooth(cell)) {
            u = with_technique(cell, [&](const auto& technique) { return technique.invert(wi); });
        } else {
            TexelChoice<T> texel = texel_at(at);
            const Rectangle area = rectangle_of(texel);
            if (is_whole(cell, area))
                texel.u = {below_one((at.x - area.low.x) / (area.high.x - area.low.x)),
                           below_one((at.y - area.low.y) / (area.high.y - area.low.y))};
            else
                texel.u = detail::invert_part(light_->outline.part_in(area.low, area.high), at);
            u = Descent::invert(light_->pyramid, image_, texel);
        }
        return sums_.unite(cell.column, cell.row, u);
    }

    /// The sum over cells of mean radiance, averaged over channels, times projected solid angle, or times the integral of
    /// the lobe [W/m^2, W/(sr m^2)].
    NUSSELT_HD T measure() const noexcept { return Measure::kUnit * sums_.total(); }

    /// The radiance that is reflected without shadows per albedo of the component, per channel [W/(sr m^2)]: the coefficient
    /// of heuristics for multiple importance sampling (estimate/mis.h). Exact where the texture is constant in each cell.
    NUSSELT_HD Vec3<T> unshadowed() const noexcept {
        return sums_.total() > T(0) ? T(1 / kPi<T>) * unshadowed_ : Vec3<T>{T(0), T(0), T(0)};
    }

private:
    struct Rectangle {
        Vec2<T> low, high;
    };
    struct Cell : CellChoice<T> {
        Vec2<T> low, high;

        NUSSELT_HD int index() const noexcept { return CellChoice<T>::index(n); }
    };

    NUSSELT_HD static TexturedSample<T> none() noexcept {
        const Vec3<T> up{T(0), T(0), T(1)};
        return {{up, T(0), up}, {T(0), T(0)}};
    }

    NUSSELT_HD static Vec2<T> clamped(const Vec2<T>& at, const Vec2<T>& low, const Vec2<T>& high) noexcept {
        constexpr T kBelowOne = 1 - std::numeric_limits<T>::epsilon() / 2;
        return {max(min(at.x, kBelowOne * high.x), low.x), max(min(at.y, kBelowOne * high.y), low.y)};
    }

    NUSSELT_HD static Cell make_cell(const CellChoice<T>& choice) noexcept {
        return {choice,
                {Light::line(choice.column), Light::line(choice.row)},
                {Light::line(choice.column + 1), Light::line(choice.row + 1)}};
    }

    NUSSELT_HD TexelChoice<T> texel_at(const Vec2<T>& at) const noexcept {
        const int width = light_->pyramid.shape.width_of(0);
        const int height = light_->pyramid.shape.height_of(0);
        return {detail::clamp_index(static_cast<int>(at.x * static_cast<T>(width)), width),
                detail::clamp_index(static_cast<int>(at.y * static_cast<T>(height)), height),
                T(1),
                {T(0), T(0)}};
    }
    NUSSELT_HD Rectangle rectangle_of(const TexelChoice<T>& texel) const noexcept {
        const T step_x = T(1) / static_cast<T>(light_->pyramid.shape.width_of(0));
        const T step_y = T(1) / static_cast<T>(light_->pyramid.shape.height_of(0));
        return {{static_cast<T>(texel.i) * step_x, static_cast<T>(texel.j) * step_y},
                {static_cast<T>(texel.i + 1) * step_x, static_cast<T>(texel.j + 1) * step_y}};
    }
    NUSSELT_HD bool is_whole(const Cell& cell, const Rectangle& texel) const noexcept {
        return light_->cover[cell.index()] == T(1) || light_->outline.contains(texel.low, texel.high);
    }

    /// Whether the texture varies less in a cell than the cosine, in terms of squared coefficients of variation.
    ///
    /// The variation of the cosine is that of its values at the corners and the centre. Where one point of a close cell is
    /// much closer than all of these, it is of the order of area over squared distance.
    NUSSELT_HD bool is_smooth(const Cell& cell) const noexcept {
        const T variation = light_->variation[cell.index()];
        const Vec2<T> middle = T(0.5) * (cell.low + cell.high);
        const Vec3<T> centre = image_.point_at(middle);
        if (!(variation * dot(centre, centre) * T(Light::kCells) > image_area_)) return true;

        using Lanes = detail::CellLanes<T>;
        using L = typename Lanes::Type;
        static constexpr T kX[8] = {0, 0, 1, 1, T(0.5), T(0.5), T(0.5), T(0.5)};
        static constexpr T kY[8] = {0, 1, 0, 1, T(0.5), T(0.5), T(0.5), T(0.5)};
        T value[8];
        for (int k = 0; k < 8; k += Lanes::kCount) {
            const L x = multiply_add(Lanes::load(kX + k), L(T(1) / T(n)), L(cell.low.x));
            const L y = multiply_add(Lanes::load(kY + k), L(T(1) / T(n)), L(cell.low.y));
            Lanes::store(value + k, detail::relative_cosine(image_, x, y));
        }
        const T corners = (value[0] + value[1]) + (value[2] + value[3]);
        const T mean = T(2) / T(3) * value[4] + T(1) / T(12) * corners;
        const T inverse = mean > T(0) ? T(1) / mean : T(0);
        T spread = T(0);
        for (int k = 0; k < 5; ++k) {
            const T deviation = value[k] * inverse - T(1);
            spread += T(k < 4 ? 1 : 8) / T(12) * deviation * deviation;
        }
        return !(variation > spread) || !(mean > T(0));
    }

    /// f(technique) with the technique for the part of a cell inside of the outline.
    template <class Function>
    NUSSELT_HD auto with_technique(const Cell& cell, const Function& f) const noexcept {
        if (light_->cover[cell.index()] == T(1))
            return f(measure_.technique_for(rectangle_in(plane_, cell.low, cell.high)));
        TexturePart<T> part = light_->outline.part_in(cell.low, cell.high);
        // Nothing of a cell without weight is sampled, but a technique needs a polygon.
        if (part.count < 3) part = {{cell.low, cell.low, cell.low}, 3};
        return f(measure_.technique_for(polygon_in<8>(plane_, part.corner, part.count < 8 ? part.count : 8)));
    }

    /// Texture coordinates of the point in a direction.
    NUSSELT_HD Vec2<T> hit(const Vec3<T>& wi) const noexcept {
        T farthest = T(0);
        for (const T x : {T(0), T(1)})
            for (const T y : {T(0), T(1)}) farthest = max(farthest, length(plane_.point_at({x, y})));
        const T sign = copysign(T(1), dot(plane_.normal, wi));
        const LightPlane<T> plane{plane_.normal, sign * distance_, farthest};
        return TextureCoordinates<T>(plane_)(plane.distance_along(wi) * wi);
    }

    NUSSELT_HD T density(const Vec3<T>& wi, const Vec2<T>& at) const noexcept {
        const Cell cell = make_cell(sums_.at(at));
        if (!(cell.probability > T(0))) return T(0);
        if (is_smooth(cell))
            return with_technique(
                cell, [&](const auto& technique) { return cell.probability * technique.pdf(wi); });
        const TexelChoice<T> texel = texel_at(at);
        const Rectangle area = rectangle_of(texel);
        const T size = is_whole(cell, area) ? (area.high.x - area.low.x) * (area.high.y - area.low.y)
                                            : light_->outline.part_in(area.low, area.high).area();
        const T probability = Descent::probability(light_->pyramid, image_, texel.i, texel.j);
        return texel_density(cell.probability * probability, size, wi, plane_.point_at(at));
    }

    /// The density of a direction to a point that is uniform in a part of the texture.
    NUSSELT_HD T texel_density(const T& probability, const T& size, const Vec3<T>& wi,
                               const Vec3<T>& p) const noexcept {
        if (!(probability > T(0)) || !(size > T(0)) || !measure_.counts(wi)) return T(0);
        const T distance_to_point = dot(wi, p);
        const T projected = size / probability * (area_ * distance_ / max(distance_to_point, kTiny<T>));
        return detail::area_density(distance_to_point, projected);
    }

    const Light* light_;
    Measure measure_;
    TexturePlane<T> plane_; ///< scaled to coordinates of order one
    TexturePlane<T> image_; ///< in the space where the measure is the projected solid angle
    T image_area_;
    T area_;          ///< of the texture
    T distance_;      ///< of its plane
    T inverse_scale_; ///< a power of two
    CellSums<T, n> sums_;
    Vec3<T> unshadowed_; ///< sum of mean radiance times projected solid angle
};

/// For glossy surfaces.
template <class T, int n = 16, class Descent = DescentByRadiance>
using TexturedPolygonLtc = TexturedPolygon<T, n, Descent, LobeCells<T>>;

NUSSELT_NAMESPACE_END
