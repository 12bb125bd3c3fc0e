#pragma once
/// The luminaires of lights, prepared for kernels.

#include "render_cpu/lights/luminaire_table.h"
#include "scene/model/profiles/intensity_arrays.h"
#include "scene/model/profiles/luminaire.h"

#include <map>
#include <memory>
#include <utility>

namespace nusselt::render_cpu {

class LuminaireTables {
public:
    /// The table of a luminaire, whose intensities are divided by a number. Equal ones are made once.
    /// \param unit [cd], positive; 0 gives a dark table
    LuminaireTable add(const std::shared_ptr<const scene::Luminaire>& luminaire, double unit);

private:
    std::map<std::pair<std::shared_ptr<const scene::Luminaire>, double>, scene::IntensityArrays> tables_;
};

} // namespace nusselt::render_cpu
