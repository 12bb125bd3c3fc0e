#include "panels.h"

#include "controls.h"

#include "render/names.h"

#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <exception>
#include <filesystem>
#include <functional>
#include <utility>

namespace nusselt::viewer {

namespace {

/// A list to choose from.
template <class Values, class Value, class Choose>
void choice(const char* label, const Values& values, Value chosen, const Choose& choose) {
    if (!ImGui::BeginCombo(label, std::string(name_of(chosen)).c_str())) return;
    for (const auto value : values) {
        const bool is_chosen = value == chosen;
        if (ImGui::Selectable(std::string(name_of(value)).c_str(), is_chosen) && !is_chosen) choose(value);
    }
    ImGui::EndCombo();
}

/// A slider for a double.
bool slider(const char* label, double& value, double low, double high, const char* format,
            ImGuiSliderFlags flags = 0) {
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format, flags);
}

/// An arrow to drag for a length without bounds.
bool drag(const char* label, scene::Double3& value, double step) {
    double values[3] = {value.x, value.y, value.z};
    if (!ImGui::DragScalarN(label, ImGuiDataType_Double, values, 3, static_cast<float>(step), nullptr,
                            nullptr, "%.3f m"))
        return false;
    value = {values[0], values[1], values[2]};
    return true;
}

void draw_side(render::RenderSettings& settings) {
    choice("technique", render::kTechniques, settings.technique,
           [&](render::Technique technique) { choose_technique(technique, settings); });
    choice("strategies", render::kStrategies, settings.strategies,
           [&](render::Strategies strategies) { choose_strategies(strategies, settings); });
    choice("heuristic", render::kMisHeuristics, settings.mis,
           [&](render::Mis mis) { choose_mis(mis, settings); });
    ImGui::SliderFloat("v", &settings.visibility_estimate, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("approximate fraction of the lights that is visible, for the optimal heuristics");
    choice("sequence", render::kSampleOrders, settings.sample_order,
           [&](render::SampleOrder order) { settings.sample_order = order; });
    ImGui::SliderInt("samples", &settings.samples, 1, kMostFrameSamples, "%d",
                     ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    choice("BRDF", render::kBrdfChoices, settings.brdf,
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

} // namespace

void Panels::draw_settings(Viewer& viewer) {
    ViewState& state = viewer.state;
    ImGui::Checkbox("split", &state.is_split);
    ImGui::SameLine();
    ImGui::Checkbox("accumulate", &state.accumulates);
    ImGui::SameLine();
    ImGui::Checkbox("reference", &state.renders_reference);
    slider("exposure", state.exposure, -kLargestExposure / 4, kLargestExposure / 4, "%.1f stops");
    choice("show", render_vulkan::kShown, state.shown,
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
    const auto& lights = viewer.session.loaded().emitters;
    if (ImGui::BeginListBox("##lights", {-1, 6 * ImGui::GetTextLineHeightWithSpacing()})) {
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(lights.size()));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
                const auto light = static_cast<std::size_t>(i);
                const std::string label = fmt::format("{}: {}{}", i, lights[light].name,
                                                      state.edits.get(light).is_enabled ? "" : " (off)");
                if (ImGui::Selectable(label.c_str(), state.selected_light == light))
                    state.selected_light = light;
            }
        ImGui::EndListBox();
    }
    if (!state.selected_light) {
        ImGui::TextWrapped("Click a light to select it; drag it to move it.");
        return;
    }
    const bool is_being_edited = edited_light_ == state.selected_light;
    if (!is_being_edited) edit_ = state.edits.get(*state.selected_light);
    bool is_changed = false;
    bool is_final = false;
    const auto note = [&](bool changed) {
        is_changed |= changed;
        is_final |= ImGui::IsItemDeactivatedAfterEdit();
    };
    note(ImGui::Checkbox("on", &edit_.is_enabled));
    note(drag("move", edit_.move, 1e-3 * viewer.session.loaded().radius));
    note(slider("size", edit_.size, 0.05, 20, "%.2f",
                ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic));
    note(slider("brightness", edit_.brightness, 0.01, 100, "%.2f",
                ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic));
    if (ImGui::Button("reset")) {
        edit_ = LightEdit();
        is_final = true;
    }
    if (is_changed) edited_light_ = state.selected_light;
    if (is_final || (is_changed && viewer.session.times().build <= kQuickBuild))
        state.edits.set(*state.selected_light, edit_);
    if (is_final || !ImGui::IsAnyItemActive()) edited_light_.reset();
}

void Panels::draw_files(Viewer& viewer) {
    ImGui::InputText("file", &file_);
    const auto button = [&](const char* label, const char* done, const std::filesystem::path& file,
                            const std::function<void()>& act) {
        if (!ImGui::Button(label)) return;
        try {
            act();
            viewer.message = fmt::format("{} {}", done, file.string());
        } catch (const std::exception& error) {
            viewer.message = error.what();
        }
    };
    button("screenshot", "wrote", file_, [&] {
        command_ = write_screenshot(file_, viewer.session, viewer.state, viewer.files);
        fmt::print("{}\n", command_);
    });
    if (!command_.empty()) {
        ImGui::SameLine();
        if (ImGui::Button("copy the command")) ImGui::SetClipboardText(command_.c_str());
    }
    // A JSON file that was typed, else those beside the screenshot.
    const bool is_json = std::filesystem::path(file_).extension() == ".json";
    const std::filesystem::path camera = is_json ? std::filesystem::path(file_) : camera_file_of(file_);
    const std::filesystem::path lights = is_json ? std::filesystem::path(file_) : lights_file_of(file_);
    button("save camera", "wrote", camera, [&] { save_camera(camera, viewer.session, viewer.state); });
    ImGui::SameLine();
    button("load camera", "read", camera, [&] { load_camera(camera, viewer.session, viewer.state); });
    button("save lights", "wrote", lights, [&] { save_lights(lights, viewer.state); });
    ImGui::SameLine();
    button("load lights", "read", lights, [&] { viewer.load_lights(lights); });
    if (!viewer.message.empty()) ImGui::TextWrapped("%s", viewer.message.c_str());
}

void Panels::draw(Viewer& viewer) {
    ImGui::SetNextWindowPos({10, 10}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints({330, 0}, {600, ImGui::GetIO().DisplaySize.y - 20});
    if (ImGui::Begin("Nusselt (F1 hides this)", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::PushItemWidth(200);
        draw_times(viewer);
        draw_errors(viewer);
        ImGui::Separator();
        draw_settings(viewer);
        // A click on a light opens the section in which it can be edited.
        if (std::exchange(last_light_, viewer.state.selected_light) != viewer.state.selected_light)
            ImGui::SetNextItemOpen(true);
        if (ImGui::CollapsingHeader("lights")) draw_lights(viewer);
        if (ImGui::CollapsingHeader("files")) draw_files(viewer);
        if (ImGui::CollapsingHeader("keys"))
            ImGui::TextUnformatted("W A S D, Q E   fly (Shift: faster)\n"
                                   "right button   look around\n"
                                   "wheel          speed\n"
                                   "left button    select and drag lights,\n"
                                   "               drag the wipe\n"
                                   "F1             hide the panels");
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

} // namespace nusselt::viewer
