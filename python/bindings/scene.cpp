#include "python/bindings/scene.h"
#include "python/bindings/bindings.h"
#include "python/bindings/text.h"

#include "render/film.h"
#include "scene/import/importers.h"
#include "scene/model/bounds.h"
#include "scene/model/brdf_name.h"
#include "scene/model/fingerprint.h"
#include "scene/model/lights/light_report.h"
#include "scene/rig/camera_file.h"
#include "scene/rig/rig.h"
#include "scene/rig/rig_json.h"
#include "scene/rig/rig_text.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <sstream>
#include <vector>

namespace nusselt::python {

namespace py = pybind11;

namespace {

using scene::Float3;
using scene::Scene;

/// A read-only array over a vector of a scene, which it keeps alive.
template <class Number, class Element>
py::array view(const std::shared_ptr<const Scene>& owner, const std::vector<Element>& elements) {
    static_assert(sizeof(Element) % sizeof(Number) == 0);
    constexpr std::size_t kSize = sizeof(Element) / sizeof(Number);
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(elements.size())};
    if (kSize > 1) shape.push_back(kSize);
    auto keeper = std::make_unique<std::shared_ptr<const Scene>>(owner);
    const py::capsule capsule(keeper.get(),
                              [](void* scene) { delete static_cast<std::shared_ptr<const Scene>*>(scene); });
    static_cast<void>(keeper.release());
    py::array array(py::dtype::of<Number>(), shape, elements.data(), capsule);
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}

/// Defines a property with the array of a member of the scene.
template <class Number, class Element>
void def_array(py::class_<EditableScene>& type, const char* name, std::vector<Element> Scene::*member) {
    type.def_property_readonly(name, [member](const EditableScene& self) {
        const auto scene = self.get();
        return view<Number>(scene, (*scene).*member);
    });
}

py::tuple to_tuple(const Float3& v) { return py::make_tuple(v.x, v.y, v.z); }

py::list materials(const EditableScene& self) {
    using namespace py::literals;
    py::list list;
    for (const scene::Material& m : self.get()->materials)
        list.append(py::dict("name"_a = text_of(m.name), "model"_a = name_of(m.model),
                             "diffuse"_a = to_tuple(m.diffuse), "f0"_a = to_tuple(m.f0),
                             "roughness"_a = m.roughness, "exponent"_a = m.exponent, "alpha"_a = m.alpha,
                             "diffuse_texture"_a = m.diffuse_texture.texture));
    return list;
}

py::list textures(const EditableScene& self) {
    using namespace py::literals;
    py::list list;
    for (const scene::Texture& t : self.get()->textures)
        list.append(py::dict("name"_a = text_of(t.name), "width"_a = t.width, "height"_a = t.height,
                             "channels"_a = t.channels, "path"_a = text_of(t.path)));
    return list;
}

py::list instances(const EditableScene& self) {
    py::list list;
    const auto scene = self.get();
    for (const scene::Instance& instance : scene->instances)
        list.append(
            py::make_tuple(text_of(scene->objects[instance.object].name), instance.world_from_object));
    return list;
}

py::tuple bounds(const EditableScene& self) {
    const scene::Bounds box = scene_bounds(*self.get());
    return py::make_tuple(to_tuple(to_float(box.low)), to_tuple(to_float(box.high)));
}

EditableScene load(const std::string& path) {
    const WithoutGil released;
    return EditableScene(scene::load_scene(path));
}

/// \param name with which messages begin; files that the rig names are looked for beside it
void apply_rig_text(EditableScene& self, const std::string& text, const std::string& name) {
    const scene::Rig rig = scene::parse_rig(text, name);
    self.edit([&](Scene& scene) { apply_rig(rig, scene); });
}

void apply_rig_file(EditableScene& self, const std::string& path) {
    const scene::Rig rig = [&] {
        const WithoutGil released;
        return scene::read_rig(path);
    }();
    self.edit([&](Scene& scene) { apply_rig(rig, scene); });
}

std::string camera_text(const EditableScene& self) {
    const auto scene = self.get();
    return scene::to_camera_text({scene->camera, scene->film.width, scene->film.height});
}

py::str light_report(const EditableScene& self) {
    std::ostringstream text;
    write_light_report(*self.get(), text);
    return text_of(text.str());
}

py::list file_names(const EditableScene& self) {
    py::list names;
    for (const std::filesystem::path& file : self.get()->files) names.append(text_of(file.string()));
    return names;
}

} // namespace

void bind_scene(py::module_& module) {
    py::class_<EditableScene> type(module, "Scene");
    type.def(py::init(&load))
        .def(py::init<const EditableScene&>())
        .def("apply_rig_text", &apply_rig_text)
        .def("apply_rig_file", &apply_rig_file)
        .def("rig_text", [](const EditableScene& self) { return text_of(to_rig_text(*self.get())); })
        .def("camera_text", &camera_text)
        .def("apply_camera_text",
             [](EditableScene& self, const std::string& text) {
                 const scene::FilmedCamera view = scene::parse_camera(text, "camera");
                 self.edit([&](Scene& scene) { apply_camera(view, scene); });
             })
        .def("apply_camera_file",
             [](EditableScene& self, const std::string& path) {
                 const scene::FilmedCamera view = scene::read_camera_file(path);
                 self.edit([&](Scene& scene) { apply_camera(view, scene); });
             })
        .def("resize",
             [](EditableScene& self, int width, int height) {
                 self.edit([&](Scene& scene) { render::resize_film(scene, width, height); });
             })
        .def("light_report", &light_report)
        .def("fingerprint", [](const EditableScene& self) { return fingerprint(*self.get()); })
        .def_property_readonly("materials", &materials)
        .def_property_readonly("textures", &textures)
        .def_property_readonly("instances", &instances)
        .def_property_readonly("bounds", &bounds)
        .def_property_readonly("files", &file_names)
        .def_property_readonly("warnings",
                               [](const EditableScene& self) { return texts_of(self.get()->warnings); })
        .def_property_readonly("radius", [](const EditableScene& self) { return self.get()->radius; })
        .def_property_readonly("light_count",
                               [](const EditableScene& self) { return self.get()->lights.size(); })
        .def_property_readonly("pixel_samples",
                               [](const EditableScene& self) { return self.get()->film.pixel_samples; });
    def_array<float>(type, "positions", &Scene::positions);
    def_array<float>(type, "normals", &Scene::normals);
    def_array<float>(type, "uvs", &Scene::uvs);
    def_array<std::uint32_t>(type, "triangles", &Scene::triangles);
    def_array<std::uint32_t>(type, "triangle_materials", &Scene::triangle_material);
    def_array<std::int32_t>(type, "triangle_lights", &Scene::triangle_light);
}

} // namespace nusselt::python
