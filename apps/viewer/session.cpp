#include "session.h"

#include "render/film.h"
#include "render_vulkan/frame_records.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <utility>

namespace nusselt::viewer {

namespace {

using render_vulkan::Accumulator;
using render_vulkan::FrameTimes;
using Clock = std::chrono::steady_clock;

constexpr int kReferenceSamples = 4; ///< of a frame

constexpr Clock::time_point kNever = Clock::time_point::max();

/// What a submission of rows should take [s] when frames may be interrupted.
constexpr double kRowSeconds = 0.02;

/// Far from the seeds of the images that are compared with the reference.
constexpr std::uint32_t kReferenceSeedBit = 1u << 31;

} // namespace

render::RenderSettings reference_settings(const render::RenderSettings& settings) {
    render::RenderSettings reference;
    reference.technique = render::Technique::projected_solid_angle;
    if (settings.brdf == render::BrdfChoice::material) reference.strategies = render::Strategies::diffuse_ltc;
    reference.brdf = settings.brdf;
    reference.pixel_position = settings.pixel_position;
    reference.samples = kReferenceSamples;
    reference.seed = settings.seed ^ kReferenceSeedBit;
    return reference;
}

namespace {

/// An image, its settings and how many frames were rendered with them.
class Progress {
public:
    Progress(const render_vulkan::DeviceScene& scene, const render::RenderSettings& settings)
        : scene_(scene), settings_(settings), image_(scene, settings_) {}

    const Accumulator& image() const { return image_; }
    const render::RenderSettings& settings() const { return settings_; }
    std::uint32_t last_seed() const { return settings_.seed + frames_ - 1; }

    void follow(const render::RenderSettings& wanted) {
        if (wanted == settings_) return;
        image_.restart(wanted);
        settings_ = wanted;
        frames_ = 0;
        has_new_frame_ = false;
    }

    void restart() {
        image_.restart(settings_);
        frames_ = 0;
        has_new_frame_ = false;
    }

    /// Makes the next frame the only one, unless it has begun.
    void drop_frames_before() {
        if (!has_new_frame_ && !image_.is_adding()) image_.restart(settings_);
    }

    /// Goes on with a frame, unless one was finished since the last call of begin_frame().
    /// \returns whether it is finished; then `times` are those of the frame
    bool render(Clock::time_point end, FrameTimes& times) {
        if (has_new_frame_) return true;
        if (!image_.is_adding()) {
            render::RenderSettings frame = settings_;
            frame.camera_rays = 1;
            frame.seed = settings_.seed + frames_;
            image_.begin(render_vulkan::FrameRecords(scene_.film(), frame).make(0));
            times_ = {};
        }
        while (image_.is_adding()) {
            const auto begin = Clock::now();
            const FrameTimes added = image_.add_rows(end == kNever ? image_.height() : rows_);
            times_.visibility += added.visibility;
            times_.shading += added.shading;
            if (end == kNever) break;
            choose_rows(std::chrono::duration<double>(Clock::now() - begin).count());
            if (Clock::now() >= end) break;
        }
        if (image_.is_adding()) return false;
        ++frames_;
        has_new_frame_ = true;
        times = times_;
        return true;
    }

    void begin_frame() { has_new_frame_ = false; }

    /// Whether there is a frame, and none of which rows are missing.
    bool is_finished() const { return image_.frames() > 0 && !image_.is_adding(); }

private:
    void choose_rows(double seconds_of_last) {
        const double factor = kRowSeconds / std::max(seconds_of_last, 1e-6);
        rows_ = static_cast<std::uint32_t>(
            std::clamp(rows_ * std::clamp(factor, 0.5, 4.0), 1.0, static_cast<double>(image_.height())));
    }

    const render_vulkan::DeviceScene& scene_;
    render::RenderSettings settings_;
    Accumulator image_;
    std::uint32_t frames_ = 0; ///< that are finished
    bool has_new_frame_ = false;
    std::uint32_t rows_ =
        render_vulkan::kRowsTogether; ///< of the next submission: few, until it is known what they take
    FrameTimes times_;                ///< of the frame that is being rendered
};

/// A camera and a film that shows the same in fewer pixels.
/// \param reduction see ViewState::reduction
scene::Scene reduced_view(const scene::Camera& camera, const scene::Film& film, int reduction) {
    scene::Scene view;
    view.camera = camera;
    view.film = film;
    if (reduction > 1)
        render::resize_film(view, (film.width - 1) / reduction + 1, (film.height - 1) / reduction + 1);
    return view;
}

/// Left, right and reference in one resolution.
struct Level {
    /// \param scene with the camera and the film of this level
    Level(const render_vulkan::DeviceScene& scene, const scene::Camera& full_camera, int reduction_to_use,
          const ViewState& state)
        : reduction(reduction_to_use),
          camera(full_camera),
          left(scene, state.of(Side::left)),
          right(scene, state.of(Side::right)),
          reference(scene, reference_settings(state.of(Side::left))),
          display(scene.device(), left.image().width(), left.image().height()) {}

    void follow(const scene::Camera& wanted, const ViewState& state) {
        left.follow(state.of(Side::left));
        right.follow(state.of(Side::right));
        reference.follow(reference_settings(state.of(Side::left)));
        if (wanted == camera) return;
        camera = wanted;
        for (Progress* const progress : {&left, &right, &reference}) progress->restart();
    }

    bool render(const ViewState& state, Clock::time_point end, SessionTimes& times) {
        if (!state.accumulates) left.drop_frames_before();
        if (!left.render(end, times.frames[0])) return false;
        if (!state.is_split) {
            times.frames[1] = {};
        } else {
            if (!state.accumulates) right.drop_frames_before();
            if (!right.render(end, times.frames[1])) return false;
        }
        // References always accumulate.
        if (state.renders_reference && !reference.render(end, times.reference)) return false;
        for (Progress* const progress : {&left, &right, &reference}) progress->begin_frame();
        return true;
    }

    const Progress& side(Side side) const { return side == Side::left ? left : right; }

    /// Whether all images of the state are, see Progress::is_finished().
    bool is_finished(const ViewState& state) const {
        return left.is_finished() && (!state.is_split || right.is_finished()) &&
               (!state.renders_reference || reference.is_finished());
    }

    /// Whether there is something to see of what another level will show.
    bool stands_for(const Level& other) const {
        return left.image().frames() > 0 && camera == other.camera &&
               left.settings() == other.left.settings() && right.settings() == other.right.settings();
    }

    int reduction;
    scene::Camera camera; ///< of the resolution of the film
    Progress left, right, reference;
    render_vulkan::DisplayPass display;
};

} // namespace

/// The images in both resolutions, and what they are of.
class Session::Images {
public:
    Images(const gpu::Device& device, const scene::Scene& scene, render_vulkan::ShadowRays shadow_rays,
           const ViewState& state)
        : edits_(state.edits), film_(scene.film), scene_(device, scene, shadow_rays) {
        follow(scene.camera, state);
    }

    const LightEdits& edits() const { return edits_; }
    const Level& level() const { return *level_; } ///< that was rendered last
    const Level& shown() const { return *shown_; } ///< valid after show()

    void follow(const scene::Camera& camera, const ViewState& state) {
        std::optional<Level>& level = state.reduction == 1 ? full_ : reduced_;
        if (!level || level->reduction != state.reduction || level->camera != camera || level_ != &*level) {
            const scene::Scene view = reduced_view(camera, film_, state.reduction);
            scene_.set_view(view.camera, view.film);
        }
        if (!level || level->reduction != state.reduction)
            level.emplace(scene_, camera, state.reduction, state);
        level->follow(camera, state);
        level_ = &*level;
    }

    bool render(const ViewState& state, Clock::time_point end, SessionTimes& times) {
        return level_->render(state, end, times);
    }

    render_vulkan::DisplayErrors show(const ViewState& state) {
        const bool is_adding = level_->left.image().is_adding();
        // Frames that do not accumulate are seen when they are finished.
        if (shown_ != nullptr && is_adding && !state.accumulates) return errors_;
        const bool has_stand_in =
            reduced_ && level_->left.image().frames() == 0 && reduced_->stands_for(*level_);
        shown_ = has_stand_in ? &*reduced_ : level_;
        errors_ = shown_->display.show(shown_->left.image(), shown_->right.image(), shown_->reference.image(),
                                       {.exposure = state.exposure,
                                        .wipe = state.is_split ? state.wipe : 1,
                                        .shown = state.shown,
                                        .tone_curve = state.tone_curve});
        return errors_;
    }

private:
    LightEdits edits_;
    scene::Film film_;
    render_vulkan::DeviceScene scene_;
    std::optional<Level> full_, reduced_;
    Level* level_ = nullptr; ///< that is rendered
    Level* shown_ = nullptr;
    render_vulkan::DisplayErrors errors_; ///< of what is shown
};

namespace {

/// Those that a rig added.
std::vector<std::string> new_warnings(const scene::Scene& before, const scene::Scene& changed) {
    const auto old = static_cast<std::ptrdiff_t>(before.warnings.size());
    return {changed.warnings.begin() + old, changed.warnings.end()};
}

} // namespace

Session::Session(const gpu::Device& device, scene::Scene loaded, render_vulkan::ShadowRays shadow_rays)
    : device_(device), shadow_rays_(shadow_rays), loaded_(std::move(loaded)) {}

Session::~Session() = default;

void Session::apply(const scene::Rig& rig) {
    scene::Scene changed = loaded_;
    scene::apply_rig(rig, changed);
    rig_warnings_ = new_warnings(loaded_, changed);
    edit_warnings_.clear();
    loaded_ = std::move(changed);
    images_.reset();
}

std::vector<std::string> Session::warnings() const {
    std::vector<std::string> all = rig_warnings_;
    all.insert(all.end(), edit_warnings_.begin(), edit_warnings_.end());
    return all;
}

void Session::follow(const ViewState& state) {
    const scene::Camera camera = state.camera.camera();
    if (images_ && images_->edits() == state.edits) {
        images_->follow(camera, state);
        return;
    }
    const auto begin = Clock::now();
    scene::Scene scene = state.edits.applied_to(loaded_);
    edit_warnings_ = new_warnings(loaded_, scene);
    scene.camera = camera;
    // The next scene gets the memory of the last one.
    images_.reset();
    images_ = std::make_unique<Images>(device_, scene, shadow_rays_, state);
    times_.build = std::chrono::duration<double>(Clock::now() - begin).count();
}

bool Session::render(const ViewState& state, double seconds) {
    follow(state);
    const bool is_bounded = seconds < std::numeric_limits<double>::infinity();
    const auto end = is_bounded ? Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                     std::chrono::duration<double>(seconds))
                                : kNever;
    return images_->render(state, end, times_);
}

void Session::finish(const ViewState& state) {
    follow(state);
    if (images_->level().is_finished(state)) return;
    images_->render(state, kNever, times_);
}

void Session::show(const ViewState& state) {
    follow(state);
    errors_ = images_->show(state);
    const render_vulkan::DisplayPass& display = images_->shown().display;
    picture_size_ = {display.width(), display.height()};
    times_.display = display.seconds();
}

const render_vulkan::DisplayPass& Session::picture() const { return images_->shown().display; }

image::Image Session::image(Side side) const { return images_->level().side(side).image().mean(); }

std::uint32_t Session::frames(Side side) const {
    return images_ ? images_->level().side(side).image().frames() : 0;
}

std::uint32_t Session::reference_frames() const {
    return images_ ? images_->level().reference.image().frames() : 0;
}

std::uint32_t Session::seed(Side side) const { return images_->level().side(side).last_seed(); }

} // namespace nusselt::viewer
