#pragma once
/// Classes of cylinders on which the twins are judged.

#include "experiments/accuracy_lights.h"

#include <nusselt/geometry/cylinder.h>

#include <functional>
#include <vector>

namespace nusselt::parity {

struct CylinderClass {
    const char* name;
    experiments::Visibility visibility;
    std::function<Cylinder<float>(experiments::Engine&)> make;
};

/// Those of experiments/tube_lights.h, turned around the normal and moved a little, distant ones, ones that almost touch
/// the point, and dark ones.
const std::vector<CylinderClass>& cylinder_classes();

} // namespace nusselt::parity
