#include "lab/lines/line_by_line.h"

#include "base/stopwatch.h"
#include "proof/hostile/lights.h"
#include "visibility/alpha.h"
#include "visibility/embree_builder.h"

#include <nusselt/line_samples/visible_parts.h>
#include <nusselt/related/shadow_triangle_billen.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

namespace nusselt::lab {

namespace {

using Vector = Vec3<float>;

Vector vector(const scene::Float3& v) { return {v.x, v.y, v.z}; }
Vector vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

struct Occluder {
    Vector corner[3];
};

/// A binary hierarchy in plain arrays.
class BinaryHierarchy {
public:
    explicit BinaryHierarchy(const scene::Scene& scene) {
        std::vector<RTCBuildPrimitive> primitives;
        std::vector<Occluder> occluders;
        for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
            const scene::Material& material = scene.materials[scene.triangle_material[i]];
            if (visibility::presence_of(material) != visibility::Presence::full) continue;
            Occluder occluder;
            visibility::Box box;
            for (int k = 0; k < 3; ++k) {
                const scene::Float3& p = scene.positions[scene.triangles[i].vertex[k]];
                occluder.corner[k] = vector(p);
                box.add({p.x, p.y, p.z});
            }
            primitives.push_back(
                visibility::make_primitive(box, static_cast<std::uint32_t>(occluders.size())));
            occluders.push_back(occluder);
        }
        if (primitives.empty()) return;
        const visibility::Device device = visibility::make_device();
        const visibility::BuiltTree tree(device.get(), std::move(primitives),
                                         {.width = 2, .min_leaf_size = 1, .max_leaf_size = 4});
        root_ = add(tree.root(), occluders);
    }

    /// Takes what the scene hides from the parts of a line, all of whose occluders are found.
    /// \param extent of the line
    void trace(const ShadowTriangle<float>& triangle, const Interval<float>& extent,
               VisibleParts<float>& parts, LineByLineWork& work) const {
        if (nodes_.empty()) return;
        constexpr int kStackSize = 128;
        std::uint32_t stack[kStackSize];
        int size = 0;
        stack[size++] = root_;
        while (size > 0) {
            const Node& node = nodes_[stack[--size]];
            if (node.is_leaf) {
                for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                    ++work.triangle_tests;
                    const Interval<float> hidden = triangle.hidden_by(occluders_[i].corner);
                    if (!(hidden.begin < hidden.end)) continue;
                    const float length = extent.end - extent.begin;
                    parts.cut({extent.begin + hidden.begin * length, extent.begin + hidden.end * length});
                }
                continue;
            }
            for (std::uint32_t k = 0; k < node.count; ++k) {
                ++work.box_tests;
                if (triangle.overlaps(node.centre[k], node.half[k])) stack[size++] = node.child[k];
            }
        }
    }

private:
    struct Node {
        bool is_leaf;
        std::uint32_t count; ///< of children or triangles
        std::uint32_t first; ///< triangle of a leaf
        std::uint32_t child[2];
        Vector centre[2], half[2]; ///< of the boxes of children
    };

    std::uint32_t add(const visibility::BuiltNode& built, const std::vector<Occluder>& all) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back(
            {built.is_leaf, built.count, static_cast<std::uint32_t>(occluders_.size()), {}, {}, {}});
        if (built.is_leaf) {
            const auto& leaf = static_cast<const visibility::BuiltLeaf&>(built);
            for (std::uint32_t i = 0; i < leaf.count; ++i) occluders_.push_back(all[leaf.primitive[i]]);
            return index;
        }
        const auto& inner = static_cast<const visibility::BuiltInner&>(built);
        for (std::uint32_t k = 0; k < inner.count; ++k) {
            const RTCBounds& b = inner.bounds[k];
            const Vector lower{b.lower_x, b.lower_y, b.lower_z};
            const Vector upper{b.upper_x, b.upper_y, b.upper_z};
            nodes_[index].centre[k] = 0.5f * (lower + upper);
            nodes_[index].half[k] = 0.5f * (upper - lower);
            const std::uint32_t child = add(*inner.child[k], all);
            nodes_[index].child[k] = child;
        }
        return index;
    }

    std::vector<Node> nodes_;
    std::vector<Occluder> occluders_;
    std::uint32_t root_ = 0;
};

constexpr int kMostVertices = 8;
constexpr int kMostParts = 4096;

/// The lines of one light for one point.
void trace_lines(const BinaryHierarchy& hierarchy, const scene::PolygonLight& light, const LinePoint& from,
                 int lines, hostile::RandomSource& random, std::vector<Interval<float>>& memory,
                 LineByLineWork& work) {
    const Vector apex = vector(from.apex);
    const Vector normal = vector(from.normal);
    Vector vertices[kMostVertices] = {};
    float highest = 0;
    for (std::size_t i = 0; i < light.vertices.size(); ++i) {
        vertices[i] = vector(light.vertices[i]);
        highest = std::max(highest, dot(normal, vertices[i] - apex));
    }
    const auto polygon = make_polygon<kMostVertices>(vertices, static_cast<int>(light.vertices.size()));
    const bool is_behind = !light.two_sided && dot(polygon.normal, vertices[0] - apex) >= 0;
    if (is_behind || highest <= 0) return;
    const LineFamily<float, kMostVertices> family(polygon, kPi<float> * static_cast<float>(random.uniform()));
    const LinePlane<float>& plane = family.plane();
    VisibleParts<float> parts(memory.data(), static_cast<int>(memory.size()));
    work.lines += static_cast<std::uint64_t>(lines);
    for (int k = 0; k < lines; ++k) {
        const auto u = static_cast<float>((k + random.uniform()) / lines);
        const LineChoice<float> choice = family.sample_by_length(std::min(u, 1 - 1e-7f));
        const Interval<float> chord = family.chord(choice.offset).extent;
        const auto at = [&](float t) {
            return fma(t, plane.along, fma(choice.offset, plane.across, plane.origin));
        };
        const Interval<float> extent =
            part_above_horizon(at(chord.begin) - apex, at(chord.end) - apex, normal, chord);
        parts.reset(extent);
        if (!(extent.begin < extent.end)) continue;
        const ShadowTriangle<float> triangle(apex, at(extent.begin), at(extent.end));
        hierarchy.trace(triangle, extent, parts, work);
        for (int i = 0; i < parts.count(); ++i) work.parts += parts[i].begin < parts[i].end ? 1 : 0;
    }
}

} // namespace

LineByLineWork& LineByLineWork::operator+=(const LineByLineWork& other) {
    lines += other.lines;
    parts += other.parts;
    box_tests += other.box_tests;
    triangle_tests += other.triangle_tests;
    seconds += other.seconds;
    return *this;
}

std::vector<LinePoint> line_points(const scene::Scene& scene, const render_cpu::Renderer& renderer,
                                   int step) {
    // As the renderer has it, see src/render_cpu/kernel/surface.h.
    constexpr float kOffsetPerRadius = 1e-5f;
    const visibility::RayTracer rays_of_scene = renderer.visibility().tracer();
    const visibility::PacketTracer<4>& tracer = rays_of_scene;
    const scene::Camera& camera = scene.camera;
    std::vector<LinePoint> points;
    for (int y = step / 2; y < scene.film.height; y += step)
        for (int x = step / 2; x < scene.film.width; x += step) {
            const float px = static_cast<float>(x) + 0.5f;
            const float py = static_cast<float>(y) + 0.5f;
            const Vector origin =
                vector(camera.origin) + px * vector(camera.origin_right) + py * vector(camera.origin_down);
            const Vector direction =
                vector(camera.corner) + px * vector(camera.right) + py * vector(camera.down);
            visibility::RayPacket<4> rays = {};
            visibility::HitPacket<4> hits = {};
            const float columns[2][3] = {{origin.x, origin.y, origin.z},
                                         {direction.x, direction.y, direction.z}};
            for (int axis = 0; axis < 3; ++axis) {
                rays.origin[axis][0] = columns[0][axis];
                rays.direction[axis][0] = columns[1][axis];
            }
            rays.t_far[0] = std::numeric_limits<float>::infinity();
            tracer.intersect(rays_of_scene.context, 1, rays, hits);
            if (hits.triangle[0] < 0) continue;
            const auto triangle = static_cast<std::size_t>(hits.triangle[0]);
            if (scene.triangle_light[triangle] >= 0) continue;
            const auto corner = [&](int k) {
                return vector(scene.positions[scene.triangles[triangle].vertex[k]]);
            };
            const Vector e1 = corner(1) - corner(0);
            const Vector e2 = corner(2) - corner(0);
            const Vector front = normalize(cross(e1, e2));
            const Vector normal = dot(front, direction) > 0 ? -front : front;
            const Vector position = corner(0) + hits.u[0] * e1 + hits.v[0] * e2;
            const Vector apex = position + (kOffsetPerRadius * static_cast<float>(scene.radius)) * normal;
            points.push_back({static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.film.width) +
                                  static_cast<std::size_t>(x),
                              {apex.x, apex.y, apex.z},
                              {normal.x, normal.y, normal.z}});
        }
    return points;
}

std::vector<LineByLineWork> trace_line_by_line(const scene::Scene& scene,
                                               const std::vector<LinePoint>& points, int lines, int threads) {
    if (!scene.instances.empty()) throw std::runtime_error("lines one by one need a scene without instances");
    const BinaryHierarchy hierarchy(scene);
    std::vector<LineByLineWork> work(points.size());
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
            const base::Stopwatch stopwatch;
            std::vector<Interval<float>> memory(kMostParts);
            hostile::RandomSource random(1, points[i].pixel);
            for (const scene::PolygonLight& light : scene.lights.of<scene::PolygonLight>())
                trace_lines(hierarchy, light, points[i], lines, random, memory, work[i]);
            work[i].seconds = stopwatch.seconds();
        });
    });
    return work;
}

} // namespace nusselt::lab
