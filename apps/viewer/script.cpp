#include "script.h"

#include "render/names.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace nusselt::viewer {

namespace {

/// The words after the command.
using Arguments = std::vector<std::string>;

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

bool to_switch(const std::string& word) {
    if (word == "on") return true;
    if (word == "off") return false;
    throw std::invalid_argument("'" + word + "' must be on or off");
}

scene::Double3 to_vector(const Arguments& words) {
    return {to_coordinate(words[0]), to_coordinate(words[1]), to_coordinate(words[2])};
}

/// The number of arguments of a command, and its action.
struct Command {
    std::size_t arguments;
    std::function<void(Viewer&, const Arguments&)> run;
};

using Settings = render::RenderSettings;

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
}

std::map<std::string, Command> make_commands() {
    std::map<std::string, Command> commands = {
        {"split",
         {1,
          [](Viewer& viewer, const Arguments& words) {
              viewer.state.is_split = words[0] != "off";
              if (viewer.state.is_split) viewer.state.wipe = to_number(words[0], 0.0, 1.0);
          }}},
        {"accumulate",
         {1, [](Viewer& viewer, const Arguments& words) { viewer.state.accumulates = to_switch(words[0]); }}},
        {"reference",
         {1, [](Viewer& viewer,
                const Arguments& words) { viewer.state.renders_reference = to_switch(words[0]); }}},
        {"exposure",
         {1,
          [](Viewer& viewer, const Arguments& words) {
              viewer.state.exposure = to_number(words[0], -kLargestExposure, kLargestExposure);
          }}},
        {"show",
         {1,
          [](Viewer& viewer, const Arguments& words) {
              viewer.state.shown = render::from_name(render_vulkan::kShown, words[0]);
          }}},
        {"turn",
         {2,
          [](Viewer& viewer, const Arguments& words) {
              constexpr double kDegree = std::numbers::pi / 180;
              viewer.state.camera.turn(kDegree * to_number(words[0], -360.0, 360.0),
                                       kDegree * to_number(words[1], -360.0, 360.0));
          }}},
        {"move",
         {3, [](Viewer& viewer, const Arguments& words) { viewer.state.camera.move(to_vector(words)); }}},
        {"light",
         {1,
          [](Viewer& viewer, const Arguments& words) {
              const std::size_t count = viewer.session.loaded().emitters.size();
              if (count == 0) throw std::invalid_argument("the scene has no lights");
              viewer.state.selected_light = to_number(words[0], std::size_t{0}, count - 1);
          }}},
        {"light-move",
         {3,
          [](Viewer& viewer, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) { edit.move = to_vector(words); });
          }}},
        {"light-size",
         {1,
          [](Viewer& viewer, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) { edit.size = to_number(words[0], 0.001, 1000.0); });
          }}},
        {"light-brightness",
         {1,
          [](Viewer& viewer, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) { edit.brightness = to_number(words[0], 0.0, 1e6); });
          }}},
        {"light-switch",
         {1,
          [](Viewer& viewer, const Arguments& words) {
              edit_light(viewer, [&](LightEdit& edit) { edit.is_enabled = to_switch(words[0]); });
          }}},
        {"screenshot",
         {1,
          [](Viewer& viewer, const Arguments& words) {
              fmt::print("{}\n", write_screenshot(words[0], viewer.session, viewer.state, viewer.files));
          }}},
        {"save-camera",
         {1, [](Viewer& viewer,
                const Arguments& words) { save_camera(words[0], viewer.session, viewer.state); }}},
        {"load-camera",
         {1, [](Viewer& viewer,
                const Arguments& words) { load_camera(words[0], viewer.session, viewer.state); }}},
        {"save-lights",
         {1, [](Viewer& viewer, const Arguments& words) { save_lights(words[0], viewer.state); }}},
        {"load-lights", {1, [](Viewer& viewer, const Arguments& words) { viewer.load_lights(words[0]); }}},
        {"print-errors",
         {0,
          [](Viewer& viewer, const Arguments&) {
              const render_vulkan::DisplayErrors& errors = viewer.session.errors();
              if (viewer.session.reference_frames() == 0)
                  throw std::invalid_argument("no reference to compare with; start one with `reference on`");
              fmt::print("RMSE {}", errors.left);
              if (viewer.state.is_split) fmt::print(" left, {} right", errors.right);
              fmt::print(" against {} reference frames\n", viewer.session.reference_frames());
          }}},
        {"quit", {0, [](Viewer& viewer, const Arguments&) { viewer.is_closing = true; }}},
    };
    for (const auto& [name, choose] : setting_commands()) {
        for (const Side side : kSides) {
            const std::string prefix = side == Side::right ? "right-" : "";
            commands[prefix + name] = {1, [side, choose = choose](Viewer& viewer, const Arguments& words) {
                                           choose(viewer.state.of(side), words[0]);
                                       }};
        }
    }
    return commands;
}

const std::map<std::string, Command>& commands() {
    static const std::map<std::string, Command> all = make_commands();
    return all;
}

/// The text after the first word, without spaces at either end and without comments.
std::string rest_of(const std::string& text) {
    constexpr const char* kSpaces = " \t\r";
    const std::size_t end = text.find_last_not_of(kSpaces, text.find('#') - 1) + 1;
    const std::size_t word = text.find_first_not_of(kSpaces);
    const std::size_t begin = text.find_first_not_of(kSpaces, text.find_first_of(kSpaces, word));
    return text.substr(begin, end - begin);
}

/// The only command that takes time.
constexpr const char* kFrames = "frames";
constexpr long kMostFrames = 1'000'000;

} // namespace

Script::Script(const std::filesystem::path& path) : path_(path) {
    std::ifstream stream(path);
    if (!stream || !std::filesystem::is_regular_file(path))
        throw std::runtime_error(path.string() + ": the file cannot be read; check its name");
    std::string text;
    for (int number = 1; std::getline(stream, text); ++number) {
        std::istringstream words(text.substr(0, text.find('#')));
        Line line{number, {}};
        for (std::string word; words >> word;) line.words.push_back(word);
        if (line.words.empty()) continue;
        const std::string& name = line.words.front();
        const auto command = commands().find(name);
        if (name != kFrames && command == commands().end()) fail(number, "unknown command '" + name + "'");
        const std::size_t arguments = name == kFrames ? 1 : command->second.arguments;
        // File names may have spaces.
        if (arguments == 1 && line.words.size() > 1) line.words = {name, rest_of(text)};
        if (line.words.size() - 1 != arguments)
            fail(number, fmt::format("'{}' needs {} value{}, found {}", name, arguments,
                                     arguments == 1 ? "" : "s", line.words.size() - 1));
        lines_.push_back(line);
    }
}

void Script::fail(int line, const std::string& message) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", path_.string(), line, message));
}

void Script::run(const Line& line, Viewer& viewer) {
    const Arguments arguments(line.words.begin() + 1, line.words.end());
    if (line.words.front() == kFrames)
        frames_ = to_number(arguments[0], 1L, kMostFrames);
    else
        commands().at(line.words.front()).run(viewer, arguments);
}

void Script::advance(Viewer& viewer) {
    if (frames_ > 0) --frames_;
    while (frames_ == 0 && next_ < lines_.size() && !viewer.is_closing) {
        const Line& line = lines_[next_++];
        try {
            run(line, viewer);
        } catch (const std::exception& error) {
            fail(line.number, error.what());
        }
    }
}

} // namespace nusselt::viewer
