#pragma once
/// Luminaires high above a floor: the intensity that the floor receives, and the flux that lights emit.

#include "base/temporary_folder.h"
#include "scene/ies/ies_cases.h"
#include "scene/import/importers.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/profiles/profile_radiance.h"
#include "scenes.h"

#include <cmath>
#include <fstream>
#include <string>

namespace nusselt::render_test {

using scene::Double3;
using scene::test::Case;
using scene::test::kDegree;
using scene::test::kPi;

constexpr double kSide = 0.7;
constexpr double kHeight = 50 * kSide;
constexpr int kPixels = 20;
constexpr double kAlbedo = 0.5;

inline const std::string kEmission = "AreaLightSource \"diffuse\" \"string ies\" \"lamp.ies\"";

/// A floor below a light, as the light sees it.
inline scene::Scene load(const Case& lamp, const std::string& light) {
    const base::TemporaryFolder folder;
    write(lamp, folder.path());
    std::ofstream(folder / "scene.pbrt")
        << "Film \"rgb\" \"integer xresolution\" " << kPixels << " \"integer yresolution\" " << kPixels
        << "\nPixelFilter \"box\"\nLookAt 0 0 34.7  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 140\n"
        << "WorldBegin\nMaterial \"diffuse\" \"rgb reflectance\" [ 0.5 0.5 0.5 ]\n"
        << "Shape \"trianglemesh\" \"point3 P\" [ -400 -400 0  400 -400 0  400 400 0  -400 400 0 ] "
        << "\"integer indices\" [ 0 1 2  0 2 3 ]\nAttributeBegin\n"
        << light << "AttributeEnd\n";
    return scene::load_scene(folder / "scene.pbrt");
}

/// A direction of the world in the frame of the luminaire.
inline Double3 in_profile(const Double3& w) { return {w.y, w.x, -w.z}; }

/// The point of the floor that the centre of a pixel sees.
inline Double3 floor_point(const scene::Camera& camera, int i, int j) {
    const auto at = [&](float Float3::*axis) {
        return double{camera.corner.*axis} + (i + 0.5) * camera.right.*axis + (j + 0.5) * camera.down.*axis;
    };
    const double t = -camera.origin.z / at(&Float3::z);
    return {camera.origin.x + t * at(&Float3::x), camera.origin.y + t * at(&Float3::y), 0};
}

/// What the floor receives from a light in its middle above it.
inline image::Image render_floor(const scene::Scene& scene, int samples = 64) {
    render::RenderSettings settings;
    settings.samples = samples;
    settings.camera_rays = 1;
    settings.pixel_position = render::PixelPosition::center;
    return render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image;
}

/// The largest relative error of the intensities that the floor receives. Directions of less than a hundredth of the peak are left
/// out.
inline double far_field_error(const scene::Camera& camera, const image::Image& floor,
                              const scene::test::Intensity& intensity, double peak) {
    double worst = 0;
    for (int j = 0; j < kPixels; ++j)
        for (int i = 0; i < kPixels; ++i) {
            const Double3 way = floor_point(camera, i, j) - Double3{0, 0, kHeight};
            const double squared = dot(way, way);
            const Double3 w = normalized(way);
            const double expected = intensity(in_profile(w));
            if (expected < 0.01 * peak) continue;
            const double radiance = double{floor.pixels[static_cast<std::size_t>(3 * (j * kPixels + i))]};
            const double found = radiance * kPi / kAlbedo * scene::kLumensPerWatt * squared / -w.z;
            worst = std::max(worst, std::fabs(found / expected - 1));
        }
    return worst;
}

inline double far_field_error(const scene::Scene& scene, const scene::test::Intensity& intensity,
                              double peak) {
    return far_field_error(scene.camera, render_floor(scene), intensity, peak);
}

/// The error of a floor, and whether that of wrong tables is too large to pass.
struct FarField {
    static constexpr double kLimit = 0.01;
    double error;
    bool rejects_mirrored; ///< the other handedness of horizontal angles
    bool rejects_bright;   ///< a table that is brighter by 3 %
};
inline FarField far_field_of(const scene::Camera& camera, const image::Image& floor,
                             const scene::IntensityProfile& table) {
    const auto error = [&](const scene::test::Intensity& intensity) {
        return far_field_error(camera, floor, intensity, table.peak().candelas);
    };
    return {
        error([&](const Double3& w) { return table.intensity(w); }),
        error([&](const Double3& w) {
            return table.intensity({w.x, -w.y, w.z});
        }) >= FarField::kLimit,
        error([&](const Double3& w) { return 1.03 * table.intensity(w); }) >= FarField::kLimit,
    };
}

inline const scene::IntensityProfile& table_of(const scene::Scene& scene) {
    return scene.emission_profiles.at(0).profile->luminaire->profile;
}

/// The flux of all polygons, tubes and lines [lm].
inline double flux_of(const scene::Scene& scene) {
    double flux = 0;
    for (const scene::PolygonLight& light : scene.lights.of<scene::PolygonLight>())
        flux += (light.two_sided ? 2 : 1) * kPi * area(light) * double{light.radiance.y};
    for (const scene::LineLight& light : scene.lights.of<scene::LineLight>())
        flux += kPi * area(light) * double{light.radiance.y};
    return scene::kLumensPerWatt * flux;
}

} // namespace nusselt::render_test
