#pragma once
/// The contract that the row of every kind of light fulfils.

#include "scene/model/bounds.h"
#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/lights/light_text.h"
#include "scene/model/scene.h"
#include "scene/model/transform.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

namespace nusselt::render_test {

/// The questions that the contract asks a light, through the list of its kind as the product does.
class LightUnderTest {
public:
    explicit LightUnderTest(scene::Lights light) : light_(std::move(light)) {}

    const scene::LightList& list() const {
        auto list = light_.begin();
        while ((*list).size() == 0) ++list;
        return *list;
    }
    scene::LightList& list() { return const_cast<scene::LightList&>(std::as_const(*this).list()); }

    LightUnderTest transformed(const scene::Transform& transform) const {
        LightUnderTest result = *this;
        result.list().transform(transform);
        return result;
    }
    scene::Bounds bounds() const {
        scene::Bounds bounds;
        list().add_to(bounds);
        return bounds;
    }
    scene::Double3 centroid() const {
        scene::Moment moment;
        list().add_to(moment);
        return moment.centroid();
    }
    std::uint64_t hash() const {
        scene::ContentHash hash;
        list().hash(hash);
        return hash.value();
    }
    bool same_shape(const LightUnderTest& other) const { return list().same_shape(0, other.list(), 0); }
    scene::LightMesh mesh() const {
        scene::LightMesh mesh;
        list().add_mesh(0, mesh);
        return mesh;
    }

private:
    scene::Lights light_;
};

inline bool contains(const scene::Bounds& box, const scene::Double3& p, double margin) {
    return p.x >= box.low.x - margin && p.x <= box.high.x + margin && p.y >= box.low.y - margin &&
           p.y <= box.high.y + margin && p.z >= box.low.z - margin && p.z <= box.high.z + margin;
}

/// What tells lights without extent from others.
struct Extent {
    bool has_bounds = true;   ///< whether the light counts in the bounds of the scene, and cameras see it
    bool has_place = true;    ///< whether it lies somewhere
    double flux_of_twice = 4; ///< the flux of a light twice as large, relative to that of the light
};

/// The members of the row that contradict the others for this light, each once; none if the row is right.
/// \param light valid, about one metre large, at most a few metres from the origin and not around it
template <class Light>
std::vector<std::string> row_defects(const Light& light, const Extent& extent = {}) {
    std::vector<std::string> defects;
    const auto expect = [&](bool holds, const char* member) {
        if (!holds && std::find(defects.begin(), defects.end(), member) == defects.end())
            defects.emplace_back(member);
    };
    const LightUnderTest tested(scene::only(light));
    const scene::Bounds box = tested.bounds();
    // Cameras may see round lights as polygons of the same area, which are a little larger.
    const double margin = 0.01 * length(box.high - box.low);
    const scene::Double3 centroid = tested.centroid();
    const scene::LightMesh mesh = tested.mesh();

    expect(mesh.triangles.empty() == (scene::kIsSurface<Light> || !extent.has_bounds), "add_mesh");
    expect(box.is_empty() != extent.has_bounds, "add_to");
    const auto lies_in_box = [&](const scene::Float3& p) { return contains(box, to_double(p), margin); };
    expect(std::all_of(mesh.positions.begin(), mesh.positions.end(), lies_in_box), "add_to");
    if (extent.has_bounds) expect(contains(box, centroid, margin), "add_moment");

    const scene::Double3 towards = {0.3, -0.5, 0.8};
    const scene::Double3 origin = centroid - 10.0 * towards;
    const double hit = tested.list().hit(0, {origin, towards, {}, {}});
    expect(extent.has_place ? std::fabs(hit - 10) < 2 : std::isinf(hit), "hit");
    expect(std::isinf(tested.list().hit(0, {origin, -1 * towards, {}, {}})), "hit");

    const scene::Double3 way = {1, 2, 3};
    const LightUnderTest moved = tested.transformed(scene::translation(way));
    if (extent.has_place) expect(length(moved.centroid() - centroid - way) < 1e-5, "transform");
    if (extent.has_bounds) expect(length(moved.bounds().low - box.low - way) < 1e-5, "transform");
    const LightUnderTest turned_about_x = tested.transformed(scene::rotation(90, {1, 0, 0}));
    const LightUnderTest& other = extent.has_place ? moved : turned_about_x;
    expect(tested.same_shape(tested) && !tested.same_shape(other), "same_shape");
    expect(tested.hash() != other.hash(), "hash");
    LightUnderTest dimmed = tested;
    dimmed.list().emission(0).x /= 2;
    expect(tested.same_shape(dimmed), "same_shape");
    expect(tested.hash() != dimmed.hash(), "hash");

    constexpr double kSceneRadius = 3;
    const auto flux_of = [](const LightUnderTest& some) {
        return some.list().flux_per_emission(0, kSceneRadius).y;
    };
    const double flux = flux_of(tested);
    const LightUnderTest twice = tested.transformed(scene::scaling({2, 2, 2}));
    expect(flux > 0 && std::fabs(flux_of(twice) / flux - extent.flux_of_twice) < 1e-4, "flux_per_emission");
    LightUnderTest turned = tested;
    if (bool* const two_sided = turned.list().two_sided(0)) {
        *two_sided = !*two_sided;
        const double ratio = flux_of(turned) / flux;
        expect(std::fabs(ratio - (*two_sided ? 2 : 0.5)) < 1e-6, "two_sided");
    }
    expect(tested.list().is_valid(0), "is_valid");
    if (extent.has_place)
        expect(!tested.transformed(scene::translation({1e16, 0, 0})).list().is_valid(0), "is_valid");

    const std::string report = tested.list().describe(0, 1, kSceneRadius);
    const std::string emission =
        std::string(tested.list().quantity().name) + " " + report_text(tested.list().emission(0));
    expect(report.find("power ") != std::string::npos, "describe");
    if (!extent.has_bounds) expect(report.find(emission) != std::string::npos, "describe");
    const std::string field = tested.list().rig_field(0);
    expect(field.empty() || (field[0] == '"' && field.find("\": ") != std::string::npos), "rig_field");
    return defects;
}

} // namespace nusselt::render_test
