#pragma once
/// Sampling of polygons whose radiance depends on the direction, in proportion to radiance times the cosine at the surface or
/// times a glossy lobe.
///
/// From a shading point, the light is a window of a table of radiance (rectified_table.h). A lattice of cells is chosen from in
/// proportion to mean radiance times closed-form projected solid angle. In a cell, samples are uniform in projected solid angle
/// where the table is smoother than the cosine, and else go to single texels. docs/techniques/windowed_polygon.md derives it.

#include <nusselt/emission/cell_sums.h>
#include <nusselt/emission/textured_polygon.h>
#include <nusselt/emission/window_cells.h>
#include <nusselt/emission/windowed_light.h>

NUSSELT_NAMESPACE_BEGIN

/// A sample on a light whose radiance depends on the direction.
///
/// p is on the light. That of a portal is only where the ray leaves: what is behind shadows too, so shadow rays go on along wi
/// to infinity.
template <class Real>
struct WindowSample : LightSample<Real> {
    /// Position in the table, from 0 to 1. Where radiance is constant in each texel, look it up there: rounding may move wi
    /// into another texel.
    Vec2<Real> at;
};

/// \tparam T       float, double or long double. One light and shading point at a time: cells are lanes.
/// \tparam n       columns and rows of the lattice: 8, or 4 where the table is smooth.
/// \tparam Measure ProjectedCells or LobeCells.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: shading space; the shading point is the origin, the normal +z. For a lobe, wo is in the xz half-plane.
/// Edge cases: nothing of the light above the horizon or in the lobe, black window, no area, point beyond or in the plane of
/// the light, or nearer to it than its extent over kLargestSlope: pdf = 0, measure 0. Black texels are never chosen. Samples in
/// texels that the horizon or the outline cuts may have pdf = 0: densities then integrate to the share of the others.
template <class T, int n = 8, class Measure = ProjectedCells<T>>
class WindowedPolygon {
    static_assert(n == 4 || n == 8, "lanes of a pack are neighbouring cells of a row");

public:
    /// \param plane of the light in shading space [m]: to_shading_space(light.plane, point, frame).
    /// \param light has to live as long as this, and so has what its table refers to.
    /// \param measure with the lobe, if there is one.
    NUSSELT_HD WindowedPolygon(const WindowPlane<T>& plane, const WindowedLight<T>& light,
                               const Measure& measure = {}) noexcept
        : table_(&light.table), measure_(measure), frame_(plane.frame), distance_(T(0)) {
        sums_.clear(true);
        if (!(light.table.mean > T(0)) || !find_window(plane, light)) return;
        find_weights();
    }

    /// \param u in [0, 1)^2; x chooses along the x axis of the light, y along its y axis: stratification survives in part.
    NUSSELT_HD WindowSample<T> sample(const Vec2<T>& u) const noexcept {
        if (!(sums_.total() > T(0))) return none();
        const Cell cell = sums_.choose(u);
        const TableWindow<T> window = window_of(cell);
        if (is_smooth(cell, window)) {
            return with_technique(cell, [&](const auto& technique) -> WindowSample<T> {
                const LightSample<T> s = technique.sample(cell.u);
                const Vec2<T> at = clamped(offset_of(s.p), cell);
                const Vec2<T> texels{columns_.position_at(at.x), rows_.position_at(at.y)};
                return {{s.wi, cell.probability * s.pdf, distance_ * plane_.point_at(at)},
                        table_position(texels)};
            });
        }
        const WindowPoint<T> point = window.sample(cell.u);
        const Vec2<T> at =
            clamped({columns_.offset_at(point.offset.x), rows_.offset_at(point.offset.y)}, cell);
        const Vec3<T> p = plane_.point_at(at);
        const Vec3<T> wi = normalize(p);
        return {{wi, texel_density(cell, window, point, at, wi), distance_ * p},
                table_position(point.offset)};
    }

    /// \param wi a unit direction towards the light; the density is 0 where it is black. Beside the light, it may be above 0.
    NUSSELT_HD T pdf(const Vec3<T>& wi) const noexcept {
        if (!(sums_.total() > T(0))) return T(0);
        const Hit where = hit(wi);
        if (!where.is_inside) return T(0);
        const Vec2<T> at = where.offset;
        const Cell cell = cell_at(at);
        if (!(cell.probability > T(0))) return T(0);
        const TableWindow<T> window = window_of(cell);
        if (is_smooth(cell, window))
            return with_technique(
                cell, [&](const auto& technique) { return cell.probability * technique.pdf(wi); });
        return texel_density(cell, window,
                             window.point_at({columns_.position_at(at.x), rows_.position_at(at.y)}), at, wi);
    }

    /// The random numbers for which sample() returns wi, a unit direction with a density.
    NUSSELT_HD Vec2<T> invert(const Vec3<T>& wi) const noexcept {
        if (!(sums_.total() > T(0))) return {T(0), T(0)};
        const Hit where = hit(wi);
        if (!where.is_inside) return {T(0), T(0)};
        const Vec2<T> at = where.offset;
        const Cell cell = cell_at(at);
        const TableWindow<T> window = window_of(cell);
        Vec2<T> u;
        if (is_smooth(cell, window))
            u = with_technique(cell, [&](const auto& technique) { return technique.invert(wi); });
        else
            u = window.invert({columns_.position_at(at.x), rows_.position_at(at.y)});
        return sums_.unite(cell.column, cell.row, u);
    }

    /// The sum over cells of mean radiance, averaged over channels, times projected solid angle, or times the integral of
    /// the lobe [W/m^2, W/(sr m^2)].
    NUSSELT_HD T measure() const noexcept { return Measure::kUnit * (table_->mean * sums_.total()); }

    /// The radiance that is reflected without shadows per albedo of the component, per channel [W/(sr m^2)]: the coefficient
    /// of heuristics for multiple importance sampling (estimate/mis.h). Colours come from whole texels.
    NUSSELT_HD Vec3<T> unshadowed() const noexcept {
        Vec3<T> sum{T(0), T(0), T(0)};
        if (!(sums_.total() > T(0))) return sum;
        if (table_->colour == nullptr) {
            const T grey = (table_->mean / kPi<T>)*sums_.total();
            return {grey, grey, grey};
        }
        for (int column = 0; column < n; ++column) {
            for (int row = 0; row < n; ++row) {
                const T weight = sums_.weight(column, row);
                if (weight > T(0)) sum += weight * hue_of(column, row);
            }
        }
        return (table_->mean / kPi<T>)*sum;
    }

private:
    using Cell = CellChoice<T>;

    struct Hit {
        Vec2<T> offset;
        bool is_inside;
    };

    NUSSELT_HD static WindowSample<T> none() noexcept {
        const Vec3<T> up{T(0), T(0), T(1)};
        return {{up, T(0), up}, {T(0), T(0)}};
    }

    /// Finds the lit part of the light in the plane at distance one, and the lines of its cells.
    /// \returns false if there is none.
    NUSSELT_HD bool find_window(const WindowPlane<T>& plane, const WindowedLight<T>& light) noexcept {
        // The bounding box in the plane, and its distance.
        const TextureOutline<T>& outline = light.outline;
        Vec2<T> low = outline.vertex[0];
        Vec2<T> high = low;
        for (int k = 1; k < outline.count; ++k) {
            low = {min(low.x, outline.vertex[k].x), min(low.y, outline.vertex[k].y)};
            high = {max(high.x, outline.vertex[k].x), max(high.y, outline.vertex[k].y)};
        }
        // Polygons want normals that are right-handed with their sides.
        const T hand = copysign(T(1), dot(cross(frame_.t, frame_.b), frame_.n));
        const TexturePlane<T> whole{plane.corner, frame_.t, frame_.b, hand * frame_.n};
        distance_ = hand * plane_distance(rectangle_in(whole, low, high));
        const Vec2<T> foot{-dot(frame_.t, plane.corner), -dot(frame_.b, plane.corner)};
        const Vec2<T> to_low = low - foot;
        const Vec2<T> to_high = high - foot;
        const T reach = max(max(abs(to_low.x), abs(to_high.x)), max(abs(to_low.y), abs(to_high.y)));
        constexpr T kLargest = kLargestSlope<T>;
        if (!(distance_ * kLargest > reach)) return false;

        // Offsets in the plane are precise from the point next to the foot on.
        const T inverse = T(1) / distance_;
        const auto interval = [&](const T& from, const T& to, const T& middle) {
            const T nearest = max(min(middle, to), from);
            return SlopeInterval<T>{inverse * (nearest - middle), inverse * (from - nearest),
                                    inverse * (to - nearest), T(0)};
        };
        const RectifiedTable<T>& table = *table_;
        const SlopeInterval<T> box_x = interval(low.x, high.x, foot.x);
        const SlopeInterval<T> box_y = interval(low.y, high.y, foot.y);
        // What the table covers, and of this what is not black. Directions that are almost in the plane of the light have few
        // digits of their slopes left, and next to no solid angle.
        constexpr T kSteepest = power_of_two<T>(std::numeric_limits<T>::digits * 2 / 3);
        const auto within = [&](const T& slope) { return min(max(slope, -kSteepest), kSteepest); };
        const Vec2<T> table_low{within(table.domain.low.x), within(table.domain.low.y)};
        const Vec2<T> table_high{within(table.domain.high.x), within(table.domain.high.y)};
        SlopeInterval<T> x = box_x.cut(table_low.x, table_high.x);
        SlopeInterval<T> y = box_y.cut(table_low.y, table_high.y);
        if (x.is_empty() || y.is_empty()) return false;

        const TableAxis<T> across =
            WindowLines<T, n>::axis_of(x, table.width, table.angle_low.x, table.texel_size.x);
        const TableAxis<T> along =
            WindowLines<T, n>::axis_of(y, table.height, table.angle_low.y, table.texel_size.y);
        const auto texels = [](const SlopeInterval<T>& slopes, const TableAxis<T>& axis, const T& size) {
            return axis.interval(slopes.angle_at(slopes.low) / size, slopes.angle_at(slopes.high) / size);
        };
        const TableWindow<T> window{table, across, along, texels(x, across, table.texel_size.x),
                                    texels(y, along, table.texel_size.y)};
        const TexelRectangle lit = window.lit();
        if (lit.begin[0] == lit.end[0]) return false;
        x = lit_part(box_x, window.columns, lit.begin[0], lit.end[0], table.angle_low.x, table.texel_size.x,
                     table_low.x, table_high.x);
        y = lit_part(box_y, window.rows, lit.begin[1], lit.end[1], table.angle_low.y, table.texel_size.y,
                     table_low.y, table_high.y);
        if (x.is_empty() || y.is_empty()) return false;
        columns_ = WindowLines<T, n>(x, table.width, table.angle_low.x, table.texel_size.x);
        rows_ = WindowLines<T, n>(y, table.height, table.angle_low.y, table.texel_size.y);

        // The plane at distance one, with offsets of slopes as coordinates.
        plane_ = {frame_.n + (x.origin * frame_.t + y.origin * frame_.b), frame_.t, frame_.b,
                  hand * frame_.n};
        image_ = measure_.image_of(plane_);
        outline_.count = outline.count;
        const Vec2<T> nearest{max(min(foot.x, high.x), low.x), max(min(foot.y, high.y), low.y)};
        for (int k = 0; k < outline.count; ++k)
            outline_.vertex[k] = {inverse * (outline.vertex[k].x - nearest.x) - x.move,
                                  inverse * (outline.vertex[k].y - nearest.y) - y.move};
        return true;
    }

    /// The part of a box between two lines of texels and within the slopes of a domain.
    NUSSELT_HD static SlopeInterval<T> lit_part(const SlopeInterval<T>& box, const TexelInterval<T>& texels,
                                                int begin, int end, const T& angle_low, const T& texel_size,
                                                const T& from, const T& to) noexcept {
        const auto slope_at = [&](int i) {
            const T angle = angle_low + static_cast<T>(i) * texel_size;
            const SinCos<T> turn = sincos_quarter_turn(min(abs(angle), T(kPi<T> / 2)));
            return copysign(turn.sin / max(turn.cos, T(1) / kLargestSlope<T>), angle);
        };
        return box.cut(begin > texels.first ? max(slope_at(begin), from) : from,
                       end <= texels.last ? min(slope_at(end), to) : to);
    }

    /// Adds up the weights of cells along columns.
    NUSSELT_HD void find_weights() noexcept {
        T angle[n * n];
        WindowLattice<T, n>(image_, columns_.offset, rows_.offset).find_angles(angle);
        clip_angles(angle);

        // Sums of the table between the lines of the lattice.
        using Below = detail::SumsBelow<T>;
        Below line[2][n + 1];
        const auto find_line = [&](int i, Below(&below)[n + 1]) {
            for (int j = 0; j <= n; ++j)
                below[j] = Below(*table_, columns_.texel[i], rows_.texel[j], columns_.share_before[i],
                                 rows_.share_before[j]);
        };
        find_line(0, line[0]);
        for (int i = 0; i < n; ++i) {
            const Below(&left)[n + 1] = line[i % 2];
            const Below(&right)[n + 1] = line[(i + 1) % 2];
            find_line(i + 1, line[(i + 1) % 2]);
            T weights[n];
            for (int j = 0; j < n; ++j) {
                const auto weight =
                    (right[j + 1].weight - left[j + 1].weight) - (right[j].weight - left[j].weight);
                const auto solid_angle = (right[j + 1].solid_angle - left[j + 1].solid_angle) -
                                         (right[j].solid_angle - left[j].solid_angle);
                weights[j] =
                    angle[index_of(i, j)] *
                    mean_of({i, j, T(0), {T(0), T(0)}}, static_cast<T>(weight), static_cast<T>(solid_angle));
            }
            sums_.set_column(i, weights);
        }
        sums_.finish();
    }

    /// The mean radiance of a cell over that of the table.
    NUSSELT_HD T mean_of(const Cell& cell, const T& weight, const T& solid_angle) const noexcept {
        // Differences of this size may be rounding.
        constexpr T kLeast = power_of_two<T>(16);
        if (weight > kLeast && solid_angle > kLeast) return weight / solid_angle;
        const WindowSums<T> sums = window_of(cell).sums();
        return sums.solid_angle > T(0) ? sums.weight / sums.solid_angle : T(0);
    }

    /// Finds which cells the outline cuts, and replaces the angles of these and of those that the horizon cuts.
    NUSSELT_HD void clip_angles(T (&angle)[n * n]) noexcept {
        const Vec2<T> box_low{columns_.offset[0], rows_.offset[0]};
        const Vec2<T> box_high{columns_.offset[n], rows_.offset[n]};
        constexpr std::uint64_t kAll = ~std::uint64_t{0};
        const bool is_uncut = outline_.contains(box_low, box_high);
        whole_ = is_uncut ? kAll : 0;
        if (is_uncut && heights_of(box_low, box_high).x >= T(0)) return;
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const Cell cell{i, j, T(0), {T(0), T(0)}};
                const Vec2<T> low = low_of(cell);
                const Vec2<T> high = high_of(cell);
                if (!is_uncut && outline_.contains(low, high)) whole_ |= std::uint64_t{1} << index_of(i, j);
                const Vec2<T> heights = heights_of(low, high);
                if (!(heights.x >= T(0)) || !is_whole(cell))
                    angle[index_of(i, j)] = heights.y > T(0) ? clipped_angle(cell, low, high) : T(0);
            }
        }
    }

    /// The lowest and the highest corner of a rectangle of the image.
    NUSSELT_HD Vec2<T> heights_of(const Vec2<T>& low, const Vec2<T>& high) const noexcept {
        const T left = low.x * image_.side_x.z, right = high.x * image_.side_x.z;
        const T bottom = low.y * image_.side_y.z, top = high.y * image_.side_y.z;
        return {image_.corner.z + (min(left, right) + min(bottom, top)),
                image_.corner.z + (max(left, right) + max(bottom, top))};
    }

    /// The projected solid angle of what the horizon and the outline leave of a cell.
    NUSSELT_HD T clipped_angle(const Cell& cell, const Vec2<T>& low, const Vec2<T>& high) const noexcept {
        if (is_whole(cell)) return projected_solid_angle(rectangle_in(image_, low, high));
        constexpr int kCorners = TexturePart<T>::kMostCorners;
        const TexturePart<T> part = outline_.part_in(low, high);
        if (part.count < 3) return T(0);
        return projected_solid_angle(polygon_in<kCorners>(image_, part.corner, part.count));
    }

    NUSSELT_HD static int index_of(int column, int row) noexcept { return row * n + column; }
    NUSSELT_HD Vec2<T> low_of(const Cell& cell) const noexcept {
        return {columns_.offset[cell.column], rows_.offset[cell.row]};
    }
    NUSSELT_HD Vec2<T> high_of(const Cell& cell) const noexcept {
        return {columns_.offset[cell.column + 1], rows_.offset[cell.row + 1]};
    }
    NUSSELT_HD bool is_whole(const Cell& cell) const noexcept {
        return (whole_ >> index_of(cell.column, cell.row) & 1) != 0;
    }
    NUSSELT_HD TableWindow<T> window_of(const Cell& cell) const noexcept {
        return {*table_, columns_.axis, rows_.axis, columns_.interval(cell.column), rows_.interval(cell.row)};
    }
    NUSSELT_HD Vec2<T> clamped(const Vec2<T>& at, const Cell& cell) const noexcept {
        const Vec2<T> low = low_of(cell);
        const Vec2<T> high = high_of(cell);
        return {max(min(at.x, high.x), low.x), max(min(at.y, high.y), low.y)};
    }

    NUSSELT_HD Cell cell_at(const Vec2<T>& at) const noexcept {
        return sums_.cell(columns_.cell_at(at.x), rows_.cell_at(at.y));
    }

    /// Offsets of the point in a direction.
    NUSSELT_HD Vec2<T> offset_of(const Vec3<T>& p) const noexcept {
        const T z = dot(frame_.n, p);
        const T inverse = T(1) / max(z, std::numeric_limits<T>::min());
        return {(dot(frame_.t, p) - columns_.slopes.origin * z) * inverse,
                (dot(frame_.b, p) - rows_.slopes.origin * z) * inverse};
    }
    /// Where a direction meets the plane, and whether it is in the window, up to rounding.
    NUSSELT_HD Hit hit(const Vec3<T>& wi) const noexcept {
        const Vec2<T> at = offset_of(wi);
        const auto inside = [](const SlopeInterval<T>& x, const T& offset) {
            const T slope = x.origin + offset;
            const T rounding = 8 * std::numeric_limits<T>::epsilon() * (T(1) + slope * slope);
            return offset >= x.low - rounding && offset <= x.high + rounding;
        };
        return {at, dot(frame_.n, wi) > T(0) && inside(columns_.slopes, at.x) && inside(rows_.slopes, at.y)};
    }
    NUSSELT_HD Vec2<T> table_position(const Vec2<T>& texels) const noexcept {
        const auto at = [](const TableAxis<T>& axis, const T& offset) {
            return below_one((static_cast<T>(axis.texel) + (axis.fraction + offset)) /
                             static_cast<T>(axis.count));
        };
        return {at(columns_.axis, texels.x), at(rows_.axis, texels.y)};
    }

    /// Whether the table varies less in a cell than the cosine or the lobe, in terms of squared coefficients of variation.
    ///
    /// Those of the cosine come from its values at the corners and the centre. A peak between them is of the order of the solid
    /// angle of the cell, which that of its table has to exceed as well.
    NUSSELT_HD bool is_smooth(const Cell& cell, const TableWindow<T>& window) const noexcept {
        const T variation = window.variation();
        const Vec2<T> low = low_of(cell);
        const Vec2<T> high = high_of(cell);
        // Techniques for polygons have at most eight vertices.
        if (!is_whole(cell) && outline_.part_in(low, high).count > 8) return false;
        const Vec3<T> corner[4] = {plane_.point_at(low), plane_.point_at({high.x, low.y}),
                                   plane_.point_at(high), plane_.point_at({low.x, high.y})};
        Vec3<T> sum{T(0), T(0), T(0)};
        T value[5];
        for (int k = 0; k < 4; ++k) {
            const Vec3<T> wi = normalize(corner[k]);
            sum += wi;
            value[k] = measure_.integrand(wi);
        }
        value[4] = measure_.integrand(normalize(sum));
        const T mean =
            T(2) / T(3) * value[4] + T(1) / T(12) * ((value[0] + value[1]) + (value[2] + value[3]));
        const T inverse = mean > T(0) ? T(1) / mean : T(0);
        T spread = T(0);
        for (int k = 0; k < 5; ++k) {
            const T deviation = value[k] * inverse - T(1);
            spread += T(k < 4 ? 1 : 8) / T(12) * deviation * deviation;
        }

        const Vec3<T> centre = image_.point_at(T(0.5) * (low + high));
        const Vec3<T> area = cross((high.x - low.x) * image_.side_x, (high.y - low.y) * image_.side_y);
        const T squared = dot(centre, centre);
        const T solid_angle = abs(dot(area, centre)) / max(squared * sqrt(squared), kTiny<T>);
        return !(variation > solid_angle + 8 * std::numeric_limits<T>::epsilon()) || !(mean > T(0)) ||
               !(variation > spread);
    }

    /// f(technique) with the technique for the part of a cell inside of the outline.
    template <class Function>
    NUSSELT_HD auto with_technique(const Cell& cell, const Function& f) const noexcept {
        const Vec2<T> low = low_of(cell);
        const Vec2<T> high = high_of(cell);
        if (is_whole(cell)) return f(measure_.technique_for(rectangle_in(plane_, low, high)));
        TexturePart<T> part = outline_.part_in(low, high);
        // Nothing of a cell without weight is sampled, but a technique needs a polygon.
        if (part.count < 3) part = {{low, low, low}, 3};
        return f(measure_.technique_for(polygon_in<8>(plane_, part.corner, part.count < 8 ? part.count : 8)));
    }

    /// The density of a direction in a texel.
    NUSSELT_HD T texel_density(const Cell& cell, const TableWindow<T>& window, const WindowPoint<T>& point,
                               const Vec2<T>& at, const Vec3<T>& wi) const noexcept {
        if (!measure_.counts(wi) || !(is_whole(cell) || outline_.contains(at, at))) return T(0);
        const T p = columns_.slopes.origin + at.x;
        const T q = rows_.slopes.origin + at.y;
        const T texel = table_->texel_size.x * table_->texel_size.y * detail::rectified_jacobian(p, q);
        const T density = cell.probability * (window.pdf(point) / texel);
        return texel > T(0) ? min(density, std::numeric_limits<T>::max()) : T(0);
    }

    /// The mean of the channels of a cell, per their mean.
    NUSSELT_HD Vec3<T> hue_of(int column, int row) const noexcept {
        const TexelInterval<T> x = columns_.interval(column);
        const TexelInterval<T> y = rows_.interval(row);
        const auto at = [&](int i, int j) { return table_->colour[table_->index(i, j)]; };
        const Vec3<T> difference = (at(x.last + 1, y.last + 1) - at(x.first, y.last + 1)) -
                                   (at(x.last + 1, y.first) - at(x.first, y.first));
        const Vec3<T> positive = max(difference, Vec3<T>{T(0), T(0), T(0)});
        const T mean = mean_of_channels(positive);
        return mean > T(0) ? (T(1) / mean) * positive : Vec3<T>{T(1), T(1), T(1)};
    }

    const RectifiedTable<T>* table_;
    Measure measure_;
    Frame<T> frame_;
    T distance_;            ///< of the plane of the light
    TexturePlane<T> plane_; ///< at distance one, with offsets of slopes as coordinates
    TexturePlane<T> image_; ///< in the space where the measure is the projected solid angle
    TextureOutline<T> outline_;
    WindowLines<T, n> columns_, rows_;
    std::uint64_t whole_; ///< a bit for each cell: the outline does not cut it
    CellSums<T, n> sums_; ///< of mean radiance over that of the table, times angle
};

/// For glossy surfaces.
template <class T, int n = 8>
using WindowedPolygonLtc = WindowedPolygon<T, n, LobeCells<T>>;

NUSSELT_NAMESPACE_END
