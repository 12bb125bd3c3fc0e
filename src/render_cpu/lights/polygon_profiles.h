#pragma once
/// The profiles of polygonal lights, prepared for kernels.

#include "render_cpu/lights/luminaire_tables.h"
#include "render_cpu/lights/polygon_records.h"
#include "scene/model/scene.h"

#include <array>
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
    struct Side;
    struct Table;
    /// What the radiance of a side by direction in the frame of the polygon follows from: lights of one kind share tables.
    using TableKey = std::tuple<const scene::EmissionProfile*, std::array<long, 6>, int, float>;

    const Table& table_of(const scene::ProfiledEmission& emission, int side);

    LuminaireTables luminaires_;
    std::vector<std::vector<LuminousFaceRecord>> faces_;
    std::map<TableKey, std::unique_ptr<Table>> tables_;
    std::vector<std::unique_ptr<Side>> sides_;
    std::vector<PolygonProfile> records_;
};

} // namespace nusselt::render_cpu
