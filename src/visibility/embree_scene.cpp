#include "visibility/embree_scene.h"

#include "visibility/tube_mesh.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace nusselt::visibility {

namespace {

constexpr unsigned kSurfaceGeometry = 0;
constexpr unsigned kTubeGeometry = 1;

// Bits of the ray masks.
constexpr unsigned kSurfaceMask = 1;
constexpr unsigned kTubeMask = 2;

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using SceneHandle = std::unique_ptr<RTCSceneTy, SceneDeleter>;

[[noreturn]] void throw_embree_error(RTCError code) {
    if (code == RTC_ERROR_OUT_OF_MEMORY)
        throw std::runtime_error("not enough memory for the bounding volume hierarchy of the scene");
    if (code == RTC_ERROR_UNSUPPORTED_CPU) throw std::runtime_error("Embree does not support this processor");
    throw std::runtime_error("Embree reports error " + std::to_string(code) + " while it builds the scene");
}

void check_for_error(RTCDevice device) {
    if (const RTCError code = rtcGetDeviceError(device); code != RTC_ERROR_NONE) throw_embree_error(code);
}

Device make_device() {
    Device device(rtcNewDevice(nullptr));
    if (!device) throw_embree_error(rtcGetDeviceError(nullptr));
    if (rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) == 0)
        throw std::runtime_error("this Embree was built without ray masks (EMBREE_RAY_MASK)");
    return device;
}

void attach_triangles(RTCDevice device, RTCScene scene, const std::vector<scene::Float3>& positions,
                      const std::vector<scene::Triangle>& triangles, unsigned id, unsigned mask) {
    if (triangles.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree allocates and pads: it reads 16 bytes at a time, also at the last vertex.
    void* vertex_buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  sizeof(scene::Float3), positions.size());
    void* index_buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                 sizeof(scene::Triangle), triangles.size());
    if (vertex_buffer != nullptr && index_buffer != nullptr) {
        std::memcpy(vertex_buffer, positions.data(), positions.size() * sizeof(scene::Float3));
        std::memcpy(index_buffer, triangles.data(), triangles.size() * sizeof(scene::Triangle));
    }
    rtcSetGeometryMask(geometry, mask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
    check_for_error(device);
}

/// Lanes that Embree can take: without branches, so that it vectorises.
template <int N>
void mark_valid_lanes(std::uint32_t active, const RayPacket<N>& rays, int* valid) {
    for (int i = 0; i < N; ++i) {
        float largest = 0;
        bool ordered = rays.t_far[i] >= 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float origin = std::fabs(rays.origin[axis][i]);
            const float direction = std::fabs(rays.direction[axis][i]);
            ordered = ordered & (origin <= kLargestRayCoordinate) & (direction <= kLargestRayCoordinate);
            largest = largest > direction ? largest : direction;
        }
        valid[i] = -static_cast<int>(ordered & (largest > 0) & ((active >> i & 1u) != 0));
    }
}

template <class EmbreeRays, int N>
void copy_rays(const RayPacket<N>& rays, unsigned mask, EmbreeRays& target) {
    static_assert(sizeof target.org_x == sizeof rays.t_far);
    std::memcpy(target.org_x, rays.origin[0], sizeof target.org_x);
    std::memcpy(target.org_y, rays.origin[1], sizeof target.org_y);
    std::memcpy(target.org_z, rays.origin[2], sizeof target.org_z);
    std::memcpy(target.dir_x, rays.direction[0], sizeof target.dir_x);
    std::memcpy(target.dir_y, rays.direction[1], sizeof target.dir_y);
    std::memcpy(target.dir_z, rays.direction[2], sizeof target.dir_z);
    std::memcpy(target.tfar, rays.t_far, sizeof target.tfar);
    for (int i = 0; i < N; ++i) {
        target.tnear[i] = 0;
        target.time[i] = 0;
        target.mask[i] = mask;
        target.id[i] = 0;
        target.flags[i] = 0;
    }
}

/// What differs between the packet widths of Embree.
template <int N>
struct Embree;
template <>
struct Embree<4> {
    using Rays = RTCRay4;
    using RayHits = RTCRayHit4;
    static constexpr auto intersect = rtcIntersect4;
    static constexpr auto occluded = rtcOccluded4;
};
template <>
struct Embree<8> {
    using Rays = RTCRay8;
    using RayHits = RTCRayHit8;
    static constexpr auto intersect = rtcIntersect8;
    static constexpr auto occluded = rtcOccluded8;
};
template <>
struct Embree<16> {
    using Rays = RTCRay16;
    using RayHits = RTCRayHit16;
    static constexpr auto intersect = rtcIntersect16;
    static constexpr auto occluded = rtcOccluded16;
};

template <int N>
void intersect(const void* scene, std::uint32_t active, const RayPacket<N>& rays, HitPacket<N>& hits) {
    alignas(64) int valid[N];
    mark_valid_lanes(active, rays, valid);
    typename Embree<N>::RayHits query;
    copy_rays(rays, kSurfaceMask | kTubeMask, query.ray);
    for (int i = 0; i < N; ++i) query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    Embree<N>::intersect(valid, static_cast<RTCScene>(const_cast<void*>(scene)), &context, &query);
    for (int i = 0; i < N; ++i) {
        const auto primitive = static_cast<std::int32_t>(query.hit.primID[i]);
        const unsigned geometry = query.hit.geomID[i];
        hits.triangle[i] = geometry == kSurfaceGeometry ? primitive : -1;
        hits.tube[i] = geometry == kTubeGeometry ? primitive / kTrianglesPerTube : -1;
        hits.u[i] = query.hit.u[i];
        hits.v[i] = query.hit.v[i];
    }
}

template <int N>
std::uint32_t occluded(const void* scene, std::uint32_t active, const RayPacket<N>& rays) {
    alignas(64) int valid[N];
    mark_valid_lanes(active, rays, valid);
    typename Embree<N>::Rays query;
    copy_rays(rays, kSurfaceMask, query);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    Embree<N>::occluded(valid, static_cast<RTCScene>(const_cast<void*>(scene)), &context, &query);
    std::uint32_t blocked = 0;
    for (int i = 0; i < N; ++i) {
        // Embree sets tfar to minus infinity where something is in the way.
        const bool is_blocked = valid[i] == 0 || query.tfar[i] < 0;
        blocked |= static_cast<std::uint32_t>(is_blocked) << i;
    }
    return blocked & active;
}

} // namespace

struct EmbreeScene::State {
    Device device;
    SceneHandle scene;
};

EmbreeScene::EmbreeScene(const scene::Scene& scene) : state_(std::make_unique<State>()) {
    state_->device = make_device();
    state_->scene.reset(rtcNewScene(state_->device.get()));
    // Watertight: without this, rays through shared edges may pass between triangles. Costs a tenth of the
    // time.
    rtcSetSceneFlags(state_->scene.get(), RTC_SCENE_FLAG_ROBUST);
    attach_triangles(state_->device.get(), state_->scene.get(), scene.positions, scene.triangles,
                     kSurfaceGeometry, kSurfaceMask);
    const TubeMesh tubes = make_tube_mesh(scene.line_lights);
    attach_triangles(state_->device.get(), state_->scene.get(), tubes.positions, tubes.triangles,
                     kTubeGeometry, kTubeMask);
    // Unlike rtcCommitScene() this keeps to the arena of the caller.
    rtcJoinCommitScene(state_->scene.get());
    check_for_error(state_->device.get());
}

EmbreeScene::~EmbreeScene() = default;
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;

RayTracer EmbreeScene::tracer() const {
    return {{intersect<4>, occluded<4>},
            {intersect<8>, occluded<8>},
            {intersect<16>, occluded<16>},
            state_->scene.get()};
}

} // namespace nusselt::visibility
