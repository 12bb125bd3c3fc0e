#pragma once
/// Makes the records of profiles.

#include "render_cpu/lights/luminaire_tables.h"
#include "render_cpu/lights/profile_record.h"
#include "scene/model/scene.h"

#include <deque>
#include <vector>

namespace nusselt::render_cpu {

/// Owns the arrays that records point to.
class ProfileRecords {
public:
    ProfileRecord make(const scene::ProfiledEmission& emission, const scene::ProfilePlacement& placement);

private:
    LuminaireTables luminaires_;
    std::deque<std::vector<LuminousFaceRecord>> faces_;
};

} // namespace nusselt::render_cpu
