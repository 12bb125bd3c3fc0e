#pragma once
/// Names of BRDFs for people and programs.

#include "scene/model/scene.h"

namespace nusselt::scene {

inline const char* name_of(BrdfModel model) noexcept {
    switch (model) {
    case BrdfModel::frostbite:
        return "frostbite";
    case BrdfModel::phong:
        return "phong";
    case BrdfModel::lambert:
        break;
    }
    return "lambert";
}

} // namespace nusselt::scene
