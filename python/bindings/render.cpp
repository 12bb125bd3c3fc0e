#include "python/bindings/bindings.h"
#include "python/bindings/images.h"
#include "python/bindings/render_backend.h"
#include "python/bindings/render_settings.h"
#include "python/bindings/scene.h"
#include "python/bindings/text.h"
#include "python/bindings/without_gil.h"

#include "image/image.h"
#include "render/frame.h"
#include "render/merge.h"
#include "render/metadata.h"

#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::python {

namespace py = pybind11;

namespace {

/// How often Python hears of a rendering and can stop it.
constexpr std::chrono::milliseconds kInterval(50);

struct Outcome {
    Picture image;
    render::RenderStatistics statistics;
    double finished = 0;
    std::vector<std::string> warnings;
};

/// What the thread of Python and those of a rendering share.
struct Progress {
    std::atomic<double> fraction = 0;
    std::atomic<bool> cancel = false;
};

/// The renderings that run. Threads of Python that are daemons go on while Python ends, and their renderings would use
/// what the process destroys.
class Renderings {
public:
    /// \throws std::runtime_error if Python ends
    void add(Progress& progress) {
        const std::lock_guard lock(mutex_);
        if (ended_) throw std::runtime_error("Python ends; no rendering begins any more");
        running_.insert(&progress);
    }
    void remove(Progress& progress) {
        const std::lock_guard lock(mutex_);
        running_.erase(&progress);
        changed_.notify_all();
    }
    /// Cancels all of them, and waits for their ends.
    void end() {
        const WithoutGil released;
        std::unique_lock lock(mutex_);
        ended_ = true;
        for (Progress* progress : running_) progress->cancel = true;
        changed_.wait(lock, [&] { return running_.empty(); });
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::set<Progress*> running_;
    bool ended_ = false;
};

Renderings& renderings() {
    static Renderings all;
    return all;
}

/// One of them.
class Running {
public:
    explicit Running(Progress& progress) : progress_(progress) { renderings().add(progress); }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running() { renderings().remove(progress_); }

private:
    Progress& progress_;
};

Outcome render_scene(const scene::Scene& scene, const render::RenderSettings& settings,
                     const render::Backend& backend, Progress& progress) {
    const Running running(progress);
    if (const auto reason = backend.why_unsupported(scene, settings)) throw std::invalid_argument(*reason);
    Outcome outcome;
    outcome.warnings = backend.warnings(scene, settings);
    render::Frame frame = render::make_frame(scene, settings);
    const auto prepared = backend.prepare(scene);
    render::RenderMonitor monitor;
    monitor.cancel = &progress.cancel;
    monitor.progress = [&](double fraction) { progress.fraction = fraction; };
    outcome.statistics = prepared->render_into(frame, settings, monitor);
    outcome.finished = finished_fraction(frame);
    image::Metadata metadata = make_metadata(scene, settings, backend);
    metadata["render_seconds"] = image::metadata_text(outcome.statistics.render_seconds);
    metadata["finished_fraction"] = image::metadata_text(outcome.finished);
    outcome.image = unpacked(to_layered_image(std::move(frame), scene.film, settings, std::move(metadata)));
    return outcome;
}

/// As Python's bool(). \throws py::error_already_set if the object has no truth value
bool truth(const py::object& object) {
    const int value = PyObject_IsTrue(object.ptr());
    if (value < 0) throw py::error_already_set();
    return value != 0;
}

/// Waits for a rendering and calls Python meanwhile. What that throws, Ctrl-C for example, ends the rendering.
Outcome wait_for(std::future<Outcome> rendering, Progress& progress, const py::object& callback) {
    const auto report = [&] {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (callback.is_none()) return;
        const py::object answer = callback(progress.fraction.load());
        if (!answer.is_none() && !truth(answer)) progress.cancel = true;
    };
    const auto wait = [&] {
        const WithoutGil released;
        return rendering.wait_for(kInterval) == std::future_status::ready;
    };
    try {
        while (!wait()) report();
        report();
    } catch (...) {
        progress.cancel = true;
        const WithoutGil released;
        rendering.wait();
        throw;
    }
    return rendering.get();
}

py::dict to_dict(const render::RenderStatistics& s) {
    using namespace py::literals;
    return py::dict("render_seconds"_a = s.render_seconds, "build_seconds"_a = s.build_seconds,
                    "primary_seconds"_a = s.primary_seconds, "shading_seconds"_a = s.shading_seconds,
                    "shadow_seconds"_a = s.shadow_seconds, "primary_rays"_a = s.primary_rays,
                    "shadow_rays"_a = s.shadow_rays, "rejected_samples"_a = s.rejected_samples,
                    "lines"_a = s.lines.lines, "line_parts"_a = s.lines.parts, "threads"_a = s.threads);
}

/// \returns (parts of the image, statistics, finished fraction, warnings)
py::tuple render(const EditableScene& edited, const py::dict& arguments, const BackendChoice& choice,
                 const py::object& progress_callback) {
    const std::shared_ptr<const scene::Scene> scene = edited.get();
    const render::RenderSettings settings = settings_of(arguments, scene->film);
    const std::unique_ptr<render::Backend> backend = make_backend(choice, *scene, settings);
    Progress progress;
    Outcome outcome = wait_for(
        std::async(std::launch::async, [&] { return render_scene(*scene, settings, *backend, progress); }),
        progress, progress_callback);
    return py::make_tuple(to_tuple(std::move(outcome.image)), to_dict(outcome.statistics), outcome.finished,
                          texts_of(outcome.warnings));
}

/// \returns (parts of the image, which parts are missing or unfinished)
py::tuple merge(const std::vector<std::pair<std::string, py::tuple>>& images) {
    render::Merger merger;
    for (const auto& [name, parts] : images) merger.add(layered_image_of(parts), name);
    return py::make_tuple(to_tuple({merger.result(), ""}), text_of(merger.what_is_missing()));
}

} // namespace

void bind_render(py::module_& module) {
    py::class_<BackendChoice>(module, "BackendChoice")
        .def(py::init<>())
        .def_readwrite("name", &BackendChoice::name)
        .def_readwrite("threads", &BackendChoice::threads)
        .def_readwrite("isa", &BackendChoice::isa)
        .def_readwrite("device", &BackendChoice::device)
        .def_readwrite("shadow_rays", &BackendChoice::shadow_rays);
    module.def("render", &render);
    module.def("merge", &merge);
    py::module_::import("atexit").attr("register")(py::cpp_function([] { renderings().end(); }));
    module.def("setting_names", &setting_names);
}

} // namespace nusselt::python
