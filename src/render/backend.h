#pragma once
/// The face of both renderers for programs: the processor or a GPU.

#include "image/image.h"
#include "render/frame.h"
#include "render/monitor.h"
#include "render/result.h"
#include "render/settings.h"
#include "render/statistics.h"
#include "scene/model/scene.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nusselt::render {

/// A scene that is ready for rendering. One rendering at a time.
class PreparedScene {
public:
    PreparedScene() = default;
    virtual ~PreparedScene() = default;
    PreparedScene(const PreparedScene&) = delete;
    PreparedScene& operator=(const PreparedScene&) = delete;

    /// Renders the tiles of a frame that are not finished, and marks them as finished.
    /// \param frame    from make_frame() with this scene and these settings
    /// \param settings valid, and supported by the backend
    /// \throws std::runtime_error if the scene is too large for these settings, or a device is lost
    virtual RenderStatistics render_into(Frame& frame, const RenderSettings& settings,
                                         const RenderMonitor& monitor) = 0;
};

/// Names and values in the order in which reports list them.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;
using NamedSeconds = std::vector<std::pair<std::string, double>>;

/// The times of the phases of a rendering.
struct TimeReport {
    NamedSeconds preparation; ///< wall clock, before the first piece of work
    std::string work_name;    ///< whose times the following are
    NamedSeconds work;        ///< sums over all threads or passes
};

class Backend {
public:
    Backend() = default;
    virtual ~Backend() = default;
    Backend(const Backend&) = delete;
    Backend& operator=(const Backend&) = delete;

    /// The name by which users choose the backend.
    virtual std::string_view name() const = 0;

    /// The reason for which settings are not supported, whatever the scene; nothing if they are. \param settings valid
    virtual std::optional<std::string> why_unsupported(const RenderSettings& settings) const = 0;

    /// The same for a scene, whatever its lights: covers the settings alone, too. Reasons do not say what to do instead.
    virtual std::optional<std::string> why_unsupported(const scene::Scene& scene,
                                                       const RenderSettings& settings) const = 0;

    /// What the backend does in another way than settings ask for, a sentence each. \param settings valid and supported
    virtual std::vector<std::string> warnings(const scene::Scene& /*scene*/,
                                              const RenderSettings& /*settings*/) const {
        return {};
    }

    /// The memory that layers take while the backend renders, beside that of the frame [bytes]. \param settings valid
    virtual std::size_t layer_sum_bytes(const scene::Scene& scene, const RenderSettings& settings) const = 0;

    /// \param scene must outlive the result; its film gives the size of images
    /// \throws std::runtime_error if the backend cannot hold the scene
    virtual std::unique_ptr<PreparedScene> prepare(const scene::Scene& scene) const = 0;

    /// Metadata about the backend for image files, beside make_metadata(): the bits of images depend on it.
    virtual image::Metadata metadata() const = 0;

    /// The description of the backend in reports.
    virtual NamedTexts properties() const = 0;

    /// \param statistics of one of its renderings
    virtual TimeReport times(const RenderStatistics& statistics) const = 0;
};

/// Makes a frame and renders it.
/// \throws std::invalid_argument see validate(), and for settings that the backend does not support
/// \throws std::runtime_error see make_frame(), Backend::prepare() and PreparedScene::render_into()
RenderResult render(const Backend& backend, const scene::Scene& scene, const RenderSettings& settings,
                    const RenderMonitor& monitor = {});

} // namespace nusselt::render
