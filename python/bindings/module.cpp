/// The compiled part of the package: nusselt._core.
#include "python/bindings/bindings.h"
#include "python/bindings/text.h"

#include <exception>
#include <stdexcept>

namespace {

/// Messages may have names of files that are no UTF-8, for which pybind11 would give an exception without a message.
void translate(std::exception_ptr pointer) {
    const auto raise = [](PyObject* type, const std::exception& error) {
        PyErr_SetObject(type, nusselt::python::text_of(error.what(), "backslashreplace").ptr());
    };
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const pybind11::builtin_exception&) {
        throw; // a runtime_error, too
    } catch (const std::invalid_argument& error) {
        raise(PyExc_ValueError, error);
    } catch (const std::runtime_error& error) {
        raise(PyExc_RuntimeError, error);
    }
}

} // namespace

PYBIND11_MODULE(_core, module) {
    module.doc() = "What the package nusselt calls; most of its functions check nothing.";
    pybind11::register_exception_translator(&translate);
    nusselt::python::bind_techniques(module);
    nusselt::python::bind_functions(module);
    nusselt::python::bind_random(module);
    nusselt::python::bind_images(module);
    nusselt::python::bind_scene(module);
    nusselt::python::bind_render(module);
}
