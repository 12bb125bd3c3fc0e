#include "lab/lines/line_by_line.h"

#include "base/stopwatch.h"
#include "lab/figures/pixel_centres.h"
#include "visibility/alpha.h"
#include "visibility/embree_builder.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace nusselt::lab {

namespace {

/// A binary hierarchy in plain arrays.
class BinaryHierarchy {
public:
    explicit BinaryHierarchy(const scene::Scene& scene) {
        std::vector<RTCBuildPrimitive> primitives;
        std::vector<LineOccluder> occluders;
        for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
            const scene::Material& material = scene.materials[scene.triangle_material[i]];
            if (visibility::presence_of(material) != visibility::Presence::full) continue;
            LineOccluder occluder;
            visibility::Box box;
            for (int k = 0; k < 3; ++k) {
                const scene::Float3& p = scene.positions[scene.triangles[i].vertex[k]];
                occluder.corner[k][0] = p.x;
                occluder.corner[k][1] = p.y;
                occluder.corner[k][2] = p.z;
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
        add(tree.root(), occluders);
    }

    const LineNode* nodes() const { return nodes_.empty() ? nullptr : nodes_.data(); }
    const LineOccluder* occluders() const { return occluders_.data(); }

private:
    /// \returns the index of the node
    std::uint32_t add(const visibility::BuiltNode& built, const std::vector<LineOccluder>& all) {
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
            const float lower[] = {b.lower_x, b.lower_y, b.lower_z};
            const float upper[] = {b.upper_x, b.upper_y, b.upper_z};
            for (int axis = 0; axis < 3; ++axis) {
                nodes_[index].centre[k][axis] = 0.5f * (lower[axis] + upper[axis]);
                nodes_[index].half[k][axis] = 0.5f * (upper[axis] - lower[axis]);
            }
            const std::uint32_t child = add(*inner.child[k], all);
            nodes_[index].child[k] = child;
        }
        return index;
    }

    std::vector<LineNode> nodes_;
    std::vector<LineOccluder> occluders_;
};

std::vector<LineEmitter> emitters_of(const scene::Scene& scene) {
    std::vector<LineEmitter> emitters;
    for (const scene::PolygonLight& light : scene.lights.of<scene::PolygonLight>()) {
        if (light.vertices.size() > LineEmitter::kMostVertices)
            throw std::runtime_error("lines one by one need lights with at most eight vertices");
        LineEmitter emitter = {static_cast<int>(light.vertices.size()), {}, light.two_sided};
        for (std::size_t i = 0; i < light.vertices.size(); ++i) {
            const scene::Float3& v = light.vertices[i];
            const float coordinates[] = {v.x, v.y, v.z};
            std::copy_n(coordinates, 3, emitter.vertex[i]);
        }
        emitters.push_back(emitter);
    }
    return emitters;
}

} // namespace

LineByLineWork& LineByLineWork::operator+=(const LineByLineWork& other) {
    counts.lines += other.counts.lines;
    counts.parts += other.counts.parts;
    counts.box_tests += other.counts.box_tests;
    counts.triangle_tests += other.counts.triangle_tests;
    counts.lost_parts += other.counts.lost_parts;
    seconds += other.seconds;
    return *this;
}

double LineByLineWork::seconds_per_line() const {
    return seconds / static_cast<double>(std::max<std::uint64_t>(counts.lines, 1));
}

render::RenderSettings settings_of_lines_together(int lines) {
    render::RenderSettings settings;
    settings.light_samples = render::LightSamples::lines;
    settings.lines.count = lines;
    settings.lines.many_occluders = render::ManyOccluders::lines;
    settings.lines.offsets = render::LineOffsets::length;
    settings.sample_order = render::SampleOrder::stratified;
    settings.pixel_position = render::PixelPosition::center;
    return settings;
}

std::vector<LinePoint> line_points(const scene::Scene& scene, const render_cpu::Renderer& renderer,
                                   int step) {
    const visibility::RayTracer tracer = renderer.visibility().tracer();
    std::vector<LinePoint> points;
    for (int y = step / 2; y < scene.film.height; y += step)
        for (int x = step / 2; x < scene.film.width; x += step) {
            const PixelCentre seen = see_centre(scene, tracer, x, y);
            if (seen.triangle < 0 || scene.triangle_light[static_cast<std::size_t>(seen.triangle)] >= 0)
                continue;
            const Vec3<float> apex = seen.position + shadow_ray_offset(scene, seen);
            points.push_back({static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.film.width) +
                                  static_cast<std::size_t>(x),
                              {apex.x, apex.y, apex.z},
                              {seen.normal.x, seen.normal.y, seen.normal.z}});
        }
    return points;
}

std::vector<LineByLineWork> trace_line_by_line(const scene::Scene& scene,
                                               const std::vector<LinePoint>& points, int lines, int threads) {
    if (!scene.instances.empty()) throw std::runtime_error("lines one by one need a scene without instances");
    const BinaryHierarchy hierarchy(scene);
    const std::vector<LineEmitter> emitters = emitters_of(scene);
    const LineWorld world = {hierarchy.nodes(), hierarchy.occluders(), emitters.data(),
                             static_cast<int>(emitters.size())};
    const TraceLines trace =
        base::dispatch(base::choose_isa(), []<base::Isa chosen> { return trace_lines_function<chosen>(); });
    std::vector<LineByLineWork> work(points.size());
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
            LineView view = {{}, {}, points[i].pixel, lines};
            std::copy_n(points[i].apex, 3, view.apex);
            std::copy_n(points[i].normal, 3, view.normal);
            const base::Stopwatch stopwatch;
            work[i].counts = trace(world, view);
            work[i].seconds = stopwatch.seconds();
        });
    });
    for (const LineByLineWork& one : work)
        if (one.counts.lost_parts > 0)
            throw std::runtime_error("occluders cut a line into more parts than there is room for");
    return work;
}

} // namespace nusselt::lab
