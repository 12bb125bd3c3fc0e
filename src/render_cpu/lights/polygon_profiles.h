#pragma once
/// The profiles of polygonal lights, prepared for kernels.

#include "render_cpu/lights/polygon_records.h"
#include "render_cpu/lights/profile_records.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

namespace nusselt::render_cpu {

class PolygonProfiles {
public:
    PolygonProfiles();
    PolygonProfiles(const PolygonProfiles&) = delete;
    PolygonProfiles& operator=(const PolygonProfiles&) = delete;
    ~PolygonProfiles();

    /// Prepares the profile of a light that has one. \returns the index of its record
    std::int32_t add(const scene::Scene& scene, const scene::PolygonLight& light);
    /// Valid until the next call of add().
    const PolygonProfile* records() const { return records_.data(); }

private:
    struct Light;
    struct Side;
    struct Table;
    /// Luminaire, spread, the rounded axes of the side, the normals and shares of the area of all faces, and the honeycomb: what
    /// a table follows from. Scenes have thousands of luminaires of one kind.
    using TableKey = std::tuple<const scene::Luminaire*, double, std::vector<long>>;

    /// \param normal of the side, in the frame of the profile
    /// \param edge   along which its table is to be, null for any
    Side side_of(const scene::ProfiledEmission& emission, const scene::Double3& normal,
                 const scene::Double3* edge);

    ProfileRecords records_of_profiles_;
    std::map<TableKey, std::unique_ptr<Table>> tables_;
    std::vector<std::unique_ptr<Light>> lights_;
    std::vector<PolygonProfile> records_;
};

} // namespace nusselt::render_cpu
