/// Kernels that use the library on a device: closed forms, BRDFs, line samples and random numbers.

#include "cuda_inputs.h"

__global__ void measures(Inputs inputs, float* result) {
    const int i = thread_index();
    const auto polygon = local_polygon(inputs, i);
    const auto line = local_line(inputs, i);
    result[i] = nusselt::area(polygon) + nusselt::solid_angle(polygon) +
                nusselt::projected_solid_angle(polygon) + nusselt::solid_angle(line) +
                nusselt::projected_solid_angle(line);
}

__global__ void shade(Inputs inputs, float* result) {
    const int i = thread_index();
    const nusselt::Frostbite<float> brdf(inputs.normals[i], inputs.points[i], inputs.points[i], 0.5f);
    const auto u =
        nusselt::light_random(nusselt::Sampler::sobol, 1u, static_cast<unsigned>(i), 2u, 3u, 4u, 5u);
    result[i] = brdf.eval(inputs.points[i]).x + u.x + u.y;
}

/// One line of a light behind one triangle, with all ways to choose it and to shade it.
__global__ void line_sample(Inputs inputs, float* result) {
    const int i = thread_index();
    const auto frame = nusselt::Frame<float>::from_normal(inputs.normals[i]);
    const nusselt::LineFamily<float, 4> family(nusselt::make_polygon<4>(inputs.corners, 4), 0.5f);
    const auto plane = nusselt::to_shading_space(family.plane(), inputs.points[i], frame);
    const nusselt::Frostbite<float> brdf(frame.to_local(inputs.points[i]), inputs.normals[i],
                                         inputs.normals[i], 0.5f);
    const nusselt::GlossySurface<float> surface{frame.to_local(inputs.points[i]),
                                                0.25f,
                                                brdf,
                                                nusselt::Ltc<float>({1, 0.2f, 0.9f, 0, 0.4f, 1}),
                                                inputs.normals[i],
                                                inputs.normals[i]};
    const nusselt::LineLight<float> light(plane, family.reach(), surface);
    const nusselt::ReflectedOffsets<float, 4> offsets(family, light);

    const auto shadow_frame = nusselt::make_shadow_frame(family.plane(), inputs.points[i]);
    const nusselt::Vec3<float>* triangle = inputs.corners + 4;
    const auto whole = nusselt::make_triangle_shadow(shadow_frame, triangle[0], triangle[1], triangle[2]);
    const auto partial = nusselt::make_partial_shadow(shadow_frame, triangle[0], triangle[1], triangle[2]);
    const nusselt::LobePlane<float, nusselt::BothSides> lines({plane, family.reach()});
    nusselt::Interval<float> memory[8];
    nusselt::VisibleParts<float> parts(memory, 8);
    float sum = 0;
    for (const auto& choice : {family.sample_by_length(inputs.u[i].x), family.sample_uniform(inputs.u[i].x),
                               offsets.sample(inputs.u[i].x)}) {
        parts.reset(family.chord(choice.offset).extent);
        parts.cut(whole.partial ? nusselt::hidden_interval(partial, choice.offset)
                                : nusselt::hidden_interval(whole.shadow, choice.offset));
        sum += light.analytic(choice.offset, parts).diffuse.x +
               light.unbiased(choice.offset, parts, inputs.u[i].y).specular.x;
        const auto line = lines.line(choice.offset);
        for (int k = 0; k < parts.count(); ++k)
            sum += nusselt::diffuse_part(line, parts[k]) +
                   nusselt::phong_part(line, parts[k], inputs.normals[i], 20.f);
    }
    result[i] = sum;
}
