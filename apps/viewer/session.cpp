#include "session.h"

#include "render_vulkan/frame_records.h"

#include <chrono>
#include <utility>

namespace nusselt::viewer {

namespace {

using render_vulkan::Accumulator;
using render_vulkan::FrameTimes;
using Clock = std::chrono::steady_clock;

constexpr int kReferenceSamples = 4; ///< of a frame

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

/// Left, right, reference, and what they are of.
class Session::Images {
public:
    Images(const gpu::Device& device, const scene::Scene& scene, render_vulkan::ShadowRays shadow_rays,
           const ViewState& state)
        : edits_(state.edits),
          camera_(scene.camera),
          scene_(device, scene, shadow_rays),
          left_(scene_, state.of(Side::left)),
          right_(scene_, state.of(Side::right)),
          reference_(scene_, reference_settings(state.of(Side::left))),
          display_(device, left_.image.width(), left_.image.height()) {}

    const LightEdits& edits() const { return edits_; }
    const Accumulator& side(Side side) const { return (side == Side::left ? left_ : right_).image; }
    const Accumulator& reference() const { return reference_.image; }
    std::uint32_t seed(Side side) const { return (side == Side::left ? left_ : right_).last_seed(); }
    const render_vulkan::DisplayPass& display() const { return display_; }

    void follow(const scene::Camera& camera, const ViewState& state) {
        left_.follow(state.of(Side::left));
        right_.follow(state.of(Side::right));
        reference_.follow(reference_settings(state.of(Side::left)));
        if (camera == camera_) return;
        scene_.set_camera(camera);
        camera_ = camera;
        for (Progress* progress : {&left_, &right_, &reference_}) progress->restart();
    }

    FrameTimes add_frame(Side side, bool accumulates) {
        Progress& progress = side == Side::left ? left_ : right_;
        if (!accumulates) progress.image.restart(progress.settings);
        return progress.add_frame(scene_.film());
    }

    FrameTimes add_reference_frame() { return reference_.add_frame(scene_.film()); }

    render_vulkan::DisplayErrors show(const render_vulkan::DisplaySettings& settings) {
        return display_.show(left_.image, right_.image, reference_.image, settings);
    }

private:
    /// An image, its settings and how many frames were rendered with them.
    struct Progress {
        Progress(const render_vulkan::DeviceScene& scene, const render::RenderSettings& settings_to_use)
            : settings(settings_to_use), image(scene, settings) {}

        std::uint32_t last_seed() const { return settings.seed + frames - 1; }

        void follow(const render::RenderSettings& wanted) {
            if (wanted == settings) return;
            image.restart(wanted);
            settings = wanted;
            frames = 0;
        }

        void restart() {
            image.restart(settings);
            frames = 0;
        }

        FrameTimes add_frame(const scene::Film& film) {
            render::RenderSettings frame = settings;
            frame.camera_rays = 1;
            frame.seed = settings.seed + frames++;
            return image.add(render_vulkan::FrameRecords(film, frame).make(0));
        }

        render::RenderSettings settings;
        Accumulator image;
        std::uint32_t frames = 0;
    };

    LightEdits edits_;
    scene::Camera camera_;
    render_vulkan::DeviceScene scene_;
    Progress left_, right_, reference_;
    render_vulkan::DisplayPass display_;
};

Session::Session(const gpu::Device& device, scene::Scene loaded, render_vulkan::ShadowRays shadow_rays)
    : device_(device), shadow_rays_(shadow_rays), loaded_(std::move(loaded)) {}

Session::~Session() = default;

void Session::apply(const scene::Rig& rig) {
    scene::Scene changed = loaded_;
    scene::apply_rig(rig, changed);
    loaded_ = std::move(changed);
    images_.reset();
}

void Session::follow(const ViewState& state) {
    const scene::Camera camera = state.camera.camera();
    if (images_ && images_->edits() == state.edits) {
        images_->follow(camera, state);
        return;
    }
    const auto begin = Clock::now();
    scene::Scene scene = state.edits.applied_to(loaded_);
    scene.camera = camera;
    // The next scene gets the memory of the last one.
    images_.reset();
    images_ = std::make_unique<Images>(device_, scene, shadow_rays_, state);
    times_.build = std::chrono::duration<double>(Clock::now() - begin).count();
}

void Session::render(const ViewState& state) {
    follow(state);
    times_.frames[0] = images_->add_frame(Side::left, state.accumulates);
    times_.frames[1] = state.is_split ? images_->add_frame(Side::right, state.accumulates) : FrameTimes();
}

void Session::render_reference(const ViewState& state) {
    follow(state);
    times_.reference = images_->add_reference_frame();
}

void Session::show(const ViewState& state) {
    follow(state);
    errors_ = images_->show(
        {.exposure = state.exposure, .wipe = state.is_split ? state.wipe : 1, .shown = state.shown});
    times_.display = images_->display().seconds();
}

const render_vulkan::DisplayPass& Session::picture() const { return images_->display(); }

image::Image Session::image(Side side) const { return images_->side(side).mean(); }

std::uint32_t Session::frames(Side side) const { return images_ ? images_->side(side).frames() : 0; }

std::uint32_t Session::reference_frames() const { return images_ ? images_->reference().frames() : 0; }

std::uint32_t Session::seed(Side side) const { return images_->seed(side); }

} // namespace nusselt::viewer
