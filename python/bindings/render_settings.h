#pragma once
/// Settings of renderings by their names in Python.

#include "render/settings.h"
#include "scene/model/scene.h"

#include <pybind11/pybind11.h>

namespace nusselt::python {

/// The settings of keyword arguments, of which None stands for the usual value.
/// \param film of the scene, which may ask for a number of samples
/// \throws std::invalid_argument if a value has no such name or settings do not fit together
render::RenderSettings settings_of(const pybind11::dict& arguments, const scene::Film& film);

/// For each setting that has a list of names this list.
pybind11::dict setting_names();

} // namespace nusselt::python
