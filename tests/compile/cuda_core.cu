/// Kernels that use the library on a device: closed forms of polygons, and each technique for polygons.

#include <nusselt/geometry/polygon_measures.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

/// One shading point and two random numbers per thread.
struct Inputs {
    const nusselt::Vec3<float>* corners;
    const nusselt::Vec3<float>* points;
    const nusselt::Vec3<float>* normals;
    const nusselt::Vec2<float>* u;
};

__device__ inline int thread_index() { return static_cast<int>(__nvvm_read_ptx_sreg_tid_x()); }

__device__ inline nusselt::ConvexPolygon<float, 4> local_light(const Inputs& inputs, int i) {
    const auto frame = nusselt::Frame<float>::from_normal(inputs.normals[i]);
    return nusselt::to_shading_space(nusselt::make_polygon<4>(inputs.corners, 4), inputs.points[i], frame);
}

/// Everything that the contract of a technique has.
template <class Technique>
__device__ void use(const Inputs& inputs, float* result) {
    const int i = thread_index();
    const Technique technique(local_light(inputs, i));
    const auto sample = technique.sample(inputs.u[i]);
    const auto u = technique.invert(sample.wi);
    result[i] = u.x + u.y + technique.pdf(sample.wi) - sample.pdf + sample.p.z + technique.measure();
}

__global__ void polygon_measures(Inputs inputs, float* result) {
    const int i = thread_index();
    const auto light = local_light(inputs, i);
    result[i] = nusselt::area(light) + nusselt::solid_angle(light) + nusselt::projected_solid_angle(light);
}

__global__ void polygon_area(Inputs inputs, float* result) {
    use<nusselt::PolygonArea<float, 4>>(inputs, result);
}

__global__ void polygon_solid_angle(Inputs inputs, float* result) {
    use<nusselt::PolygonSolidAngle<float, 4>>(inputs, result);
}

__global__ void polygon_projected_solid_angle(Inputs inputs, float* result) {
    use<nusselt::PolygonProjectedSolidAngle<float, 4>>(inputs, result);
}
