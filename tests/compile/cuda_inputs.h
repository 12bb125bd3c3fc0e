#pragma once
/// The inputs of the kernels, and techniques that take them.

#include <nusselt/nusselt.h>

/// One shading point and two random numbers per thread.
struct Inputs {
    const nusselt::Vec3<float>* corners;
    const nusselt::Vec3<float>* points;
    const nusselt::Vec3<float>* normals;
    const nusselt::Vec2<float>* u;
    const nusselt::RectifiedSums* sums; ///< of a table of radiance by direction
};

__device__ inline int thread_index() { return static_cast<int>(__nvvm_read_ptx_sreg_tid_x()); }

__device__ inline nusselt::ConvexPolygon<float, 4> local_polygon(const Inputs& inputs, int i) {
    const auto frame = nusselt::Frame<float>::from_normal(inputs.normals[i]);
    return nusselt::to_shading_space(nusselt::make_polygon<4>(inputs.corners, 4), inputs.points[i], frame);
}

__device__ inline nusselt::LineSegment<float> local_line(const Inputs& inputs, int i) {
    const auto frame = nusselt::Frame<float>::from_normal(inputs.normals[i]);
    return nusselt::to_shading_space(nusselt::make_line(inputs.corners[0], inputs.corners[1]),
                                     inputs.points[i], frame);
}

/// Everything that the contract of a technique has.
template <class Technique, class Light, class Random>
__device__ float use(const Light& light, const Random& u) {
    const Technique technique(light);
    const auto sample = technique.sample(u);
    return nusselt::backward_error(technique, u, sample.wi) + technique.pdf(sample.wi) - sample.pdf +
           sample.p.z + technique.measure();
}

template <class Technique>
__device__ void use_polygon(const Inputs& inputs, float* result) {
    const int i = thread_index();
    result[i] = use<Technique>(local_polygon(inputs, i), inputs.u[i]);
}

template <class Technique>
__device__ void use_line(const Inputs& inputs, float* result) {
    const int i = thread_index();
    result[i] = use<Technique>(local_line(inputs, i), inputs.u[i].x);
}

__device__ inline nusselt::Cylinder<float> local_cylinder(const Inputs& inputs, int i) {
    return {local_line(inputs, i), inputs.u[i].y};
}

template <class Technique>
__device__ void use_cylinder(const Inputs& inputs, float* result) {
    const int i = thread_index();
    result[i] = use<Technique>(local_cylinder(inputs, i), inputs.u[i]);
}

__device__ inline nusselt::Ellipsoid<float> local_ellipsoid(const Inputs& inputs, int i) {
    const auto polygon = local_polygon(inputs, i);
    const auto& v = polygon.vertex;
    return {v[0], {v[1] - v[0], v[2] - v[0], v[3] - v[0]}};
}

template <class Technique>
__device__ void use_sphere(const Inputs& inputs, float* result) {
    const int i = thread_index();
    const nusselt::Sphere<float> light{local_ellipsoid(inputs, i).center, inputs.u[i].y};
    result[i] = use<Technique>(light, inputs.u[i]);
}
template <class Technique>
__device__ void use_disk(const Inputs& inputs, float* result) {
    const int i = thread_index();
    const nusselt::Disk<float> light{local_ellipsoid(inputs, i).center, inputs.normals[0], inputs.u[i].y};
    result[i] = use<Technique>(light, inputs.u[i]);
}
template <class Technique>
__device__ void use_ellipse(const Inputs& inputs, float* result) {
    const int i = thread_index();
    const auto light = local_ellipsoid(inputs, i);
    result[i] =
        use<Technique>(nusselt::Ellipse<float>{light.center, light.axis[0], light.axis[1]}, inputs.u[i]);
}
template <class Technique>
__device__ void use_ellipsoid(const Inputs& inputs, float* result) {
    const int i = thread_index();
    result[i] = use<Technique>(local_ellipsoid(inputs, i), inputs.u[i]);
}

/// A technique for LTCs on a light.
template <class Technique>
struct OnLobe : Technique {
    template <class Light>
    __device__ explicit OnLobe(const Light& light)
        : Technique(light, nusselt::Ltc<float>({1, 0.2f, 0.9f, 0, 0.4f, 1})) {}
};
template <class Technique>
__device__ void use_polygon_on_lobe(const Inputs& inputs, float* result) {
    use_polygon<OnLobe<Technique>>(inputs, result);
}
template <class Technique>
__device__ void use_line_on_lobe(const Inputs& inputs, float* result) {
    use_line<OnLobe<Technique>>(inputs, result);
}
template <class Technique>
__device__ void use_cylinder_on_lobe(const Inputs& inputs, float* result) {
    use_cylinder<OnLobe<Technique>>(inputs, result);
}

template <class Technique>
__device__ void use_sphere_on_lobe(const Inputs& inputs, float* result) {
    use_sphere<OnLobe<Technique>>(inputs, result);
}
template <class Technique>
__device__ void use_disk_on_lobe(const Inputs& inputs, float* result) {
    use_disk<OnLobe<Technique>>(inputs, result);
}
template <class Technique>
__device__ void use_ellipse_on_lobe(const Inputs& inputs, float* result) {
    use_ellipse<OnLobe<Technique>>(inputs, result);
}
template <class Technique>
__device__ void use_ellipsoid_on_lobe(const Inputs& inputs, float* result) {
    use_ellipsoid<OnLobe<Technique>>(inputs, result);
}

/// A light that the kernel prepares, too: renderers do that once.
template <class Technique, class... Lobe>
__device__ void use_texture(const Inputs& inputs, float* result, const Lobe&... lobe) {
    const int i = thread_index();
    float storage[256];
    const auto light =
        nusselt::make_textured_rectangle<nusselt::BilinearFilter, 16>({inputs.corners, 4, 4}, storage);
    const auto plane = nusselt::make_texture_plane(inputs.corners[0], inputs.corners[1], inputs.corners[2]);
    const auto frame = nusselt::Frame<float>::from_normal(inputs.normals[i]);
    const Technique technique(nusselt::to_shading_space(plane, inputs.points[i], frame), light, {lobe...});
    const auto sample = technique.sample(inputs.u[i]);
    result[i] = technique.pdf(sample.wi) - sample.pdf + technique.invert(sample.wi).x + sample.at.x +
                technique.measure() + technique.unshadowed().x + light.flux(plane.area()).x;
}
template <class Technique>
__device__ void use_textured_polygon(const Inputs& inputs, float* result) {
    use_texture<Technique>(inputs, result);
}
template <class Technique>
__device__ void use_textured_polygon_on_lobe(const Inputs& inputs, float* result) {
    use_texture<Technique>(inputs, result, nusselt::Ltc<float>({1, 0.2f, 0.9f, 0, 0.4f, 1}));
}

/// A portal with a table of 4 x 4 texels, which only hosts make.
template <class Technique, class... Lobe>
__device__ void use_window(const Inputs& inputs, float* result, const Lobe&... lobe) {
    const int i = thread_index();
    const nusselt::RectifiedTable<float> table{4,
                                               4,
                                               nusselt::RectifiedDomain<float>::hemisphere(),
                                               {-1.5f, -1.5f},
                                               {0.8f, 0.8f},
                                               1,
                                               1,
                                               inputs.sums,
                                               inputs.corners};
    const auto frame = nusselt::Frame<float>::from_normal(inputs.normals[i]);
    const auto light = nusselt::make_portal(frame, inputs.corners, 4, table);
    const Technique technique(nusselt::to_shading_space(light.plane, inputs.points[i], frame), light,
                              {lobe...});
    const auto sample = technique.sample(inputs.u[i]);
    result[i] = technique.pdf(sample.wi) - sample.pdf + technique.invert(sample.wi).x + sample.at.x +
                technique.measure() + technique.unshadowed().x;
}
template <class Technique>
__device__ void use_windowed_polygon(const Inputs& inputs, float* result) {
    use_window<Technique>(inputs, result);
}
template <class Technique>
__device__ void use_windowed_polygon_on_lobe(const Inputs& inputs, float* result) {
    use_window<Technique>(inputs, result, nusselt::Ltc<float>({1, 0.2f, 0.9f, 0, 0.4f, 1}));
}

/// A map that the kernel prepares, too: renderers do that once.
template <class Technique, class... Lobe>
__device__ void use_map(const Inputs& inputs, float* result, const Lobe&... lobe) {
    const int i = thread_index();
    float storage[1024];
    const auto map =
        nusselt::make_environment_map<16>(nusselt::OctahedralMap<float>{inputs.corners, 32}, storage);
    const Technique technique(map, nusselt::Frame<float>::from_normal(inputs.normals[i]), {lobe...});
    const auto sample = technique.sample(inputs.u[i]);
    result[i] = technique.pdf(sample.wi) - sample.pdf + technique.invert(sample.wi).x +
                technique.pdf_at(sample.at) + technique.measure() + technique.unshadowed().x +
                map.radiance.lookup(sample.at).y;
}
template <class Technique>
__device__ void use_environment(const Inputs& inputs, float* result) {
    use_map<Technique>(inputs, result);
}
template <class Technique>
__device__ void use_environment_on_lobe(const Inputs& inputs, float* result) {
    use_map<Technique>(inputs, result, nusselt::Ltc<float>({1, 0.2f, 0.9f, 0, 0.4f, 1}));
}

/// A line or tube whose radiance varies along it; the kernel makes its profile, too.
__device__ inline nusselt::LineProfile<float> profile_of(const Inputs& inputs) {
    return nusselt::make_line_profile(inputs.corners, 4);
}
template <class Technique, class... Lobe>
__device__ void use_textured_segment(const Inputs& inputs, float* result, const Lobe&... lobe) {
    const int i = thread_index();
    const auto profile = profile_of(inputs);
    const Technique technique(local_line(inputs, i), profile, {lobe...});
    const auto sample = technique.sample(inputs.u[i].x);
    result[i] = technique.pdf(sample.wi) - sample.pdf + technique.invert(sample.wi) + technique.measure() +
                technique.pdf_at(sample.at) + technique.unshadowed().x + profile.lookup(sample.at).y;
}
template <class Technique>
__device__ void use_textured_line(const Inputs& inputs, float* result) {
    use_textured_segment<Technique>(inputs, result);
}
template <class Technique>
__device__ void use_textured_line_on_lobe(const Inputs& inputs, float* result) {
    use_textured_segment<Technique>(inputs, result, nusselt::Ltc<float>({1, 0.2f, 0.9f, 0, 0.4f, 1}));
}

template <class Technique, class Uniform, class... Lobe>
__device__ void use_textured_cylinder(const Inputs& inputs, float* result, const Lobe&... lobe) {
    const int i = thread_index();
    const auto light = local_cylinder(inputs, i);
    const Technique technique(Uniform(light, lobe...), light, profile_of(inputs));
    const auto sample = technique.sample(inputs.u[i]);
    result[i] = technique.pdf(sample.wi) - sample.pdf + technique.invert(sample.wi).x + technique.measure();
}
template <class Technique>
__device__ void use_textured_tube(const Inputs& inputs, float* result) {
    use_textured_cylinder<Technique, nusselt::CylinderProjectedSolidAngle<float>>(inputs, result);
}
template <class Technique>
__device__ void use_textured_tube_on_lobe(const Inputs& inputs, float* result) {
    use_textured_cylinder<Technique, nusselt::CylinderLtc<float>>(
        inputs, result, nusselt::Ltc<float>({1, 0.2f, 0.9f, 0, 0.4f, 1}));
}
