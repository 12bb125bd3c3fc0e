#ifndef NUSSELT_INTERFACE_LIGHTS_H
#define NUSSELT_INTERFACE_LIGHTS_H
/// The table of kinds of light on devices, for C++ and GLSL alike. Another kind is a row of each part: src/render_vulkan/lights
/// writes its records, and files in shaders/passes/lights read them.

#include "interface/settings.h"

#ifdef __cplusplus
#include <cstdint>

namespace nusselt::interface {

using uint = std::uint32_t;
#endif

/// Stands for the number of a first word where there are no words.
const uint kNoWords = 0xffffffffu;

// Kinds are numbered from 0 without gaps.
const int kPolygonKind = 0;
const int kLineKind = 1;
const int kPointKind = 2;
const int kDistantKind = 3;
const int kEnvironmentKind = 4;
const int kRoundKind = 5;
const int kLightKinds = 6;

// Specialisation constants: whether a scene has lights of a shape. Those that it has not need no code.
const int kPolygonsConstant = kFirstLightConstant;
const int kLinesConstant = kFirstLightConstant + 1; ///< and strips
const int kTubesConstant = kFirstLightConstant + 2; ///< solid or open
const int kPointsConstant = kFirstLightConstant + 3;
const int kPointImagesConstant = kFirstLightConstant + 4; ///< points whose intensity comes from an image
const int kDistantsConstant = kFirstLightConstant + 5;
const int kTexturedPolygonsConstant = kFirstLightConstant + 6; ///< polygons that emit an image
const int kUniformEnvironmentsConstant = kFirstLightConstant + 7;
const int kMappedEnvironmentsConstant = kFirstLightConstant + 8;
const int kTexturedLinesConstant = kFirstLightConstant + 9; ///< and strips, whose radiance varies along them
const int kTexturedTubesConstant = kFirstLightConstant + 10;
const int kPointProfilesConstant = kFirstLightConstant + 11;    ///< points that shine as a luminaire
const int kProfiledPolygonsConstant = kFirstLightConstant + 12; ///< polygons whose radiance depends on the direction
const int kUniformPortalsConstant = kFirstLightConstant + 13; ///< environments that shine through a portal
const int kMappedPortalsConstant = kFirstLightConstant + 14;
const int kProfiledLinesConstant = kFirstLightConstant + 15; ///< and strips, whose radiance depends on the direction
const int kProfiledTubesConstant = kFirstLightConstant + 16;
const int kEllipsesConstant = kFirstLightConstant + 17;   ///< and disks
const int kEllipsoidsConstant = kFirstLightConstant + 18; ///< and spheres
const int kConstantCount = kFirstLightConstant + 19;

// Bindings of set 0, after those of shaders/passes/scene.glsl.
const int kFirstLightBinding = 7;
const int kRoundLightsBinding = kFirstLightBinding; ///< first, because passes that see surfaces need no other lights
const int kPolygonLightsBinding = kFirstLightBinding + 1;
const int kPolygonCornersBinding = kFirstLightBinding + 2; ///< of polygons and portals
const int kLineLightsBinding = kFirstLightBinding + 3;
const int kPointLightsBinding = kFirstLightBinding + 4;
const int kDistantLightsBinding = kFirstLightBinding + 5;
const int kPolygonTexturesBinding = kFirstLightBinding + 6;
const int kEmissionWordsBinding = kFirstLightBinding + 7; ///< texels and prepared data of all emission that varies
const int kEnvironmentLightsBinding = kFirstLightBinding + 8;
const int kFirstBindingAfterLights = kFirstLightBinding + 9;

struct PolygonLightRecord {
    float normal[3];
    float radiance[3]; ///< the mean if there is a texture
    uint is_two_sided;
    uint first_corner_word;  ///< among those of kPolygonCornersBinding
    int texture_number;      ///< index of its PolygonTextureRecord, -1 for none
    uint first_profile_word; ///< of interface/profiles.h, kNoWords for none
};

/// The image that a polygon emits.
struct PolygonTextureRecord {
    // A TexturePlane in world space.
    float corner[3];
    float side_x[3];
    float side_y[3];
    float normal[3];
    float inverse_mean[3]; ///< of the radiance; 0 for channels that are black everywhere
    int width;
    int height;
    uint first_texel; ///< emission word that its texels begin with: rows of red, green and blue radiance
    uint first_word;  ///< emission word that its TexturedLightWords begin with
};

// Values of LineLightRecord::model, those of scene::TubeModel.
const uint kLinearTube = 0;
const uint kSolidTube = 1;
const uint kOpenTube = 2;
const uint kStrip = 3;

struct LineLightRecord {
    float begin[3];
    float direction[3];
    float len; ///< `length` is a function of GLSL
    float radius;
    uint model;
    float normal[3]; ///< of strips
    float radiance[3]; ///< the mean if it varies
    float inverse_mean[3];   ///< of the radiance; 0 for channels that are black everywhere
    /// Emission word that its LineProfileWords begin with; kNoWords for the same radiance everywhere.
    uint first_texture_word;
    uint first_profile_word; ///< of interface/profiles.h, kNoWords for the same radiance in all directions
};

// Values of PointLightRecord::distribution, those of scene::PointDistribution.
const uint kIsotropic = 0;
const uint kSmoothCone = 1;
const uint kQuarticCone = 2;
const uint kOctahedralImage = 3;
const uint kLatitudeImage = 4;
const uint kProjectedImage = 5;
const uint kProfile = 6;

struct PointLightRecord {
    float position[3];
    float x_axis[3];
    float y_axis[3];
    float z_axis[3];
    float intensity[3];
    uint distribution;
    float cone_end;           ///< scene::ConeFalloff::end
    float inverse_cone_width; ///< scene::inverse_width()
    float half_extent[2];
    int texture_number;        ///< -1 for none
    uint first_luminaire_word; ///< of interface/profiles.h, kNoWords for none
};

struct DistantLightRecord {
    float to_light[3]; ///< unit
    float irradiance[3];
};

struct EnvironmentLightRecord {
    // The axes of the map in world space.
    float x_axis[3];
    float y_axis[3];
    float z_axis[3];
    float radiance[3]; ///< the mean if there is a map
    uint first_map_word; ///< emission word that its EnvironmentMapWords begin with, after its texels; kNoWords for none
    float normal[3];     ///< of the portal
    uint first_corner_word; ///< of the portal, kNoWords without one
};

// Values of RoundLightRecord::shape, those of scene::RoundShape.
const uint kSphere = 0;
const uint kDisk = 1;
const uint kEllipse = 2;
const uint kEllipsoid = 3;

/// Stands for the triangle of lights that rays do not meet.
const uint kNoTriangle = 0xffffffffu;

/// Rasterisation draws boxes around round lights.
const uint kRoundBoxTriangles = 12u;

/// A scene::RoundForm, and how rays meet it: a visibility::RoundSurface.
struct RoundLightRecord {
    uint shape;
    float center[3];
    float axis0[3];
    float axis1[3];
    float axis2[3];
    float inverse0[3]; ///< rows of the inverse of the matrix with the axes; flat lights have their normal as axis2
    float inverse1[3];
    float inverse2[3];
    float normal[3];
    float radius;
    float radiance[3];
    uint emits_outwards;
    uint emits_inwards;
    uint triangle;    ///< one of its triangles, which has its material, or kNoTriangle
    uint is_partial;  ///< alpha decides whether a ray meets it
    float rounding;   ///< how far single precision moves points of the surface [m]
    float shrinkage;  ///< of solid lights, the same as a share of the shape
};

/// The lights of one kind: consecutive numbers among all lights of the scene.
struct LightRange {
    uint first;
    uint count;
};

#ifdef __cplusplus
} // namespace nusselt::interface
#endif

#endif
