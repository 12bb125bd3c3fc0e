#include "line_queries.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nusselt::visibility_test {

namespace {

constexpr int kPartCapacity = 256;

Vec3<float> to_vec(const scene::Float3& p) { return {p.x, p.y, p.z}; }

LineFamily<float, 4> family_of(const scene::Scene& scene, const LineQuery& query) {
    return {polygon_of(scene, query.light), query.angle};
}

/// The lines of a query, whole, with offsets at the centres of equal strata.
std::vector<Chord<float>> chords(const scene::Scene& scene, const LineQuery& query) {
    const LineFamily<float, 4> family = family_of(scene, query);
    std::vector<Chord<float>> result;
    for (int i = 0; i < query.line_count; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(query.line_count);
        result.push_back(family.chord(family.sample_by_length(u).offset));
    }
    return result;
}

template <class Real>
VisibleLine line_of(const Chord<float>& whole, const VisibleParts<Real>& parts, int lane) {
    VisibleLine line{whole, {}};
    for (int k = 0; k < parts.count(); ++k) {
        const Interval<float> part{parts[k].begin.lane(lane), parts[k].end.lane(lane)};
        if (!(part.begin >= part.end)) line.parts.push_back(part);
    }
    std::sort(line.parts.begin(), line.parts.end(),
              [](const auto& a, const auto& b) { return a.begin < b.begin; });
    return line;
}

double length_of(const Interval<float>& part) { return double{part.end} - part.begin; }

double common_length(const VisibleLine& a, const VisibleLine& b) {
    double length = 0;
    for (const auto& x : a.parts)
        for (const auto& y : b.parts)
            length += std::max(0.0, length_of({std::max(x.begin, y.begin), std::min(x.end, y.end)}));
    return length;
}

double visible_length(const VisibleLine& line) {
    double length = 0;
    for (const auto& part : line.parts) length += length_of(part);
    return length;
}

double whole_length(const std::vector<VisibleLine>& lines) {
    double length = 0;
    for (const VisibleLine& line : lines) length += length_of(line.whole.extent);
    return length;
}

} // namespace

ConvexPolygon<float, 4> polygon_of(const scene::Scene& scene, std::int32_t light) {
    const auto& vertices = scene.lights.of<scene::PolygonLight>()[static_cast<std::size_t>(light)].vertices;
    const Vec3<float> corners[] = {to_vec(vertices[0]), to_vec(vertices[1]), to_vec(vertices[2]),
                                   to_vec(vertices[3])};
    return make_polygon<4>(corners, 4);
}

SeenLight seen_light(const scene::Scene& scene, const LineQuery& query) {
    return see_light(polygon_of(scene, query.light), family_of(scene, query), query.point, query.light);
}

template <int kLanes>
std::vector<VisibleLine> trace(const scene::Scene& scene, const visibility::LineBvh& bvh,
                               const LineQuery& query) {
    using Real = Pack<float, kLanes>;
    const std::vector<Chord<float>> wholes = chords(scene, query);
    const int pack_count = (query.line_count + kLanes - 1) / kLanes;
    std::vector<Interval<Real>> storage(static_cast<std::size_t>(pack_count * kPartCapacity));
    std::vector<TracedLines<Real>> packs;
    for (int p = 0; p < pack_count; ++p) {
        Chord<Real> lines{Real(0), {Real(0), Real(0)}};
        for (int i = 0; i < kLanes && p * kLanes + i < query.line_count; ++i) {
            const Chord<float>& whole = wholes[static_cast<std::size_t>(p * kLanes + i)];
            lines.offset.set_lane(i, whole.offset);
            lines.extent.begin.set_lane(i, whole.extent.begin);
            lines.extent.end.set_lane(i, whole.extent.end);
        }
        packs.push_back(
            {lines.offset,
             VisibleParts<Real>(&storage[static_cast<std::size_t>(p * kPartCapacity)], kPartCapacity)});
        packs.back().parts.reset(lines.extent);
    }
    const visibility::LineBvhView view = bvh.view();
    visibility::LineCounters counters{};
    const SeenLight seen = seen_light(scene, query);
    for (int p = 0; p < pack_count; p += kLargestLinePackCount)
        LineTracer<Real>(view, seen, packs.data() + p, std::min(pack_count - p, kLargestLinePackCount),
                         counters)
            .trace();
    std::vector<VisibleLine> result;
    for (int i = 0; i < query.line_count; ++i)
        result.push_back(line_of(wholes[static_cast<std::size_t>(i)],
                                 packs[static_cast<std::size_t>(i / kLanes)].parts, i % kLanes));
    return result;
}

template std::vector<VisibleLine> trace<4>(const scene::Scene&, const visibility::LineBvh&, const LineQuery&);
template std::vector<VisibleLine> trace<8>(const scene::Scene&, const visibility::LineBvh&, const LineQuery&);
template std::vector<VisibleLine> trace<16>(const scene::Scene&, const visibility::LineBvh&,
                                            const LineQuery&);

std::vector<VisibleLine> cut_by_all(const scene::Scene& scene, const LineQuery& query) {
    using Real = Pack<float, 4>;
    const ShadowFrame<float> frame = seen_light(scene, query).frame;
    std::vector<VisibleLine> result;
    for (const Chord<float>& whole : chords(scene, query)) {
        std::vector<Interval<Real>> storage(kPartCapacity);
        VisibleParts<Real> parts(storage.data(), kPartCapacity);
        parts.reset({Real(whole.extent.begin), Real(whole.extent.end)});
        for (std::size_t i = 0; i < scene::world_triangle_count(scene); ++i) {
            if (scene.triangle_light[i] == query.light || scene.triangle_material[i] != 0) continue;
            std::array<std::array<float, 3>, 3> corner;
            for (std::size_t k = 0; k < 3; ++k) {
                const scene::Float3& p = scene.positions[scene.triangles[i].vertex[k]];
                corner[k] = {p.x, p.y, p.z};
            }
            std::sort(corner.begin(), corner.end());
            const auto at = [&](std::size_t k) {
                return Vec3<float>{corner[k][0], corner[k][1], corner[k][2]};
            };
            const TriangleShadows<float> shadows = make_triangle_shadow(frame, at(0), at(1), at(2));
            const Real offset = whole.offset;
            parts.cut(shadows.partial
                          ? hidden_interval(make_partial_shadow(frame, at(0), at(1), at(2)), offset)
                          : hidden_interval(broadcast<Real>(shadows.shadow), offset));
        }
        result.push_back(line_of(whole, parts, 0));
    }
    return result;
}

double difference(const std::vector<VisibleLine>& a, const std::vector<VisibleLine>& b) {
    double length = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        length += visible_length(a[i]) + visible_length(b[i]) - 2 * common_length(a[i], b[i]);
    return length / whole_length(a);
}

double visible_share(const std::vector<VisibleLine>& lines) {
    double length = 0;
    for (const VisibleLine& line : lines) length += visible_length(line);
    return length / whole_length(lines);
}

bool are_valid(const std::vector<VisibleLine>& lines) {
    for (const VisibleLine& line : lines) {
        float last = line.whole.extent.begin;
        for (const Interval<float>& part : line.parts) {
            if (!(part.begin >= last && part.end > part.begin && part.end <= line.whole.extent.end))
                return false;
            last = part.end;
        }
    }
    return true;
}

} // namespace nusselt::visibility_test
