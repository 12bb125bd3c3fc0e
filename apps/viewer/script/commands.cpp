#include "commands.h"

#include "base/file_checks.h"
#include "image/io.h"
#include "render/names.h"
#include "viewer/print_line.h"
#include "viewer/view_files.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace nusselt::viewer {

namespace {

/// \throws std::invalid_argument unless it is a number from low to high
template <class Number>
Number to_number(const std::string& word, Number low, Number high) {
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !(value >= low && value <= high))
        throw std::invalid_argument(fmt::format("'{}' must be a number from {} to {}", word, low, high));
    return value;
}

double to_coordinate(const std::string& word) {
    constexpr double kFarthest = 1e6;
    return to_number(word, -kFarthest, kFarthest);
}

double to_radians(const std::string& degrees) {
    return std::numbers::pi / 180 * to_number(degrees, -360.0, 360.0);
}

bool to_switch(const std::string& word) {
    if (word == "on") return true;
    if (word == "off") return false;
    throw std::invalid_argument("'" + word + "' must be on or off");
}

scene::Double3 to_vector(const Arguments& words) {
    return {to_coordinate(words[0]), to_coordinate(words[1]), to_coordinate(words[2])};
}

/// An axis and an angle, as LightEdit::turn.
scene::Double3 to_turn(const Arguments& words) {
    const scene::Double3 axis = to_vector(words);
    const double degrees = to_number(words[3], -360.0, 360.0);
    if (length(axis) == 0) throw std::invalid_argument("the axis must not be zero");
    return degrees * normalized(axis);
}

double to_spread(const std::string& word) {
    return to_number(word, scene::kNarrowestSpread, scene::kWidestSpread);
}

FilmPosition to_position(const Arguments& words) {
    return {to_coordinate(words[0]), to_coordinate(words[1])};
}

using Settings = render::RenderSettings;

constexpr long kMostFrames = 1'000'000;

/// Commands on the settings of one side.
std::map<std::string, std::function<void(Settings&, const std::string&)>> setting_commands() {
    return {
        {"technique",
         [](Settings& settings, const std::string& name) {
             choose_technique(render::from_name(render::kTechniques, name), settings);
         }},
        {"strategies",
         [](Settings& settings, const std::string& name) {
             choose_strategies(render::from_name(render::kStrategies, name), settings);
         }},
        {"mis",
         [](Settings& settings, const std::string& name) {
             choose_mis(render::from_name(render::kMisHeuristics, name), settings);
         }},
        {"visibility-estimate",
         [](Settings& settings, const std::string& value) {
             settings.visibility_estimate = to_number(value, 0.0f, 1.0f);
         }},
        {"sampler",
         [](Settings& settings, const std::string& name) {
             settings.sample_order = render::from_name(render::kSampleOrders, name);
         }},
        {"brdf",
         [](Settings& settings, const std::string& name) {
             settings.brdf = render::from_name(render::kBrdfChoices, name);
         }},
        {"samples",
         [](Settings& settings, const std::string& value) {
             settings.samples = to_number(value, 1, kMostFrameSamples);
         }},
    };
}

void edit_light(Viewer& viewer, const std::function<void(LightEdit&)>& change) {
    if (!viewer.state.selected_light)
        throw std::invalid_argument("no light is selected; select one with `light N`");
    const std::size_t light = *viewer.state.selected_light;
    LightEdit edit = viewer.state.edits.get(light);
    change(edit);
    viewer.state.edits.set(light, edit);
    viewer.finish_edit();
}

/// Commands on lights.
std::map<std::string, Command> light_commands() {
    return {
        {"light",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              const std::vector<std::size_t> lights = viewer.state.edits.lights(viewer.session.loaded());
              if (lights.empty()) throw std::invalid_argument("the scene has no lights");
              const auto light = to_number(words[0], lights.front(), lights.back());
              if (!viewer.state.edits.has(viewer.session.loaded(), light))
                  throw std::invalid_argument(fmt::format("light {} was removed", light));
              viewer.state.selected_light = light;
          }}},
        {"light-move",
         {3,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) { edit.move = to_vector(words); });
          }}},
        {"light-turn",
         {4,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              const scene::Double3 turn = to_turn(words);
              edit_light(viewer, [&](LightEdit& edit) { edit.turn = turn; });
          }}},
        {"light-size",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) { edit.size = to_number(words[0], 0.001, 1000.0); });
          }}},
        {"light-brightness",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) { edit.brightness = to_number(words[0], 0.0, 1e6); });
          }}},
        {"light-kelvin",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) {
                  edit.colour = Temperature{to_number(words[0], kLowestKelvin, kHighestKelvin)};
              });
          }}},
        {"light-radiance",
         {3,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              const auto channel = [&](std::size_t i) { return to_number(words[i], 0.0f, 1e6f); };
              edit_light(viewer, [&](LightEdit& edit) {
                  edit.colour = scene::Float3{channel(0), channel(1), channel(2)};
              });
          }}},
        {"light-profile",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) {
                  edit.profile.luminaire = viewer.read_light_file(&scene::RigFiles::profile, words[0]);
              });
          }}},
        {"light-profile-turn",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer,
                         [&](LightEdit& edit) { edit.profile.angle = to_number(words[0], -360.0, 360.0); });
          }}},
        {"light-spread",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) {
                  edit.profile.spread = to_spread(words[0]);
                  edit.profile.honeycomb.reset();
              });
          }}},
        {"light-honeycomb",
         {2,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) {
                  edit.profile.honeycomb = {to_spread(words[0]), to_spread(words[1])};
                  edit.profile.spread.reset();
              });
          }}},
        {"light-image",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) {
                  edit.image.image = viewer.read_light_file(&scene::RigFiles::image, words[0]);
              });
          }}},
        {"light-map",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) {
                  edit.image.map = viewer.read_light_file(&scene::RigFiles::map, words[0]);
              });
          }}},
        {"light-map-turn",
         {4,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              const scene::Double3 turn = to_turn(words);
              edit_light(viewer, [&](LightEdit& edit) { edit.map_turn = turn; });
          }}},
        {"light-switch",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) { edit.is_enabled = to_switch(words[0]); });
          }}},
        {"light-add",
         {1, [](Viewer& viewer, Playback&,
                const Arguments& words) { viewer.add_light(render::from_name(kLightShapes, words[0])); }}},
        {"light-remove",
         {0, [](Viewer& viewer, Playback&, const Arguments&) { viewer.remove_selected_light(); }}},
        {"undo", {0, [](Viewer& viewer, Playback&, const Arguments&) { viewer.undo(); }}},
        {"redo", {0, [](Viewer& viewer, Playback&, const Arguments&) { viewer.redo(); }}},
        {"press",
         {2, [](Viewer& viewer, Playback&,
                const Arguments& words) { viewer.pointer.press(to_position(words), 1, viewer); }}},
        {"drag",
         {2, [](Viewer& viewer, Playback&,
                const Arguments& words) { viewer.pointer.move_to(to_position(words), viewer); }}},
        {"release", {0, [](Viewer& viewer, Playback&, const Arguments&) { viewer.pointer.release(viewer); }}},
    };
}

std::map<std::string, Command> make_commands() {
    std::map<std::string, Command> commands = {
        {"split",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              viewer.state.is_split = words[0] != "off";
              if (viewer.state.is_split) viewer.state.wipe = to_number(words[0], 0.0, 1.0);
          }}},
        {"accumulate",
         {1, [](Viewer& viewer, Playback&,
                const Arguments& words) { viewer.state.accumulates = to_switch(words[0]); }}},
        {"reference",
         {1, [](Viewer& viewer, Playback&,
                const Arguments& words) { viewer.state.renders_reference = to_switch(words[0]); }}},
        {"exposure",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              viewer.state.exposure = to_number(words[0], -kLargestExposure, kLargestExposure);
          }}},
        {"show",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              viewer.state.shown = render::from_name(render_vulkan::kShown, words[0]);
          }}},
        {"tone-curve",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              viewer.state.tone_curve = render::from_name(render_vulkan::kToneCurves, words[0]);
          }}},
        {"panel",
         {1, [](Viewer& viewer, Playback&,
                const Arguments& words) { viewer.shows_panel = to_switch(words[0]); }}},
        {"orbit",
         {2, [](Viewer& viewer, Playback&,
                const Arguments& words) { viewer.orbit(to_radians(words[0]), to_radians(words[1])); }}},
        {"window-screenshot",
         {1,
          [](Viewer& viewer, Playback& playback, const Arguments& words) {
              base::check_distinct({words[0]}, viewer.files.inputs);
              image::check_writable_image(words[0]);
              viewer.window_screenshot = words[0];
              playback.frames_left = 1;
          }}},
        {"turn",
         {2,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              viewer.state.camera.turn(to_radians(words[0]), to_radians(words[1]));
          }}},
        {"move",
         {3, [](Viewer& viewer, Playback&,
                const Arguments& words) { viewer.state.camera.move(to_vector(words)); }}},
        {"screenshot",
         {1, [](Viewer& viewer, Playback&,
                const Arguments& words) { print_line(viewer.save_screenshot(words[0])); }}},
        {"save-camera",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              save_camera(words[0], viewer.session, viewer.state, viewer.files);
          }}},
        {"load-camera",
         {1, [](Viewer& viewer, Playback&,
                const Arguments& words) { load_camera(words[0], viewer.session, viewer.state); }}},
        {"save-lights",
         {1,
          [](Viewer& viewer, Playback&, const Arguments& words) {
              save_lights(words[0], viewer.session, viewer.state, viewer.files);
          }}},
        {"load-lights",
         {1, [](Viewer& viewer, Playback&, const Arguments& words) { viewer.load_lights(words[0]); }}},
        {"print-errors",
         {0,
          [](Viewer& viewer, Playback&, const Arguments&) {
              const render_vulkan::DisplayErrors& errors = viewer.session.errors();
              if (viewer.session.reference_frames() == 0)
                  throw NothingToPrint("no reference to compare with; start one with `reference on`");
              print_line(
                  fmt::format("RMSE {}{} against {} reference frames", errors.left,
                              viewer.state.is_split ? fmt::format(" left, {} right", errors.right) : "",
                              viewer.session.reference_frames()));
          }}},
        {"frames",
         {1, [](Viewer&, Playback& playback,
                const Arguments& words) { playback.begin(to_number(words[0], 1L, kMostFrames)); }}},
        {"turning",
         {2,
          [](Viewer&, Playback& playback, const Arguments& words) {
              playback.turning_right = to_radians(words[0]);
              playback.turning_up = to_radians(words[1]);
          }}},
        {"print-speed",
         {0,
          [](Viewer&, Playback& playback, const Arguments&) {
              if (!playback.timed) throw NothingToPrint("no frames to time; render some with `frames N`");
              const TimedFrames& timed = *playback.timed;
              print_line(fmt::format("{:.2f} frames per second, {} x {} pixels",
                                     static_cast<double>(timed.count) / timed.seconds, timed.size.width,
                                     timed.size.height));
          }}},
        {"quit", {0, [](Viewer& viewer, Playback&, const Arguments&) { viewer.is_closing = true; }}},
    };
    commands.merge(light_commands());
    for (const auto& [name, choose] : setting_commands()) {
        for (const Side side : kSides) {
            const std::string prefix = side == Side::right ? "right-" : "";
            commands[prefix + name] = {
                1, [side, choose = choose](Viewer& viewer, Playback&, const Arguments& words) {
                    choose(viewer.state.of(side), words[0]);
                }};
        }
    }
    return commands;
}

} // namespace

void Playback::begin(long frames) {
    frames_left = count = frames;
    begin_time = Clock::now();
}

void Playback::note_frame(const Session& session) {
    if (frames_left == 0 || --frames_left > 0 || count == 0) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_time).count();
    timed = {std::exchange(count, 0), seconds, session.picture_size()};
}

const std::map<std::string, Command>& commands() {
    static const std::map<std::string, Command> all = make_commands();
    return all;
}

} // namespace nusselt::viewer
