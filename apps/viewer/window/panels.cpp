#include "panels.h"

#include "window.h"

#include "render/names.h"
#include "scene/colour/colour_space.h"
#include "viewer/print_line.h"
#include "viewer/view_files.h"

#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <utility>
#include <variant>

namespace nusselt::viewer {

namespace {

/// Explains the last control while the mouse is over it.
void explain(const char* text) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(28 * ImGui::GetFontSize());
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool button(const char* label, const char* explanation) {
    const bool is_pressed = ImGui::Button(label);
    explain(explanation);
    return is_pressed;
}

void checkbox(const char* label, bool& value, const char* explanation) {
    ImGui::Checkbox(label, &value);
    explain(explanation);
}

/// A list to choose from.
template <class Values, class Value, class Choose>
void choice(const char* label, const Values& values, Value chosen, const char* explanation,
            const Choose& choose) {
    const bool is_open = ImGui::BeginCombo(label, std::string(name_of(chosen)).c_str());
    if (!is_open) {
        explain(explanation);
        return;
    }
    for (const auto value : values) {
        const bool is_chosen = value == chosen;
        if (ImGui::Selectable(std::string(name_of(value)).c_str(), is_chosen) && !is_chosen) choose(value);
    }
    ImGui::EndCombo();
}

/// A slider for a double.
bool slider(const char* label, double& value, double low, double high, const char* format,
            const char* explanation, ImGuiSliderFlags flags = 0) {
    const bool is_changed =
        ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format, flags);
    explain(explanation);
    return is_changed;
}

/// Three numbers without bounds, to drag.
bool drag(const char* label, scene::Double3& value, double step, const char* format,
          const char* explanation) {
    double values[3] = {value.x, value.y, value.z};
    const bool is_changed = ImGui::DragScalarN(label, ImGuiDataType_Double, values, 3,
                                               static_cast<float>(step), nullptr, nullptr, format);
    explain(explanation);
    value = {values[0], values[1], values[2]};
    return is_changed;
}

void draw_side(render::RenderSettings& settings) {
    choice("technique", render::kTechniques, settings.technique,
           "How directions towards a light are sampled. `nusselt techniques` describes all of them.",
           [&](render::Technique technique) { choose_technique(technique, settings); });
    choice("strategies", render::kStrategies, settings.strategies,
           "What is sampled: the diffuse component only, or also the specular one by a second technique.",
           [&](render::Strategies strategies) { choose_strategies(strategies, settings); });
    choice("heuristic", render::kMisHeuristics, settings.mis,
           "How the samples of two techniques are weighted (multiple importance sampling).",
           [&](render::Mis mis) { choose_mis(mis, settings); });
    ImGui::SliderFloat("visible", &settings.visibility_estimate, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    explain(
        "The approximate fraction of the lights that is visible. The optimal heuristics use it as their v.");
    choice(
        "sequence", render::kSampleOrders, settings.sample_order,
        "Where the random numbers come from: Sobol points, strata, jittered points or independent numbers.",
        [&](render::SampleOrder order) { settings.sample_order = order; });
    ImGui::SliderInt("samples", &settings.samples, 1, kMostFrameSamples, "%d",
                     ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    explain("Samples of a frame, for each pixel, light and technique.");
    choice("BRDF", render::kBrdfChoices, settings.brdf,
           "Shade with the materials of the scene, or only with their diffuse component.",
           [&](render::BrdfChoice brdf) { settings.brdf = brdf; });
}

void draw_times(const Viewer& viewer) {
    const SessionTimes& times = viewer.session.times();
    ImGui::Text("%s", viewer.session.device().description().name.c_str());
    ImGui::Text("%.1f frames per second", static_cast<double>(ImGui::GetIO().Framerate));
    const auto row = [](const char* pass, double seconds) {
        ImGui::Text("%-22s %8.2f ms", pass, 1e3 * seconds);
    };
    row("visibility", times.frames[0].visibility);
    row("shading", times.frames[0].shading);
    if (viewer.state.is_split) {
        row("visibility, right", times.frames[1].visibility);
        row("shading, right", times.frames[1].shading);
    }
    if (viewer.state.renders_reference)
        row("reference", times.reference.visibility + times.reference.shading);
    row("display", times.display);
    if (viewer.state.reduction > 1)
        ImGui::Text("moving: 1 of %d x %d pixels", viewer.state.reduction, viewer.state.reduction);
}

void draw_errors(const Viewer& viewer) {
    const render_vulkan::DisplayErrors& errors = viewer.session.errors();
    const bool has_reference = viewer.session.reference_frames() > 0;
    for (const Side side : kSides) {
        if (side == Side::right && !viewer.state.is_split) continue;
        const std::uint32_t frames = viewer.session.frames(side);
        const std::string error =
            has_reference ? fmt::format(", RMSE {:.4g}", side == Side::left ? errors.left : errors.right)
                          : "";
        ImGui::Text("%s", fmt::format("{}: {} frame{}{}", side == Side::left ? "image" : "right", frames,
                                      frames == 1 ? "" : "s", error)
                              .c_str());
    }
    if (has_reference) ImGui::Text("reference: %u frames", viewer.session.reference_frames());
}

constexpr ImGuiSliderFlags kFactor = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic;

/// The colour of a light: a choice, and what it needs.
bool edit_colour(const scene::Float3& before, LightColour& colour) {
    static constexpr const char* kNames[] = {"as loaded", "temperature", "RGB"};
    auto kind = static_cast<int>(colour.index());
    bool is_changed = ImGui::Combo("colour", &kind, kNames, 3);
    explain(
        "Keep the colour of the scene, or use that of a black body or any other. All keep the brightness.");
    if (is_changed) {
        if (kind == 0) colour = std::monostate();
        if (kind == 1) colour = Temperature();
        if (kind == 2) colour = before;
    }
    if (auto* const temperature = std::get_if<Temperature>(&colour))
        is_changed |=
            slider("kelvin", temperature->kelvin, kLowestKelvin, kHighestKelvin, "%.0f K",
                   "The temperature of a black body: 2700 K is a warm lamp, 6500 K is daylight.", kFactor);
    if (auto* const radiance = std::get_if<scene::Float3>(&colour)) {
        const double luminance_before = luminance(to_double(before));
        const float largest = std::max({radiance->x, radiance->y, radiance->z, 1e-30f});
        float channels[] = {radiance->x / largest, radiance->y / largest, radiance->z / largest};
        const bool is_picked = ImGui::ColorEdit3("RGB", channels, ImGuiColorEditFlags_Float);
        explain("Linear RGB with the primaries of sRGB. The luminance of the light stays the same.");
        const scene::Double3 picked = {channels[0], channels[1], channels[2]};
        if (is_picked && luminance(picked) > 0)
            *radiance = to_float((luminance_before / luminance(picked)) * picked);
        is_changed |= is_picked;
    }
    return is_changed;
}

} // namespace

void Panels::draw_settings(Viewer& viewer) {
    ViewState& state = viewer.state;
    checkbox("split", state.is_split, "Show two images with separate settings; drag the line between them.");
    ImGui::SameLine();
    checkbox("accumulate", state.accumulates,
             "Average frames until something changes. Otherwise, show each frame as it is.");
    ImGui::SameLine();
    checkbox("reference", state.renders_reference,
             "Also render a third image, against which the errors of the others are measured.");
    slider("exposure", state.exposure, -kLargestExposure / 4, kLargestExposure / 4, "%.1f stops",
           "Brighten the picture by powers of two. Ctrl+click to type a value.");
    choice("tone curve", render_vulkan::kToneCurves, state.tone_curve,
           "How brightness beyond that of the display is compressed: clamped, x / (1 + luminance), or like "
           "film.",
           [&](render_vulkan::ToneCurve curve) { state.tone_curve = curve; });
    choice(
        "show", render_vulkan::kShown, state.shown,
        "The image, or its relative error: black up to 0.1 %, white from 100 %. The error needs a reference.",
        [&](render_vulkan::Shown shown) { state.shown = shown; });
    if (state.shown == render_vulkan::Shown::error && viewer.session.reference_frames() == 0)
        ImGui::TextWrapped("No reference to compare with: tick `reference`.");
    for (const Side side : kSides) {
        if (side == Side::right && !state.is_split) continue;
        const char* const title = !state.is_split      ? "image"
                                  : side == Side::left ? "left image"
                                                       : "right image";
        if (!ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen)) continue;
        ImGui::PushID(static_cast<int>(side));
        draw_side(state.of(side));
        ImGui::PopID();
    }
}

void Panels::draw_lights(Viewer& viewer) {
    ViewState& state = viewer.state;
    const scene::Scene& scene = viewer.session.loaded();
    const std::vector<std::size_t> lights = state.edits.lights(scene);
    if (ImGui::BeginListBox("##lights", {-1, 6 * ImGui::GetTextLineHeightWithSpacing()})) {
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(lights.size()));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
                const std::size_t light = lights[static_cast<std::size_t>(i)];
                const std::string label = fmt::format("{}: {}{}", light, state.edits.name(scene, light),
                                                      state.edits.get(light).is_enabled ? "" : " (off)");
                if (ImGui::Selectable(label.c_str(), state.selected_light == light))
                    state.selected_light = light;
                explain("A light of the scene, or one that was added. Click it to select it.");
            }
        ImGui::EndListBox();
    }
    if (button("add panel", "Add a square light in the middle of the image, which lights what is below."))
        viewer.add_light(LightShape::panel);
    ImGui::SameLine();
    if (button("add tube", "Add a tube in the middle of the image.")) viewer.add_light(LightShape::tube);
    ImGui::SameLine();
    if (button("add sphere", "Add a sphere in the middle of the image."))
        viewer.add_light(LightShape::sphere);
    ImGui::SameLine();
    if (button("add disk", "Add a disk in the middle of the image, which lights what is below."))
        viewer.add_light(LightShape::disk);
    if (button("undo", "Take back the last change of a light (Ctrl+Z).")) viewer.undo();
    ImGui::SameLine();
    if (button("redo", "Repeat what was taken back (Ctrl+Shift+Z).")) viewer.redo();
    if (state.selected_light)
        draw_selected_light(viewer);
    else
        ImGui::TextWrapped("Click a light to select it; drag it or its handles.");
}

void Panels::draw_selected_light(Viewer& viewer) {
    ViewState& state = viewer.state;
    const std::size_t light = *state.selected_light;
    const LightEdit now = state.edits.get(light);
    const bool is_being_edited = edited_light_ == light;
    if (!is_being_edited) edit_ = now;
    bool is_changed = false;
    bool is_final = false;
    const auto note = [&](bool changed) {
        is_changed |= changed;
        is_final |= ImGui::IsItemDeactivatedAfterEdit();
    };
    note(ImGui::Checkbox("on", &edit_.is_enabled));
    explain("Switch the light on or off.");
    note(drag("move", edit_.move, 1e-3 * viewer.session.loaded().radius, "%.3f m",
              "How far the light moves along x, y and z."));
    note(drag("turn", edit_.turn, 0.5, "%.1f deg",
              "A rotation about the centroid: its vector has the direction of the axis and the length of the "
              "angle. If two numbers are 0, the third is the angle about x, y or z."));
    note(slider("size", edit_.size, 0.05, 20, "%.2f", "A factor on all lengths of the light.", kFactor));
    note(slider("brightness", edit_.brightness, 0.01, 100, "%.2f", "A factor on what it emits.", kFactor));
    ImGui::BeginGroup();
    const bool has_new_colour =
        edit_colour(state.edits.emission_before(viewer.session.loaded(), light), edit_.colour);
    ImGui::EndGroup();
    note(has_new_colour);
    is_final |= draw_light_files(viewer, note);
    if (has_new_colour && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) is_final = true;
    if (button("reset", "Make the light what it was when it was loaded or added.")) {
        edit_ = LightEdit{.added = now.added};
        is_final = true;
    }
    ImGui::SameLine();
    if (button("remove", "Remove the light and its surface (Delete).")) {
        edited_light_.reset();
        viewer.remove_selected_light();
        return;
    }
    if (is_changed) edited_light_ = light;
    if (is_final || (is_changed && viewer.session.times().build <= kQuickBuild)) {
        // A frame of few pixels shows the change at once.
        viewer.is_moving |= edit_ != now;
        state.edits.set(light, edit_);
    }
    if (is_final) viewer.finish_edit();
    if (is_final || !ImGui::IsAnyItemActive()) edited_light_.reset();
}

bool Panels::draw_light_files(Viewer& viewer, const std::function<void(bool)>& note) {
    bool is_read = false;
    ImGui::InputText("light file", &light_file_);
    explain("An IES profile, an image or the map of an environment. The buttons below give it to the light.");
    const auto give = [&](const char* label, const char* explanation, const auto& read, auto& target) {
        if (!button(label, explanation)) return;
        try {
            target = viewer.read_light_file(read, light_file_);
            is_read = true;
        } catch (const std::exception& error) {
            viewer.message = error.what();
        }
    };
    give("profile", "Let the light shine as the luminaire of this IES file.", &scene::RigFiles::profile,
         edit_.profile.luminaire);
    ImGui::SameLine();
    give("image", "Let the light emit this image. The power stays.", &scene::RigFiles::image,
         edit_.image.image);
    ImGui::SameLine();
    give("map", "Give the environment this map. The power stays.", &scene::RigFiles::map, edit_.image.map);
    double angle = edit_.profile.angle.value_or(0);
    const bool is_turned = slider("profile angle", angle, -180, 180, "%.0f deg",
                                  "How far the profile is turned about its axis.");
    if (is_turned) edit_.profile.angle = angle;
    note(is_turned);
    double spread = edit_.profile.spread.value_or(scene::kWidestSpread);
    const bool is_spread =
        slider("spread", spread, 1, scene::kWidestSpread, "%.0f deg",
               "The angle of the cone that contains all light of a point. The power stays.");
    if (is_spread) {
        edit_.profile.spread = spread;
        edit_.profile.honeycomb.reset(); // they do not work together
    }
    note(is_spread);
    note(drag("turn map", edit_.map_turn, 0.5, "%.1f deg",
              "A rotation of the map of an environment, as `turn`. Its portal stays in its place."));
    return is_read;
}

void Panels::draw_files(Viewer& viewer) {
    ImGui::InputText("file", &file_);
    explain("The file of a screenshot: .png for the picture; .exr, .hdr or .pfm for the radiance. Cameras "
            "and lights use the same name, or this one if it ends in .json.");
    const auto act_on = [&](const char* label, const char* explanation, const char* done,
                            const std::filesystem::path& file, const std::function<void()>& act) {
        if (!button(label, explanation)) return;
        try {
            act();
            viewer.message = fmt::format("{} {}", done, file.string());
        } catch (const std::exception& error) {
            viewer.message = error.what();
        }
    };
    act_on("screenshot",
           "Save the picture, the camera and the lights, and print the command that renders it.", "wrote",
           file_, [&] {
               command_ = viewer.save_screenshot(file_);
               print_line(command_);
           });
    if (!command_.empty()) {
        ImGui::SameLine();
        if (button("copy the command", "Copy the command that renders the last screenshot."))
            ImGui::SetClipboardText(command_.c_str());
    }
    // A JSON file that was typed, else those beside the screenshot.
    const bool is_json = std::filesystem::path(file_).extension() == ".json";
    const std::filesystem::path camera = is_json ? std::filesystem::path(file_) : camera_file_of(file_);
    const std::filesystem::path lights = is_json ? std::filesystem::path(file_) : lights_file_of(file_);
    act_on("save camera", "Save the camera for --camera.", "wrote", camera,
           [&] { save_camera(camera, viewer.session, viewer.state, viewer.files); });
    ImGui::SameLine();
    act_on("load camera", "Look at the scene as a saved camera does.", "read", camera,
           [&] { load_camera(camera, viewer.session, viewer.state); });
    act_on("save lights", "Save the changes of lights as a rig for --lights.", "wrote", lights,
           [&] { save_lights(lights, viewer.session, viewer.state, viewer.files); });
    ImGui::SameLine();
    act_on("load lights", "Apply a rig for good. Earlier changes are lost.", "read", lights,
           [&] { viewer.load_lights(lights); });
}

void Panels::draw(Viewer& viewer) {
    constexpr ImGuiWindowFlags kDocked = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings;
    ImGui::SetNextWindowPos({0, 0});
    if (!viewer.shows_panel) {
        if (ImGui::Begin("##show", nullptr,
                         kDocked | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                             ImGuiWindowFlags_NoBackground))
            viewer.shows_panel = button(">", "Show the panel (F1).");
        ImGui::End();
        return;
    }
    ImGui::SetNextWindowSize({kPanelWidth, ImGui::GetIO().DisplaySize.y});
    if (ImGui::Begin("Nusselt (F1 hides this)", &viewer.shows_panel, kDocked)) {
        ImGui::PushItemWidth(200);
        draw_times(viewer);
        draw_errors(viewer);
        if (!viewer.message.empty()) ImGui::TextWrapped("%s", viewer.message.c_str());
        for (const std::string& warning : viewer.session.warnings())
            ImGui::TextWrapped("Warning: %s", warning.c_str());
        ImGui::Separator();
        draw_settings(viewer);
        // A click on a light opens the section in which it can be edited.
        if (std::exchange(last_light_, viewer.state.selected_light) != viewer.state.selected_light)
            ImGui::SetNextItemOpen(true);
        if (ImGui::CollapsingHeader("lights")) draw_lights(viewer);
        if (ImGui::CollapsingHeader("files")) draw_files(viewer);
        if (ImGui::CollapsingHeader("keys"))
            ImGui::TextUnformatted("W A S D, Q E    fly (Shift: faster)\n"
                                   "right button    look around\n"
                                   "middle button,\n"
                                   "Alt+left button go around the selected\n"
                                   "                light or the scene\n"
                                   "wheel           speed\n"
                                   "left button     select and drag lights\n"
                                   "                and their handles,\n"
                                   "                drag the wipe\n"
                                   "Ctrl+Z          undo\n"
                                   "Ctrl+Shift+Z    redo\n"
                                   "Delete          remove the light\n"
                                   "F1              hide the panel");
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

} // namespace nusselt::viewer
