#ifndef NUSSELT_INTERFACE_SCENE_H
#define NUSSELT_INTERFACE_SCENE_H
/// A scene in storage buffers, for C++ and GLSL alike. All members are words of 32 bits or arrays of them, so that both
/// languages lay them out in the same way. Positions and radiance are as in src/scene/model/scene.h.

#include "interface/lights.h"

#ifdef __cplusplus
namespace nusselt::interface {
#endif

const uint kNoTexture = 0xffffffffu;

// TextureRecord::wrap
const uint kWrapRepeat = 0u;
const uint kWrapClamp = 1u;
const uint kWrapBlack = 2u;

// MaterialRecord::texture_kinds
const uint kDiffuseTexture = 1u;
const uint kF0Texture = 2u;
const uint kRoughnessTexture = 4u;
const uint kNormalTexture = 8u;
const uint kBumpTexture = 16u;
const uint kAlphaTexture = 32u;

// MaterialRecord::model
const uint kModelLambert = 0u;
const uint kModelFrostbite = 1u;
const uint kModelPhong = 2u;

struct VertexRecord {
    float position[3];
    float normal[3]; ///< zero: use the geometric normal
    float uv[2];
};

struct TriangleRecord {
    uint vertex[3];
    uint material;
    int light; ///< number of the light that the triangle belongs to, -1 for none
};

/// Triangles of instances are drawn after those of the world, in the order of instances.
struct InstanceRecord {
    uint first_drawn;    ///< number of its first triangle among all that are drawn
    uint first_triangle; ///< the same triangle among all records
    float world_from_object[12];
    float normal_from_object[9]; ///< rows of three: inverse transpose of the linear part, times a number above 0
    float handedness;            ///< -1 for mirror images, else 1
    float rounding;              ///< factor by which rounding errors grow on the way to the object and back
};

/// The lookup of a texture by a material, at scale * uv + offset.
struct TextureLookup {
    uint texture; ///< or kNoTexture
    float scale[2];
    float offset[2];
};

struct MaterialRecord {
    float diffuse[3];
    float f0[3];
    float roughness;
    float exponent;
    float alpha; ///< probability that the surface is there
    uint model;
    uint texture_kinds;
    TextureLookup diffuse_texture;
    TextureLookup f0_texture;
    TextureLookup roughness_texture;
    TextureLookup normal_texture;
    TextureLookup bump_texture;
    TextureLookup alpha_texture;
    float bump_height;
    uint is_bump_in_uv; ///< whether heights have the unit of texture coordinates, not metres
};

/// Texels are rows of codes, one per channel: the bits of a float, or with fewer bits the place of a float among the
/// values of the texture.
struct TextureRecord {
    uint first_code;  ///< word that its codes begin with; unused where they are in an image
    uint first_value; ///< word that its values begin with
    uint packing;     ///< words have 2 to the power of this codes: 1, 2 or 4; with 1 codes are floats
    int width;
    int height;
    int channels; ///< 3 or 1
    uint wrap;
    uint is_nearest; ///< or bilinear
};

/// Data with one number or vector per scene.
struct SceneRecord {
    // The camera, in pixels of the whole film; see scene::Camera.
    float origin[3];
    float origin_right[3];
    float origin_down[3];
    float corner[3];
    float right[3];
    float down[3];
    /// Rows of four: x, y and w of clip coordinates are the rows times (position - origin, 1).
    float clip_from_world[12];
    float distance_from_world[4]; ///< likewise: how far along camera rays, in units of their directions
    float inverse_depth_unit; ///< depth is 1 / (1 + t times this), t in units of the directions of camera rays
    int x_begin; ///< the first pixel of the image, on the film
    int y_begin;
    int width; ///< of the image
    int height;
    float radius; ///< half the diagonal of all that there is [m]
    uint world_triangles;
    uint instances;
    uint first_light_drawn;    ///< number of the first triangle of lights that are no surfaces, among all that are drawn
    uint first_light_triangle; ///< the same triangle among all records
    /// Numbers from here on are round lights: two for each, since rays cross them at two places.
    uint first_round_drawn;
    LightRange lights[kLightKinds]; ///< by kind
    // Of tables of lobes, which follow each other: f0, inclination, roughness.
    int frostbite_lobe_samples[3];
    int phong_lobe_samples[3];
};

/// Data that changes from one camera ray per pixel to the next.
struct FrameRecord {
    float offset[2]; ///< of camera rays from the centres of their pixels [pixels]
    float weight;    ///< of what they see
    uint number;
    uint count;         ///< of frames
    uint light_samples; ///< per frame, light and technique
    uint seed;
    float visibility_estimate;
    int mis; ///< a kMis constant: not one of the pipeline, since it would take longer to compile one for each heuristic
    // The part of the frame that is shaded at once; the rest follows.
    uint first_row; ///< of pixels
    uint first_light;
    uint light_end;
    uint first_sample; ///< of each light
    uint sample_end;
    uint loop_probe; ///< 2: shaders count to this in the end, to see whether loops still run
};

/// Sum over frames with the error of a single rounding (Kahan).
struct PixelSum {
    float sum[3];
    float excess[3]; ///< the excess of `sum`
};

/// Counters with 64 bits: low and high words.
struct WorkRecord {
    uint shadow_rays[2];
    uint rejected_samples[2];
    uint unfinished; ///< shadings whose loops were ended by the driver
    uint unknown_settings; ///< shadings with settings that the shader has no code for
};

#ifdef __cplusplus
} // namespace nusselt::interface
#endif

#endif
