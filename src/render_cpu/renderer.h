#pragma once
/// Renders direct light of a scene with all cores.

#include "base/isa.h"
#include "image/image.h"
#include "render/settings.h"
#include "render_cpu/frame.h"
#include "render_cpu/kernel_arrays.h"
#include "scene/model/scene.h"
#include "visibility/embree_scene.h"
#include "visibility/line_bvh.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>

namespace nusselt::render_cpu {

/// How a rendering talks to its surroundings while it runs. All members may be left empty.
struct RenderMonitor {
    /// Called with the share of finished pixels, in (0, 1], from any thread, never by two at once.
    std::function<void(double fraction)> progress;
    /// Called with the number in Frame::tiles of each tile once its pixels are final. As above; its caller waits.
    std::function<void(std::size_t tile)> tile_finished;
    /// Once this is true, no further tile is begun.
    const std::atomic<bool>* cancel = nullptr;
};

/// Work for line samples.
struct LineStatistics {
    double build_seconds = 0;      ///< of their bounding volume hierarchy
    double visibility_seconds = 0; ///< for visible parts of lines, the sum over all threads
    std::uint64_t lines = 0;
    std::uint64_t parts = 0;       ///< visible ones of all lines
    std::uint64_t line_lights = 0; ///< pairs of a shading point and a light with lines
    /// Pairs that got points: there are many occluders, or partly present ones, or too few lines.
    std::uint64_t point_lights = 0;
    std::uint64_t box_tests = 0;      ///< of boxes against what lines span with their shading point
    std::uint64_t triangle_tests = 0; ///< of triangles against that
    std::uint64_t shadow_tests = 0;   ///< of shadows of triangles against a pack of lines
};

struct RenderStatistics {
    double build_seconds = 0;  ///< of the bounding volume hierarchy
    double render_seconds = 0; ///< wall clock, from first to last tile
    // Sums over all threads [s].
    double primary_seconds = 0; ///< tracing of camera rays
    double shading_seconds = 0; ///< all but tracing
    double shadow_seconds = 0;  ///< tracing of shadow rays
    std::uint64_t primary_rays = 0;
    std::uint64_t shadow_rays = 0;
    /// Light samples that count as black because their direction, density or reflected radiance is NaN or
    /// infinite: 0 unless there is NaN or overflow in the scene, or a bug.
    std::uint64_t rejected_samples = 0;
    LineStatistics lines;
    int threads = 0;
};

struct RenderResult {
    image::Image image;               ///< pixels that were not rendered are black
    std::vector<image::Layer> layers; ///< see make_frame()
    RenderStatistics statistics;
    double finished_fraction = 0; ///< of the pixels of the part; below 1 if it was cancelled
};

/// A scene that is ready for rendering. Several renderings may run at once.
class Renderer {
public:
    /// Builds the bounding volume hierarchy.
    /// \param scene        must outlive the renderer; its film gives the size of images
    /// \param thread_count threads for building and rendering, at least 1
    /// \throws std::runtime_error see EmbreeScene and KernelArrays
    Renderer(const scene::Scene& scene, int thread_count);

    /// \throws std::invalid_argument see validate()
    /// \throws std::runtime_error see make_frame(), and LineBvh for line samples
    RenderResult render(const RenderSettings& settings, base::Isa isa,
                        const RenderMonitor& monitor = {}) const;

    /// As above with another way to trace rays, which must behave like that of the scene.
    RenderResult render(const RenderSettings& settings, base::Isa isa, const visibility::RayTracer& tracer,
                        const RenderMonitor& monitor = {}) const;

    /// Renders the tiles of a frame that are not finished.
    /// \param frame    from make_frame() with this scene and these settings
    /// \param settings valid
    /// \throws std::runtime_error see LineBvh, for line samples
    RenderStatistics render_into(Frame& frame, const RenderSettings& settings, base::Isa isa,
                                 const visibility::RayTracer& tracer, const RenderMonitor& monitor) const;

    const visibility::EmbreeScene& visibility() const { return embree_; }

private:
    /// The hierarchy for line samples, which is built when it is needed first.
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
    tbb::global_control thread_limit_;
    mutable tbb::task_arena arena_;
    double build_seconds_ = 0;
    KernelArrays arrays_;
    visibility::EmbreeScene embree_;
    mutable Lines lines_;
};

/// Number of threads that the machine runs at once.
int default_thread_count();

/// Settings, program version and a fingerprint of the scene, for the metadata of image files.
image::Metadata make_metadata(const scene::Scene& scene, const RenderSettings& settings, base::Isa isa);

} // namespace nusselt::render_cpu
