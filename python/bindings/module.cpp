/// The compiled part of the package: nusselt._core.
#include "python/bindings/bindings.h"

PYBIND11_MODULE(_core, module) {
    module.doc() = "What the package nusselt calls; most of its functions check nothing.";
    nusselt::python::bind_techniques(module);
    nusselt::python::bind_functions(module);
    nusselt::python::bind_random(module);
    nusselt::python::bind_images(module);
    nusselt::python::bind_scene(module);
    nusselt::python::bind_render(module);
}
