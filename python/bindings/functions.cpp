#include "python/bindings/arrays.h"
#include "python/bindings/bindings.h"
#include "python/bindings/without_gil.h"

#include "tables/ltc_table.h"

#include <pybind11/stl.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace nusselt::python {

namespace py = pybind11;

namespace {

template <class Scalar>
const FunctionRow<Scalar>& row_of(std::string_view name) {
    const auto rows =
        base::dispatch(kernel_isa(), []<base::Isa isa> { return function_rows<isa, Scalar>(); });
    for (const FunctionRow<Scalar>& row : rows)
        if (name == row.name) return row;
    throw std::logic_error("no kernel of this name: " + std::string(name));
}

template <class Scalar>
void call(const std::string& name, const std::vector<std::ptrdiff_t>& shape,
          const std::vector<py::array>& inputs, const std::vector<py::array>& outputs, int threads,
          const tables::LtcTable* table) {
    const FunctionRow<Scalar>& row = row_of<Scalar>(name);
    const Loop<Scalar> loop = loop_of<Scalar>(shape, inputs, outputs);
    TableEntries entries = {};
    if (table != nullptr)
        entries = {table->entries.data(), table->roughnesses, table->inclinations, table->f0s};
    State state;
    state.alone = reinterpret_cast<const char*>(&entries);
    const WithoutGil released;
    run(row.kernel, row.lanes, state, loop, threads);
}

/// The entries as an array that keeps the table alive.
py::array entries_of(const py::object& owner) {
    const auto& table = owner.cast<const tables::LtcTable&>();
    py::array entries(py::dtype::of<float>(), {table.roughnesses, table.inclinations, table.f0s, 6},
                      table.entries.data(), owner);
    py::detail::array_proxy(entries.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return entries;
}

} // namespace

void bind_functions(py::module_& module) {
    py::class_<tables::LtcTable>(module, "LtcTable").def_property_readonly("entries", &entries_of);
    module.def("frostbite_table", &tables::frostbite_ltc_table, py::return_value_policy::reference);
    module.def("phong_table", &tables::phong_ltc_table, py::return_value_policy::reference);
    module.def("load_table",
               [](const std::string& path) { return tables::load_ltc_table(std::filesystem::path(path)); });
    module.def("call_float", &call<float>);
    module.def("call_double", &call<double>);
}

} // namespace nusselt::python
