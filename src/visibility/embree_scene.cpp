#include "visibility/embree_scene.h"

#include "visibility/embree_packets.h"
#include "visibility/tube_mesh.h"

#include <cstring>
#include <stdexcept>
#include <string>

namespace nusselt::visibility {

namespace {

constexpr unsigned kSurfaceGeometry = 0;
constexpr unsigned kTubeGeometry = 1;

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

template <int N>
void intersect(const void* scene, std::uint32_t active, const RayPacket<N>& rays, HitPacket<N>& hits) {
    ClosestHitQuery<N> query(active, rays);
    query.trace(embree_scene(scene));
    const auto& hit = query.packet.hit;
    for (int i = 0; i < N; ++i) {
        const auto primitive = static_cast<std::int32_t>(hit.primID[i]);
        const unsigned geometry = hit.geomID[i];
        hits.triangle[i] = geometry == kSurfaceGeometry ? primitive : -1;
        hits.tube[i] = geometry == kTubeGeometry ? primitive / kTrianglesPerTube : -1;
        hits.u[i] = hit.u[i];
        hits.v[i] = hit.v[i];
        hits.t[i] = query.packet.ray.tfar[i];
    }
}

template <int N>
std::uint32_t occluded(const void* scene, std::uint32_t active, const RayPacket<N>& rays) {
    ShadowQuery<N> query(active, rays);
    query.trace(embree_scene(scene));
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
