#pragma once
/// Texts and names of files. Those of files need not be UTF-8: Python has other bytes as surrogates, as os.fsdecode() does.

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

namespace nusselt::python {

inline pybind11::str text_of(std::string_view bytes, const char* errors = "surrogateescape") {
    PyObject* const text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), errors);
    if (text == nullptr) throw pybind11::error_already_set();
    return pybind11::reinterpret_steal<pybind11::str>(text);
}

/// The inverse. \throws pybind11::error_already_set if the object is no text
inline std::string bytes_of(const pybind11::handle& text) {
    PyObject* const bytes = PyUnicode_AsEncodedString(text.ptr(), "utf-8", "surrogateescape");
    if (bytes == nullptr) throw pybind11::error_already_set();
    return std::string(pybind11::reinterpret_steal<pybind11::bytes>(bytes));
}

/// A list of texts.
template <class Texts>
pybind11::list texts_of(const Texts& texts) {
    pybind11::list list;
    for (const auto& text : texts) list.append(text_of(text));
    return list;
}

} // namespace nusselt::python
