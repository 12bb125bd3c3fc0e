#pragma once
/// Classes of cylinders on which the twins are judged.

#include "proof/accuracy/lights.h"

#include <nusselt/geometry/cylinder.h>

#include <functional>
#include <vector>

namespace nusselt::parity {

struct CylinderClass {
    const char* name;
    proof::Visibility visibility;
    std::function<Cylinder<float>(proof::Engine&)> make;
};

/// Those of proof/tube_lights.h, turned around the normal and moved a little, distant ones, ones that almost touch
/// the point, and dark ones.
const std::vector<CylinderClass>& cylinder_classes();

} // namespace nusselt::parity
