// The code in the pages on emission that varies (docs/techniques), as functions. The tests compile this file and compare what
// the functions return with integrals.

#include <cmath>
#include <cstddef>
#include <vector>

#include <nusselt/nusselt.h>
using namespace nusselt;

namespace {

using Vec = Vec3<float>;

constexpr float kAlbedo = 0.5f;
float brdf(const Vec&, const Vec&) { return kAlbedo / kPi<float>; }

/// There is nothing but the light.
bool visible(const Vec&, const Vec&) { return true; }

/// \param texels width * height of them. \param corner, side_x, side_y where the screen is.
Vec light_of_screen(const Vec* texels, int width, int height, const Vec& corner, const Vec& side_x,
                    const Vec& side_y, const Vec& point, const Vec& normal, const Vec2<float>& u) {
    const Vec wo{0, 0, 1};
    Vec radiance{0, 0, 0};
    const TextureView<float> texture{texels, width, height}; // once per light
    std::vector<float> storage(static_cast<std::size_t>(PyramidShape(16, width, height).size));
    const auto light = make_textured_rectangle<BilinearFilter, 16>(texture, storage.data());
    const auto plane = make_texture_plane(corner, side_x, side_y);

    const auto frame = Frame<float>::from_normal(normal); // at each shading point
    const TexturedPolygon<float, 16> technique(to_shading_space(plane, point, frame), light);
    const auto s = technique.sample(u);
    if (s.pdf > 0 && visible(point, point + frame.to_world(s.p)))
        radiance += BilinearFilter::lookup(texture, s.at) * (brdf(wo, s.wi) * s.wi.z / s.pdf);
    return radiance;
}

/// \param window corners of the portal, in a plane across the normal of its frame. \param sky(w) radiance from a direction.
template <class Sky>
Vec light_of_window(const Vec* window, const Frame<float>& portal, const Sky& sky, const Vec& point,
                    const Vec& normal, const Vec2<float>& u) {
    const Vec wo{0, 0, 1};
    Vec radiance{0, 0, 0};
    constexpr int kSize = 128; // once per map and direction of portals
    std::vector<RectifiedSums> sums(static_cast<std::size_t>(RectifiedTable<float>::size(kSize, kSize)));
    std::vector<Vec> colour(sums.size());
    const auto in_frame = [&](const Vec& w) { return sky(portal.to_world(w)); };
    const auto table = make_rectified_table<float>(in_frame, RectifiedDomain<float>::hemisphere(), kSize,
                                                   kSize, 2, sums.data(), colour.data());
    const auto light = make_portal(portal, window, 4, table); // once per portal

    const auto frame = Frame<float>::from_normal(normal); // at each shading point
    const WindowedPolygon<float> technique(to_shading_space(light.plane, point, frame), light);
    const auto s = technique.sample(u);
    if (s.pdf > 0 && visible(point, point + frame.to_world(s.p)))
        radiance += sky(frame.to_world(s.wi)) * (brdf(wo, s.wi) * s.wi.z / s.pdf);
    return radiance;
}

/// \param texels size * size of an equal-area map of the octahedron.
Vec light_of_map(const Vec* texels, int size, const Vec& point, const Vec& normal, const Vec2<float>& u) {
    const Vec wo{0, 0, 1};
    Vec radiance{0, 0, 0};
    using Map = EnvironmentMap<float, 16>; // once per map
    std::vector<float> storage(static_cast<std::size_t>(Map::storage_size(size)));
    const Map map = make_environment_map<16>(OctahedralMap<float>{texels, size}, storage.data());

    const auto frame = Frame<float>::from_normal(normal); // at each shading point, in the space of the map
    const EnvironmentCosine<float> technique(map, frame);
    const auto s = technique.sample(u);
    if (s.pdf > 0 && visible(point, point + frame.to_world(s.p)))
        radiance += map.radiance.lookup(s.at) * (brdf(wo, s.wi) * s.wi.z / s.pdf);
    return radiance;
}

} // namespace
