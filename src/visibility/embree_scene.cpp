#include "visibility/embree_scene.h"

#include "scene/model/lights/light_geometry.h"
#include "visibility/alpha.h"
#include "visibility/embree_device.h"
#include "visibility/embree_packets.h"
#include "visibility/round_surfaces.h"
#include "visibility/scene_parts.h"

#include <cstring>

namespace nusselt::visibility {

namespace {

/// Scenes with this many triangles are stored compactly; see docs/performance.md.
constexpr std::size_t kManyTriangles = 2'000'000;

struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct BufferDeleter {
    void operator()(RTCBuffer buffer) const { rtcReleaseBuffer(buffer); }
};
struct GeometryDeleter {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using SceneHandle = std::unique_ptr<RTCSceneTy, SceneDeleter>;
using Buffer = std::unique_ptr<RTCBufferTy, BufferDeleter>;
using Geometry = std::unique_ptr<RTCGeometryTy, GeometryDeleter>;

/// Lets rays pass surfaces that are partly there. Called by Embree for hits on kPartialGeometry of a part.
void filter_hits(const RTCFilterFunctionNArguments* arguments) {
    const auto& part = *static_cast<const ScenePart*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] == 0) continue;
        RTCHitN* hit = arguments->hit;
        RTCRayN* ray = arguments->ray;
        const std::uint32_t triangle = part.partial[RTCHitN_primID(hit, n, i)];
        const float alpha = alpha_at(*part.scene, triangle, RTCHitN_u(hit, n, i), RTCHitN_v(hit, n, i));
        const float random =
            random_of_hit({RTCRayN_org_x(ray, n, i), RTCRayN_org_y(ray, n, i), RTCRayN_org_z(ray, n, i)},
                          {RTCRayN_dir_x(ray, n, i), RTCRayN_dir_y(ray, n, i), RTCRayN_dir_z(ray, n, i)},
                          triangle, RTCHitN_instID(hit, n, i, 0));
        if (!(random < alpha)) arguments->valid[i] = 0;
    }
}

/// A buffer of Embree's own, as it reads 16 bytes at a time, also at the last vertex.
Buffer make_position_buffer(RTCDevice device, const std::vector<scene::Float3>& positions) {
    const std::size_t bytes = positions.size() * sizeof(scene::Float3);
    Buffer buffer(rtcNewBuffer(device, bytes + sizeof(scene::Float3)));
    check_for_error(device);
    std::memcpy(rtcGetBufferData(buffer.get()), positions.data(), bytes);
    return buffer;
}

Geometry make_triangle_geometry(RTCDevice device, RTCBuffer positions, std::size_t position_count) {
    Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    rtcSetGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions, 0,
                         sizeof(scene::Float3), position_count);
    return geometry;
}

/// Indices that outlive the geometry.
void share_indices(RTCGeometry geometry, const scene::Triangle* triangles, std::size_t count) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles, 0,
                               sizeof(scene::Triangle), count);
}

void copy_indices(RTCDevice device, RTCGeometry geometry, const std::vector<scene::Triangle>& triangles,
                  const std::vector<std::uint32_t>& chosen) {
    auto* target = static_cast<scene::Triangle*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(scene::Triangle), chosen.size()));
    check_for_error(device);
    for (const std::uint32_t triangle : chosen) *target++ = triangles[triangle];
}

void attach(RTCDevice device, RTCScene scene, RTCGeometry geometry, unsigned id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    check_for_error(device);
}

SceneHandle make_scene(RTCDevice device, std::size_t triangle_count) {
    SceneHandle scene(rtcNewScene(device));
    // Watertight: without this, rays through shared edges may pass between triangles. Costs a tenth of the time.
    unsigned flags = RTC_SCENE_FLAG_ROBUST;
    if (triangle_count >= kManyTriangles) flags |= RTC_SCENE_FLAG_COMPACT;
    rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(flags));
    return scene;
}

void commit(RTCDevice device, RTCScene scene) {
    // Unlike rtcCommitScene(), this function stays in the arena of the caller.
    rtcJoinCommitScene(scene);
    check_for_error(device);
}

/// Copies the positions of hits on their triangles.
template <int N>
void copy_places(const ClosestHitQuery<N>& query, HitPacket<N>& hits) {
    std::memcpy(hits.u, query.packet.hit.u, sizeof hits.u);
    std::memcpy(hits.v, query.packet.hit.v, sizeof hits.v);
    std::memcpy(hits.t, query.packet.ray.tfar, sizeof hits.t);
}

template <class Hits, int N>
void copy_round_hit(const RoundSurface& surface, const Hits& hit, int i, HitPacket<N>& hits) {
    const float point[] = {hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]};
    for (int k = 0; k < 3; ++k) hits.unit[k][i] = point[k];
    const scene::Float2 uv = texture_coordinates(surface, {point[0], point[1], point[2]});
    hits.u[i] = uv.x;
    hits.v[i] = uv.y;
    hits.triangle[i] = static_cast<std::int32_t>(surface.triangle);
    hits.round[i] = static_cast<std::int32_t>(surface.light);
}

/// Intersects scenes without instances, partially opaque surfaces and round lights.
template <int N>
void intersect_plain(const void* context, std::uint32_t active, const RayPacket<N>& rays,
                     HitPacket<N>& hits) {
    const TracedScene& scene = traced_scene(context);
    ClosestHitQuery<N> query(active, rays);
    query.trace(scene);
    copy_places(query, hits);
    const auto& hit = query.packet.hit;
    for (int i = 0; i < N; ++i) {
        const auto primitive = static_cast<std::int32_t>(hit.primID[i]);
        const unsigned geometry = hit.geomID[i];
        hits.triangle[i] = geometry == kFullGeometry ? primitive : -1;
        hits.instance[i] = hits.round[i] = -1;
        hits.light[i] = geometry == kLightGeometry ? scene.light_of(hit.primID[i]) : -1;
    }
}

template <int N>
void intersect(const void* context, std::uint32_t active, const RayPacket<N>& rays, HitPacket<N>& hits) {
    const TracedScene& scene = traced_scene(context);
    ClosestHitQuery<N> query(active, rays);
    query.trace(scene);
    copy_places(query, hits);
    const auto& hit = query.packet.hit;
    for (int i = 0; i < N; ++i) {
        hits.triangle[i] = hits.instance[i] = hits.light[i] = hits.round[i] = -1;
        const unsigned geometry = hit.geomID[i];
        const unsigned primitive = hit.primID[i];
        const unsigned instance = hit.instID[0][i];
        if (geometry == RTC_INVALID_GEOMETRY_ID) continue;
        if (geometry == kLightGeometry) {
            hits.light[i] = scene.light_of(primitive);
            continue;
        }
        if (geometry == kRoundGeometry && instance == RTC_INVALID_GEOMETRY_ID) {
            copy_round_hit(scene.round_surfaces[primitive], hit, i, hits);
            continue;
        }
        const ScenePart& part = scene.part_of(instance);
        hits.triangle[i] = static_cast<std::int32_t>(part.triangle_of(geometry, primitive));
        if (instance != RTC_INVALID_GEOMETRY_ID)
            hits.instance[i] = static_cast<std::int32_t>(instance - kFirstInstance);
    }
}

template <int N>
std::uint32_t occluded(const void* context, std::uint32_t active, const RayPacket<N>& rays) {
    ShadowQuery<N> query(active, rays);
    query.trace(traced_scene(context));
    std::uint32_t blocked = 0;
    for (int i = 0; i < N; ++i) {
        // Embree sets tfar to minus infinity where something is in the way.
        const bool is_blocked = query.valid[i] == 0 || query.packet.tfar[i] < 0;
        blocked |= static_cast<std::uint32_t>(is_blocked) << i;
    }
    return blocked & active;
}

} // namespace

struct EmbreeScene::State {
    explicit State(const scene::Scene& scene_to_trace);

    void attach_part(RTCScene target, const ScenePart& part);
    void attach_round_lights();
    void make_seen();
    void attach_instances();

    const scene::Scene& scene;
    Device device = make_device();
    Buffer positions;
    TracedScene traced; // before the scenes, which point to it
    std::vector<SceneHandle> objects;
    SceneHandle world, seen;
};

EmbreeScene::State::State(const scene::Scene& scene_to_trace) : scene(scene_to_trace) {
    if (!scene.triangles.empty()) positions = make_position_buffer(device.get(), scene.positions);
    traced.scene = &scene;
    // Filters point to the parts: these must stay where they are.
    traced.parts = make_parts(scene);
    traced.round_surfaces = make_round_surfaces(scene);
    for (std::size_t i = 1; i < traced.parts.size(); ++i) {
        objects.push_back(make_scene(device.get(), scene.triangles.size()));
        attach_part(objects.back().get(), traced.parts[i]);
        commit(device.get(), objects.back().get());
    }
    world = make_scene(device.get(), scene.triangles.size());
    attach_part(world.get(), traced.parts[0]);
    attach_round_lights();
    attach_instances();
    commit(device.get(), world.get());
    traced.all = world.get();
    make_seen();
    // The scene keeps what it needs of them.
    positions.reset();
    objects.clear();
}

void EmbreeScene::State::attach_part(RTCScene target, const ScenePart& part) {
    const auto make_geometry = [&] {
        return make_triangle_geometry(device.get(), positions.get(), scene.positions.size());
    };
    if (part.is_full ? part.triangle_count > 0 : !part.full.empty()) {
        const Geometry geometry = make_geometry();
        if (part.is_full)
            share_indices(geometry.get(), scene.triangles.data() + part.first_triangle, part.triangle_count);
        else
            copy_indices(device.get(), geometry.get(), scene.triangles, part.full);
        attach(device.get(), target, geometry.get(), kFullGeometry);
    }
    if (part.partial.empty()) return;
    const Geometry geometry = make_geometry();
    copy_indices(device.get(), geometry.get(), scene.triangles, part.partial);
    rtcSetGeometryUserData(geometry.get(), const_cast<ScenePart*>(&part));
    rtcSetGeometryIntersectFilterFunction(geometry.get(), filter_hits);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), filter_hits);
    attach(device.get(), target, geometry.get(), kPartialGeometry);
}

void EmbreeScene::State::attach_round_lights() {
    if (traced.round_surfaces.empty()) return;
    const Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
    set_surfaces(geometry.get(), traced.round_surfaces);
    attach(device.get(), world.get(), geometry.get(), kRoundGeometry);
}

void EmbreeScene::State::make_seen() {
    scene::LightMesh mesh = make_light_mesh(scene);
    if (mesh.triangles.empty()) return;
    seen = make_scene(device.get(), mesh.triangles.size());
    const Buffer mesh_positions = make_position_buffer(device.get(), mesh.positions);
    const Geometry geometry =
        make_triangle_geometry(device.get(), mesh_positions.get(), mesh.positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(scene::Triangle), mesh.triangles.size());
    check_for_error(device.get());
    std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * sizeof(scene::Triangle));
    attach(device.get(), seen.get(), geometry.get(), kLightGeometry);
    traced.lights = std::move(mesh.lights);
    commit(device.get(), seen.get());
    traced.seen = seen.get();
}

void EmbreeScene::State::attach_instances() {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const scene::Instance& instance = scene.instances[i];
        const Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
        rtcSetGeometryInstancedScene(geometry.get(), objects[instance.object].get());
        rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR,
                                instance.world_from_object.data());
        attach(device.get(), world.get(), geometry.get(), kFirstInstance + static_cast<unsigned>(i));
    }
}

EmbreeScene::EmbreeScene(const scene::Scene& scene) : state_(std::make_unique<State>(scene)) {}

EmbreeScene::~EmbreeScene() = default;
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;

RayTracer EmbreeScene::tracer() const {
    const TracedScene& traced = state_->traced;
    if (traced.parts.size() == 1 && traced.parts[0].is_full)
        return {{intersect_plain<4>, occluded<4>},
                {intersect_plain<8>, occluded<8>},
                {intersect_plain<16>, occluded<16>},
                &traced};
    return {{intersect<4>, occluded<4>}, {intersect<8>, occluded<8>}, {intersect<16>, occluded<16>}, &traced};
}

} // namespace nusselt::visibility
