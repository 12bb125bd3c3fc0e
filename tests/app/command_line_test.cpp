// Runs the program as a user does: exit codes, messages and files.

#include "noise_image.h"
#include "program.h"

#include "common/results_json.h"

#include "image/io.h"
#include "image/metrics.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace nusselt {

namespace {

TEST_F(CommandLine, RendersToAllFormatsAndTellsHowLongItTook) {
    const Outcome render =
        run("render '" + kScenes +
            "/room.pbrt' --resolution 64x36 --spp 4 -o a.exr -o a.png -o a.hdr -q --json -");
    ASSERT_EQ(render.exit_code, 0) << render.err;
    EXPECT_EQ(render.err, "");
    const auto json = nlohmann::json::parse(render.out);
    EXPECT_EQ(json["width"], 64);
    EXPECT_EQ(json["height"], 36);
    EXPECT_EQ(json["rays"]["primary"], 4 * 64 * 36);
    EXPECT_EQ(json["rejected_samples"], 0);
    EXPECT_EQ(json["sampler"], "sobol");
    EXPECT_EQ(json["brdf"], "material");
    EXPECT_EQ(json["pixel_position"], "jittered");
    EXPECT_EQ(json["camera_rays"], 4);
    EXPECT_EQ(json["seed"], 0);
    for (const char* phase : {"load", "bvh", "render", "write", "total"})
        EXPECT_GE(json["seconds"][phase], 0.0) << phase;

    const image::Image exr = image::read_image(path("a.exr"));
    const image::Image hdr = image::read_image(path("a.hdr"));
    EXPECT_EQ(exr.width, 64);
    EXPECT_EQ(exr.height, 36);
    EXPECT_LT(image::compare(hdr, exr).relative_rmse, 0.02);
    EXPECT_EQ(image::read_image(path("a.png")).width, 64);
    const image::Metadata metadata = image::read_exr_metadata(path("a.exr"));
    EXPECT_EQ(metadata.at("technique"), "projected_solid_angle");
    EXPECT_EQ(metadata.at("scene"), "room.pbrt");
    EXPECT_EQ(metadata.at("isa"), json["isa"]);
}

TEST_F(CommandLine, TheSameCommandGivesTheSameImageAndAnotherSeedDoesNot) {
    const std::string render = "render '" + kScenes + "/cornell-panel.pbrt' --resolution 48x48 -q ";
    for (const char* rest : {"-o a.exr", "-o b.exr", "-o c.exr --seed 7"})
        ASSERT_EQ(run(render + rest).exit_code, 0);
    const Outcome same = run("compare a.exr b.exr --json -");
    ASSERT_EQ(same.exit_code, 0) << same.err;
    EXPECT_EQ(nlohmann::json::parse(same.out)["images"][0]["mse"], 0.0);
    const Outcome other = run("compare a.exr c.exr --json -");
    ASSERT_EQ(other.exit_code, 0) << other.err;
    EXPECT_GT(nlohmann::json::parse(other.out)["images"][0]["mse"], 0.0);
}

TEST_F(CommandLine, BrokenLimitsExitWithThree) {
    image::write_image(path("a.exr"), noise(20, 20));
    image::Image brighter = noise(20, 20);
    for (float& value : brighter.pixels) value += 0.5f;
    image::write_image(path("b.exr"), brighter);
    EXPECT_EQ(run("compare b.exr a.exr --max mse=0.26 --min mse=0.24").exit_code, 0);
    const Outcome broken = run("compare b.exr a.exr --max mse=0.24");
    EXPECT_EQ(broken.exit_code, 3);
    EXPECT_EQ(broken.err, "nusselt compare: 'b.exr': mse is 0.25, above the limit of 0.24\n");
}

TEST_F(CommandLine, ComparingAPictureWithRadianceWarns) {
    for (const char* name : {"a.exr", "a.png", "b.png"}) image::write_image(path(name), noise(20, 20));
    const Outcome mixed = run("compare a.png a.exr");
    EXPECT_EQ(mixed.exit_code, 0);
    EXPECT_EQ(
        mixed.err,
        "nusselt compare: 'a.png' cannot hold values above 1, and 'a.exr' can; compare images of one kind\n");
    EXPECT_EQ(run("compare b.png a.png").err, "");
    EXPECT_EQ(run("compare a.exr a.exr").err, "");
}

TEST_F(CommandLine, TellsWhatASceneAndTheProgramContain) {
    const Outcome info = run("info '" + kScenes + "/cornell-tube.pbrt'");
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_NE(info.out.find("line"), std::string::npos) << info.out;
    const Outcome techniques = run("techniques");
    EXPECT_EQ(techniques.exit_code, 0);
    for (const char* name : {"area", "solid_angle", "clipped_solid_angle", "projected_solid_angle",
                             "projected_solid_angle_biased"})
        EXPECT_NE(techniques.out.find(name), std::string::npos) << name;
    const Outcome list = run_lab("reproduce --list");
    EXPECT_EQ(list.exit_code, 0);
    for (const char* name : {"line-diffuse  ", "inverse-distribution  "})
        EXPECT_NE(list.out.find(name), std::string::npos) << list.out;
}

TEST_F(CommandLine, ReproduceWritesAPage) {
    const std::string command = "reproduce line-diffuse --quick --scenes '" + kScenes + "' -o pages";
    const Outcome reproduce = run_lab(command);
    EXPECT_EQ(reproduce.exit_code, 0) << reproduce.out << reproduce.err;
    EXPECT_NE(read("pages/index.html").find("line-diffuse"), std::string::npos);
    for (const char* file : {"reference.exr", "reference.png", "area.exr", "projected_solid_angle.png"})
        EXPECT_GT(std::filesystem::file_size(path("pages/line-diffuse/quick/" + std::string(file))), 100u)
            << file;
    const auto json = nlohmann::json::parse(read("pages/line-diffuse/quick/numbers.json"));
    EXPECT_EQ(json.at("bench"), "line-diffuse");
    const auto errors = nusselt_test::records(json, "errors");
    ASSERT_FALSE(errors.empty());
    EXPECT_EQ(errors[0].at("region"), "image");
    EXPECT_GT(errors[0].at("rmse"), 0.0);

    // A second run only says that nothing has changed.
    const Outcome again = run_lab(command);
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_EQ(again.out, "\npages/index.html\n");
    EXPECT_NE(again.err.find("nothing has changed"), std::string::npos) << again.err;
}

TEST_F(CommandLine, ReproduceSaysWhichRendererIsMissing) {
    const Outcome outcome =
        run_lab("reproduce peers-panel --scenes '" + kScenes + "' -o pages", "PATH=/nowhere");
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err; // as it was asked for
    EXPECT_NE(outcome.err.find("peers-panel: not run: Blender is missing"), std::string::npos) << outcome.err;
    EXPECT_NE(read("pages/index.html").find("{\"name\":\"peers-panel\",\"reason\":\"Blender is missing"),
              std::string::npos);
}

TEST_F(CommandLine, EveryBenchWritesOneFormat) {
    const std::string frame = " '" + kScenes + "/cornell-panel.pbrt' --resolution 16x16 --repetitions 1";
    for (const std::string& command :
         {"bench rays" + frame, "bench strategies" + frame,
          "bench emission-frames '" + kScenes + "/television.pbrt' --resolution 16x16 --repetitions 1",
          std::string("bench tubes --repetitions 1"), std::string("bench phong-lines --repetitions 1"),
          std::string("bench samplers --repetitions 1"), std::string("bench accuracy --count 20"),
          std::string("bench shadows --count 5"),
          std::string("bench worst-case --target lines --starts 2 --convergence 10"),
          std::string("fuzz --count 64 --technique LineArea"),
          std::string("fit-ltc --size 2x2x2 --brdf lambert -o lambert")}) {
        const Outcome outcome = run_lab(command + " --json -");
        ASSERT_EQ(outcome.exit_code, 0) << command << ": " << outcome.err;
        const auto json = nlohmann::json::parse(outcome.out);
        EXPECT_NE(command.find(json.at("bench").get<std::string>()), std::string::npos) << command;
        const std::string typed = "nusselt-lab " + command.substr(0, command.find(" '"));
        EXPECT_EQ(json.at("command").get<std::string>().find(typed), 0u) << json.at("command");
        for (const char* key : {"version", "machine", "settings"})
            EXPECT_FALSE(json.at(key).empty()) << command << ", " << key;
        ASSERT_FALSE(json.at("tables").empty()) << command;
        for (const auto& table : json.at("tables"))
            EXPECT_FALSE(nusselt_test::records(json, table.at("name")).empty())
                << command << ", " << table.at("name");
    }
}

TEST_F(CommandLine, TimesASecondTechnique) {
    const Outcome bench =
        run_lab("bench strategies '" + kScenes + "/planes.pbrt' --resolution 64x48 --repetitions 3");
    EXPECT_EQ(bench.exit_code, 0) << bench.err;
    EXPECT_NE(bench.out.find("diffuse+ltc"), std::string::npos) << bench.out;
}

TEST_F(CommandLine, ComparesEmissionThatVariesWithItsMean) {
    const Outcome none =
        run_lab("bench emission-frames '" + kScenes + "/cornell-panel.pbrt' --resolution 16x16");
    EXPECT_EQ(none.exit_code, 1);
    expect_lab_message(none.err, "no area light has an image or a profile");
    const Outcome bench = run_lab("bench emission-frames '" + kScenes +
                                  "/television.pbrt' --resolution 64x48 --repetitions 3 --json -");
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    const auto rows = nusselt_test::records(nlohmann::json::parse(bench.out), "emission_frames");
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0]["ratio"], 1.0);
    EXPECT_GT(rows[2]["ratio"], 1.0) << "products take time, and the uniform scene must have none";
}

TEST_F(CommandLine, MeasuresWhatLinesCost) {
    const Outcome bench =
        run_lab("bench lines --lines 4,16 '" + kScenes +
                "/cornell-panel.pbrt' --resolution 32x32 --repetitions 1 --offsets length --json -");
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    const nlohmann::json json = nlohmann::json::parse(bench.out);
    const auto ray = nusselt_test::records(json, "shadow_ray");
    EXPECT_GT(ray[0]["shadow_rays"], 0);
    EXPECT_GT(ray[0]["time"], 0.0);
    EXPECT_EQ(json["settings"]["offsets"], "length");
    const auto rows = nusselt_test::records(json, "lines");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1]["lines"], 16);
    EXPECT_EQ(rows[1]["traced_lines"].get<int>(), 4 * rows[0]["traced_lines"].get<int>());
    for (const char* key : {"visibility_over_shadow_ray", "line_over_point", "triangles_per_light"})
        EXPECT_GT(rows[0][key], 0.0) << key;
    EXPECT_EQ(run_lab("bench lines a.pbrt --lines 0").exit_code, 2);
}

TEST_F(CommandLine, MeasuresHowLongLinesTakeToTheErrorOfPoints) {
    const Outcome bench =
        run_lab("bench line-efficiency '" + kScenes +
                "/cornell-panel.pbrt' --resolution 16x16 --repetitions 2 --most-points 16 --most-lines 4 "
                "--roughness 0.5 --strategies diffuse+ltc --orientation fixed --threads 2 --json -");
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    const nlohmann::json json = nlohmann::json::parse(bench.out);
    EXPECT_EQ(json["settings"]["roughness"], 0.5);
    EXPECT_EQ(json["settings"]["orientation"], "fixed");
    EXPECT_EQ(json["settings"]["most_points"], 16);
    const auto curves = nusselt_test::records(json, "curves");
    ASSERT_EQ(curves.size(), 9u) << "three points of three curves";
    EXPECT_EQ(curves[0]["samples"], "points");
    EXPECT_EQ(curves[0]["seeds"], 4);
    EXPECT_EQ(nusselt_test::records(json, "equal_error").size(), 3u);
    EXPECT_LT(curves[2]["variance"], curves[0]["variance"]);
    EXPECT_EQ(curves[3]["samples"], "lines");
    EXPECT_LT(curves[5]["variance"], curves[3]["variance"]);
    EXPECT_EQ(run_lab("bench line-efficiency a.pbrt --roughness 2").exit_code, 2);
}

TEST_F(CommandLine, PrintsTheNoiseOfTubes) {
    const Outcome bench = run_lab("bench tubes --repetitions 1");
    EXPECT_EQ(bench.exit_code, 0) << bench.err;
    for (const char* text : {"rejection", "before a wide cap", "long and close"})
        EXPECT_NE(bench.out.find(text), std::string::npos) << bench.out;
}

TEST_F(CommandLine, ComparesPhongLobesAlongLines) {
    const Outcome bench = run_lab("bench phong-lines --repetitions 1 --isa sse42");
    EXPECT_EQ(bench.exit_code, 0) << bench.err;
    for (const char* text : {"packs of 4, sse42", "recursion", "table", "100000"})
        EXPECT_NE(bench.out.find(text), std::string::npos) << bench.out;
}

TEST_F(CommandLine, WorstCaseSearchGoesOnWhereItStopped) {
    const std::string search = "bench worst-case --target lines --convergence 0 --json - ";
    const auto found = [](const Outcome& outcome) {
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto json = nlohmann::json::parse(outcome.out);
        auto target = nusselt_test::records(json, "targets").at(0);
        target["parameters"] = nusselt_test::records(json, "parameters");
        return target;
    };
    const auto at_once = found(run_lab(search + "--starts 30 --seed 5"));
    EXPECT_EQ(found(run_lab(search + "--starts 10 --seed 5 --state search.json")).at("starts"), 10);
    const std::string first = read("search.json");
    // Another target leaves it alone; fewer starts than were made change nothing.
    EXPECT_EQ(
        run_lab("bench worst-case --target biased --starts 1 --convergence 0 --state search.json").exit_code,
        0);
    EXPECT_EQ(found(run_lab(search + "--starts 3 --state search.json")).at("starts"), 10);
    const auto continued = found(run_lab(search + "--starts 30 --threads 2 --state search.json"));
    EXPECT_EQ(continued, at_once);
    EXPECT_NE(read("search.json"), first);

    const Outcome other_seed = run_lab(search + "--starts 40 --seed 6 --state search.json");
    EXPECT_EQ(other_seed.exit_code, 1);
    expect_lab_message(other_seed.err, "--seed");
    std::ofstream(path("broken.json"))
        << R"({"seed": 1, "targets": {"lines": {"starts": 1, "parameters": ["0xg"]}}})";
    const Outcome broken = run_lab(search + "--starts 40 --state broken.json");
    EXPECT_EQ(broken.exit_code, 1);
    expect_lab_message(broken.err, "broken.json");
    std::ofstream(path("longer.json")) << first << '\0' << "more";
    const Outcome longer = run_lab(search + "--starts 40 --state longer.json");
    EXPECT_EQ(longer.exit_code, 1);
    expect_lab_message(longer.err, "longer.json");
    const Outcome no_folder = run_lab(search + "--starts 40 --state missing/search.json");
    EXPECT_EQ(no_folder.exit_code, 1);
    expect_lab_message(no_folder.err, "missing");
}

TEST_F(CommandLine, WorstCaseSearchPrintsTables) {
    const Outcome outcome = run_lab("bench worst-case --target lines --starts 3 --convergence 100");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* text : {"lines", "tilt", "0x", "bound", "order"})
        EXPECT_NE(outcome.out.find(text), std::string::npos) << text;
}

/// Reads up to the first line with this text. \returns false if there is none
bool wait_for_line(std::FILE* stream, const char* text) {
    char line[256];
    while (std::fgets(line, sizeof line, stream) != nullptr)
        if (std::strstr(line, text) != nullptr) return true;
    return false;
}

/// Starts a program and interrupts it once it has reported progress.
/// \returns its exit code
int run_until_interrupted(const char* program, std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), program);
    arguments.push_back(nullptr);
    int errors[2];
    if (::pipe(errors) != 0) return -1;
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(errors[1], STDERR_FILENO);
        ::close(errors[0]);
        ::close(errors[1]);
        ::execv(program, const_cast<char**>(arguments.data()));
        std::_Exit(127);
    }
    ::close(errors[1]);
    std::FILE* const messages = ::fdopen(errors[0], "r");
    EXPECT_TRUE(wait_for_line(messages, "% done"));
    EXPECT_EQ(::kill(child, SIGINT), 0);
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    std::fclose(messages);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(CommandLine, RenderTakesAsManySamplesAsTheSceneAsksFor) {
    std::ofstream(path("scene.pbrt")) << R"(Sampler "halton" "integer pixelsamples" 12
        Camera "perspective" WorldBegin AreaLightSource "diffuse"
        Shape "trianglemesh" "point P" [0 0 1 1 0 1 0 1 1] "integer indices" [0 1 2])";
    const auto rendered = [&](const std::string& options) {
        const Outcome outcome = run("render scene.pbrt --resolution 8x8 -o a.exr " + options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return std::pair(image::read_exr_metadata(path("a.exr")), outcome.err);
    };
    const auto [metadata, notes] = rendered("");
    EXPECT_EQ(metadata.at("samples"), "12");
    EXPECT_EQ(metadata.at("camera_rays"), "12");
    EXPECT_NE(notes.find("12 samples per pixel, as the Sampler of the scene asks; --spp changes that\n"),
              std::string::npos)
        << notes;
    EXPECT_EQ(rendered("--camera-rays 4").first.at("camera_rays"), "4");
    expect_message(run("render scene.pbrt --spp 6 --camera-rays 5 -o a.exr").err,
                   "--camera-rays: 5 must divide the 6 samples per pixel that --spp asks for");
    const auto [given, nothing] = rendered("--spp 3");
    EXPECT_EQ(given.at("samples"), "3");
    EXPECT_EQ(nothing.find("Sampler"), std::string::npos);
    const Outcome misfit = run("render scene.pbrt --camera-rays 5 -o a.exr");
    EXPECT_EQ(misfit.exit_code, 2);
    expect_message(misfit.err,
                   "--camera-rays: 5 must divide the 12 samples per pixel that the Sampler of the "
                   "scene asks for; --spp changes them");

    // What the scene asks for has the limits that options have.
    std::ofstream(path("many.pbrt")) << "Sampler \"halton\" \"integer pixelsamples\" 65536\n";
    const Outcome lines = run("render many.pbrt --light-samples lines --lines 65536 -o a.exr");
    EXPECT_EQ(lines.exit_code,
              run("render many.pbrt --light-samples lines --lines 65536 --spp 65536").exit_code);
    expect_message(lines.err, "lines");
    std::ofstream(path("most.pbrt")) << "Sampler \"halton\" \"integer pixelsamples\" 2147483647\n";
    const Outcome most = run("render most.pbrt --resolution 1x1 -o a.exr");
    EXPECT_NE(
        most.err.find("1048576 samples per pixel, the largest number; the Sampler of the scene asks for "
                      "2147483647; --spp changes that\n"),
        std::string::npos)
        << most.err;
}

TEST_F(CommandLine, CtrlCWritesWhatIsThere) {
    const std::string output = path("stopped.exr");
    const std::string scene = kScenes + "/room.pbrt";
    EXPECT_EQ(run_until_interrupted(kProgram, {"render", scene.c_str(), "--spp", "64", "-o", output.c_str()}),
              130);
    EXPECT_EQ(image::read_image(output).width, 1280);
    EXPECT_LT(std::stod(image::read_exr_metadata(output).at("finished_fraction")), 1.0);
}

TEST_F(CommandLine, CtrlCKeepsWorstCases) {
    const std::string state = path("stopped.json");
    EXPECT_EQ(
        run_until_interrupted(kLabProgram, {"bench", "worst-case", "--time", "15", "--state", state.c_str()}),
        130);
    const auto targets = nlohmann::json::parse(read("stopped.json")).at("targets");
    EXPECT_GT(targets.at("lines").at("starts"), 0);
    EXPECT_EQ(targets.at("lines").at("parameters").size(), 4u);
}

TEST_F(CommandLine, FitGoesOnWhereItStoppedAndWritesTheSameTable) {
    const std::string fit = "fit-ltc --size 4x3x2 --commit abc ";
    const Outcome whole = run_lab(fit + "-o whole --threads 1");
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_NE(whole.out.find("all samples"), std::string::npos) << whole.out;
    EXPECT_EQ(read("whole.bin").size(), 40u + 4 * 3 * 2 * 10);
    EXPECT_EQ(read("whole-engine.bin").size(), 4u * 3 * 12);
    const auto json = nlohmann::json::parse(read("whole.json"));
    EXPECT_EQ(json.at("commit"), "abc");
    EXPECT_EQ(json.at("command"), "nusselt-lab fit-ltc --brdf frostbite-specular --size 4x3x2 -o whole");

    EXPECT_EQ(run_lab(fit + "-o again --threads 3 --checkpoint state").exit_code, 0);
    EXPECT_EQ(read("again.bin"), read("whole.bin"));
    // All columns are in the checkpoint by now.
    EXPECT_EQ(run_lab(fit + "-o resumed --checkpoint state").exit_code, 0);
    EXPECT_EQ(read("resumed.bin"), read("whole.bin"));
    auto resumed = nlohmann::json::parse(read("resumed.json"));
    resumed["command"] = json.at("command");
    EXPECT_EQ(resumed, json);

    for (const char* arguments : {"--size 4x3x3 --checkpoint state", "--checkpoint no/such/folder"}) {
        const Outcome wrong = run_lab(std::string("fit-ltc -o wrong ") + arguments);
        EXPECT_EQ(wrong.exit_code, 1) << arguments;
        expect_lab_message(wrong.err, "error: ");
    }
}

TEST_F(CommandLine, BlueNoiseIsAFunctionOfItsOptions) {
    const auto bytes_for = [&](const char* options) {
        const Outcome outcome = run_lab(std::string("blue-noise -o noise.bin ") + options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        return read("noise.bin");
    };
    const std::string shipped = bytes_for("");
    EXPECT_EQ(shipped.size(), 65536u);
    EXPECT_EQ(bytes_for("--sigma 1.5 --seed 0"), shipped);
    EXPECT_NE(bytes_for("--sigma 1.9"), shipped);
    EXPECT_NE(bytes_for("--seed 1"), shipped);
    const Outcome wrong = run_lab("blue-noise -o no/such/folder/noise.bin");
    EXPECT_EQ(wrong.exit_code, 1);
    expect_lab_message(wrong.err, "error: ");
}

TEST_F(CommandLine, FitFindsOutEarlyThatItCannotWrite) {
    // The whole table would take minutes.
    const Outcome wrong = run_lab("fit-ltc -o no/such/folder/table");
    EXPECT_EQ(wrong.exit_code, 1);
    expect_lab_message(wrong.err, "error: ");
}

TEST_F(CommandLine, CtrlCKeepsFittedColumns) {
    const std::string output = path("table"), state = path("state");
    EXPECT_EQ(run_until_interrupted(kLabProgram, {"fit-ltc", "--size", "64x4x51", "-o", output.c_str(),
                                                  "--checkpoint", state.c_str()}),
              130);
    EXPECT_FALSE(std::filesystem::exists(output + ".bin"));
    const std::string title = "nusselt ltc fit, version 1, frostbite-specular, 64x4x51\n";
    EXPECT_EQ(read("state").rfind(title, 0), 0u);
    EXPECT_GT(std::stoi(read("state").substr(title.size())), 0);
}

TEST_F(CommandLine, ThreadsThatTheSystemDoesNotStartAreAnError) {
    const auto limited =
        run("render '" + kScenes + "/room.pbrt' --resolution 16x12 --quiet --threads 64 -o a.exr",
            "ulimit -v 300000;");
    EXPECT_EQ(limited.exit_code, 1);
    expect_message(limited.err, " of 64 threads; take fewer with --threads");
    EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
}

TEST_F(CommandLine, WithoutAGpuTheBenchmarkSaysInOneLineWhatIsMissing) {
    const auto without_driver =
        run_lab("bench gpu-samplers", "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent");
    EXPECT_EQ(without_driver.exit_code, 1);
    EXPECT_NE(without_driver.err.find("install"), std::string::npos) << without_driver.err;
    EXPECT_EQ(std::count(without_driver.err.begin(), without_driver.err.end(), '\n'), 1)
        << without_driver.err;

    // A loader that is no library, in place of the one of the system.
    for (const char* name : {"libvulkan.so", "libvulkan.so.1"}) std::ofstream(path(name)) << "not a library";
    const auto without_loader = run_lab("bench gpu-samplers", "LD_LIBRARY_PATH=.");
    EXPECT_EQ(without_loader.exit_code, 1);
    EXPECT_NE(without_loader.err.find("install"), std::string::npos) << without_loader.err;
    EXPECT_EQ(std::count(without_loader.err.begin(), without_loader.err.end(), '\n'), 1)
        << without_loader.err;
}

} // namespace

} // namespace nusselt
