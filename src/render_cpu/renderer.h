#pragma once
/// Renders the direct light of a scene on the processor.

#include "base/isa.h"
#include "image/image.h"
#include "render/frame.h"
#include "render/monitor.h"
#include "render/result.h"
#include "render/settings.h"
#include "render_cpu/integrator.h"
#include "render_cpu/kernel_arrays.h"
#include "render_cpu/lights/light_kernel.h"
#include "scene/model/scene.h"
#include "visibility/embree_scene.h"
#include "visibility/line_bvh.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <mutex>
#include <optional>
#include <span>

namespace nusselt::render_cpu {

/// The memory for the sums of layers of lights in all threads, beside that of the frame [bytes].
std::size_t layer_sum_bytes(const scene::Scene& scene, const RenderSettings& settings, base::Isa isa,
                            int threads);

/// A scene that is ready for rendering. Several renderings may run at once.
class Renderer {
public:
    /// Builds the bounding volume hierarchy.
    /// \param scene        must outlive the renderer; its film gives the size of images
    /// \param thread_count threads for building and rendering, at least 1
    /// \param integrator   must outlive the renderer
    /// \param kernels      likewise
    /// \throws std::runtime_error see EmbreeScene and KernelArrays
    Renderer(const scene::Scene& scene, int thread_count,
             const Integrator& integrator = integrators().front(),
             std::span<const LightKernel> kernels = light_kernels());

    /// \throws std::invalid_argument see validate()
    /// \throws std::runtime_error see make_frame(), and LineBvh for line samples
    RenderResult render(const RenderSettings& settings, base::Isa isa,
                        const RenderMonitor& monitor = {}) const;

    /// Renders with another ray tracer, which must behave like that of the scene.
    RenderResult render(const RenderSettings& settings, base::Isa isa, const visibility::RayTracer& tracer,
                        const RenderMonitor& monitor = {}) const;

    /// Renders the tiles of a frame that are not finished. What it was stopped in is in Frame::begun, for the next call.
    /// \param frame    from make_frame() with this scene and these settings
    /// \param settings valid
    /// \throws std::runtime_error see LineBvh, for line samples; if a tile of Frame::begun has the wrong size; if the
    ///         machine has too little memory for the layers
    RenderStatistics render_into(Frame& frame, const RenderSettings& settings, base::Isa isa,
                                 const visibility::RayTracer& tracer, const RenderMonitor& monitor) const;

    const visibility::EmbreeScene& visibility() const { return embree_; }

private:
    /// The hierarchy for line samples, built when it is first needed.
    class Lines {
    public:
        visibility::LineBvhView get(const scene::Scene& scene, tbb::task_arena& arena);
        double build_seconds() const { return build_seconds_; }

    private:
        std::once_flag once_;
        std::optional<visibility::LineBvh> bvh_;
        double build_seconds_ = 0;
    };

    const scene::Scene& scene_;
    int thread_count_;
    const Integrator* integrator_;
    tbb::global_control thread_limit_;
    mutable tbb::task_arena arena_;
    double build_seconds_ = 0;
    KernelArrays arrays_;
    visibility::EmbreeScene embree_;
    mutable Lines lines_;
};

/// The number of hardware threads.
int default_thread_count();

/// The number of threads that run at once when a renderer has `count`: scenes are loaded with the default number.
int largest_thread_count(int count);

/// The number of threads that a command shall use: `count` or, without one, the number of hardware threads. To be called
/// before a scene is loaded, because oneTBB ends the program where the system does not start a thread.
/// \throws std::runtime_error see base::check_threads()
int checked_thread_count(std::optional<int> count);

} // namespace nusselt::render_cpu
