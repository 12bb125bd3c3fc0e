#pragma once
/// The parts of the compiled module. Each unit adds the functions of one topic; the package around it, in Python, checks and
/// broadcasts arguments.

#include <pybind11/pybind11.h>

namespace nusselt::python {

void bind_techniques(pybind11::module_& module);
void bind_functions(pybind11::module_& module);
void bind_random(pybind11::module_& module);
void bind_images(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_render(pybind11::module_& module);

} // namespace nusselt::python
