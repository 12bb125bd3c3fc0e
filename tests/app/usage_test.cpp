// Wrong usage, and errors that end a command: exit codes and messages.

#include "program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

namespace nusselt {

namespace {

/// Users of the renderer get no commands of the laboratory, and the other way round.
TEST_F(CommandLine, ProgramsKeepToTheirOwnCommands) {
    for (const char* command : {"bench", "fuzz", "map", "reproduce", "fit-ltc", "blue-noise"}) {
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.exit_code, 2) << command;
        expect_message(outcome.err, std::string("unknown command '") + command + "'");
    }
    for (const char* command : {"render", "view", "merge", "info", "compare", "convert"}) {
        const Outcome outcome = run_lab(std::string(command) + " a b");
        EXPECT_EQ(outcome.exit_code, 2) << command;
        expect_lab_message(outcome.err, std::string("unknown command '") + command + "'");
    }
}

TEST_F(CommandLine, WrongUsageExitsWithTwo) {
    expect_message(run("").err, "a command is missing");
    for (const char* arguments :
         {"", "polish", "render", "render a.pbrt --spp 0", "render a.pbrt --technique magic",
          "render a.pbrt --spp", "render a.pbrt --exposure nan", "compare a.exr",
          "compare a.exr b.exr --max mse", "compare a.exr b.exr --metrics beauty", "convert a.exr",
          "convert a.exr b.png --exposure nan", "render a.pbrt --frobnicate",
          "render a.pbrt --spp 4 --camera-rays 3", "render a.pbrt --resolution 0x9",
          "render a.pbrt --resolution 9x65537"}) {
        const Outcome wrong = run(arguments);
        EXPECT_EQ(wrong.exit_code, 2) << arguments;
        expect_message(wrong.err, "--help");
    }
    for (const char* arguments : {"bench samplers --isa mmx",
                                  "bench instructions --isa mmx",
                                  "reproduce no-such-experiment",
                                  "bench worst-case --target spheres",
                                  "bench worst-case --time 0",
                                  "bench worst-case --time nan",
                                  "bench worst-case --starts -1",
                                  "bench accuracy --count 0",
                                  "bench tubes --repetitions 0",
                                  "bench phong-lines --repetitions 0",
                                  "fuzz --count -1",
                                  "bench shadows --count 0",
                                  "bench shadows --seed -3",
                                  "fuzz --count 18446744073709551616",
                                  "fuzz --seed -3",
                                  "fuzz --count 1.5",
                                  "fuzz --count 1e20",
                                  "bench scale --triangles 0 --emissive 0",
                                  "fit-ltc -o a --brdf velvet",
                                  "fit-ltc -o a --size abc",
                                  "fit-ltc -o a --size 4x3",
                                  "fit-ltc -o a --size 1x2x3",
                                  "fit-ltc -o a --size 4x3x257",
                                  "blue-noise -o a --sigma 0",
                                  "blue-noise -o a --seed -1"}) {
        const Outcome wrong = run_lab(arguments);
        EXPECT_EQ(wrong.exit_code, 2) << arguments;
        expect_lab_message(wrong.err, "--help");
    }
}

TEST_F(CommandLine, WholeNumbersMeanTheSameInAnyNotation) {
    const std::string room = "'" + kScenes + "/room.pbrt'";
    const std::string small = "render " + room + " --resolution 16x9 -q -o a.exr --json - ";
    for (const auto& [text, samples] :
         {std::pair("8", 8), std::pair("08", 8), std::pair("010", 10), std::pair("1e1", 10),
          std::pair("0.8e1", 8), std::pair("1.6E+1", 16)}) {
        const Outcome render = run(small + "--spp " + text);
        ASSERT_EQ(render.exit_code, 0) << render.err;
        EXPECT_EQ(nlohmann::json::parse(render.out)["samples"], samples) << text;
    }
    const Outcome fuzz = run_lab("fuzz --technique LineArea --count 6.4e1 --first 1e3 --json -");
    ASSERT_EQ(fuzz.exit_code, 0) << fuzz.err;
    EXPECT_EQ(nlohmann::json::parse(fuzz.out)["settings"]["count"], 64);
    EXPECT_EQ(nlohmann::json::parse(fuzz.out)["settings"]["first"], 1000);
    for (const char* text :
         {"1.5", "1e-1", "0x10", "+4", "1e", "nan", "inf", "four", "'8 8'", "-1", "0", "1e7"})
        expect_message(run("render a.pbrt --spp " + std::string(text)).err,
                       "' must be a whole number from 1 to 1048576");
    expect_message(run("render a.pbrt --seed -1").err,
                   "--seed: '-1' must be a whole number from 0 to 2^32 - 1");
    expect_message(run("render a.pbrt --lines 1.5").err, "'1.5' must be a whole number from 1 to 65536");
    expect_lab_message(run_lab("bench samplers --repetitions 2.5").err,
                       "'2.5' must be a whole number from 1 to");
    expect_lab_message(run_lab("fuzz --seed -1").err, "'-1' must be a whole number from 0 to 2^64 - 1");
    // Doubles do not have all whole numbers of this size.
    expect_lab_message(run_lab("fuzz --seed 1e17").err, "'1e17' must be a whole number");
}

TEST_F(CommandLine, MessagesHaveNoWordsOfTheParser) {
    for (const auto& [arguments, message] :
         {std::pair("render a.pbrt --spp", "--spp needs a value"),
          std::pair("render a.pbrt --spp 1 --spp 2", "--spp may be given only once"),
          std::pair("compare a.exr", "IMAGES needs at least 2 values"),
          std::pair("render a.pbrt --light-samples lines --integrator lines",
                    "--light-samples is given twice, once by its old name"),
          std::pair("render a.pbrt --brdf gold", "--brdf: 'gold' must be one of material, lambert"),
          std::pair("render a.pbrt --brdf lamber",
                    "--brdf: unknown name 'lamber' (did you mean 'lambert'?)")})
        expect_message(run(arguments).err, message);
    expect_lab_message(run_lab("fit-ltc -o a --brdf foo").err,
                       "--brdf: 'foo' must be one of frostbite-specular");
    expect_lab_message(run_lab("fit-ltc -o a --size abc").err,
                       "--size: 'abc' must be three numbers from 2 to 256");
    expect_lab_message(run_lab("bench scale --triangles 0 --emissive 0").err, "nothing to measure");
}

TEST_F(CommandLine, SuggestsWhatWasMeant) {
    expect_message(run("rendr a.pbrt").err, "unknown command 'rendr' (did you mean 'render'?)");
    expect_message(run("lihgts a.pbrt").err, "unknown command 'lihgts' (did you mean 'lights'?)");
    expect_message(run("polish").err, "unknown command 'polish'; see 'nusselt --help'");
    expect_message(run("render --ssp 3 a.pbrt").err, "unknown option '--ssp' (did you mean '--spp'?)");
    expect_message(run("render a.pbrt --frobnicate").err,
                   "unknown option '--frobnicate'; see 'nusselt render --help'");
    expect_message(run("render a.pbrt b.pbrt").err, "unexpected 'b.pbrt'");
    expect_message(run("info a.pbrt 'b\nc'").err, "unexpected 'b?c'");
    expect_lab_message(run_lab("bench sampler").err, "unknown command 'sampler' (did you mean 'samplers'?)");
    expect_lab_message(run_lab("bench samplers --frobnicate").err, "see 'nusselt-lab bench samplers --help'");
    expect_lab_message(run_lab("fuzz --sed 3").err, "unknown option '--sed' (did you mean '--seed'?)");
}

TEST_F(CommandLine, ListsHaveNoGaps) {
    for (const char* list : {"albedo,,depth", ",albedo", "albedo,"}) {
        const Outcome gap = run("render a.pbrt --layers " + std::string(list));
        EXPECT_EQ(gap.exit_code, 2) << list;
        expect_message(gap.err, "has an empty entry");
    }
    expect_message(run("render a.pbrt --layers=albedo,,depth").err, "--layers: the list 'albedo,,depth'");
    expect_lab_message(run_lab("bench lines a.pbrt --lines 4,,8").err, "--lines: the list '4,,8'");
}

TEST_F(CommandLine, NoArgumentMayBeEmpty) {
    const std::pair<const char*, const char*> cases[] = {
        {"''", "the first argument: it is empty"},
        {"render ''", "the argument after 'render': it is empty"},
        {"render a.pbrt -o ''", "the argument after '-o': it is empty"},
        {"compare a.exr ''", "the argument after 'a.exr': it is empty"},
        {"render a.pbrt --spp ''", "the argument after '--spp': it is empty"},
        {"render a.pbrt --json= --quiet", "--json=: the value is empty"},
        {"render a.pbrt --checkpoint= --pixel-center", "--checkpoint=: the value is empty"}};
    for (const auto& [arguments, message] : cases) {
        const Outcome empty = run(arguments);
        EXPECT_EQ(empty.exit_code, 2) << arguments;
        expect_message(empty.err, message);
    }
}

TEST_F(CommandLine, HelpIsACommandToo) {
    EXPECT_EQ(run("help").out, run("--help").out);
    EXPECT_EQ(run("help render").out, run("render --help").out);
    EXPECT_EQ(run_lab("help bench lines").out, run_lab("bench lines --help").out);
    EXPECT_EQ(run("help render").exit_code, 0);
    expect_message(run("help rendr").err, "help: unknown command 'rendr' (did you mean 'render'?)");
    // Help never runs a command.
    const Outcome more = run("help render '" + kScenes + "/room.pbrt' --resolution 8x8 -o a.exr");
    EXPECT_EQ(more.exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
}

TEST_F(CommandLine, AllMissingFilesAreNamedAtOnce) {
    const std::pair<const char*, const char*> cases[] = {
        {"render a.pbrt --lights b.json --lights c.json --camera d.json",
         "no such files: 'a.pbrt', 'b.json', 'c.json' and 'd.json'"},
        {"info a.pbrt --lights b.json", "no such files: 'a.pbrt' and 'b.json'"},
        {"lights a.pbrt --lights b.json", "no such files: 'a.pbrt' and 'b.json'"},
        {"compare a.exr b.exr", "no such files: 'a.exr' and 'b.exr'"},
        {"merge -o c.exr a.exr b.exr", "no such files: 'a.exr' and 'b.exr'"},
        {"info a.pbrt", "no such file: 'a.pbrt'"}};
    for (const auto& [arguments, message] : cases) {
        const Outcome missing = run(arguments);
        EXPECT_EQ(missing.exit_code, 1) << arguments;
        expect_message(missing.err, message);
    }
}

TEST_F(CommandLine, NamesThatAreTooLongAreToBlame) {
    const std::string name(300, 'x');
    expect_message(run("render " + name + ".pbrt").err, "x.pbrt': not accessible (File name too long)");
    expect_message(run("render '" + kScenes + "/room.pbrt' -o " + name + ".exr").err,
                   "x.exr': File name too long; choose another name");
}

TEST_F(CommandLine, OptionsWithoutEffectAreNotSilent) {
    expect_message(run("render a.pbrt --mis balance --visibility-estimate 0.3").err,
                   "--visibility-estimate: needs --mis clamped_optimal or optimal, not balance");
    expect_message(run("render a.pbrt --strategies diffuse+ggx --visibility-estimate 0.3").err,
                   "--visibility-estimate: needs --mis clamped_optimal or optimal, not balance");
    const std::string render = "render '" + kScenes + "/room.pbrt' --resolution 16x9 --exposure 1 -o a.";
    const std::string warning = "warning: --exposure has no effect, as none of the images is a PNG file";
    EXPECT_NE(run(render + "exr").err.find(warning), std::string::npos);
    EXPECT_EQ(run(render + "png").err.find(warning), std::string::npos);
    EXPECT_EQ(run(render + "exr -o b.PNG").err.find(warning), std::string::npos);
}

TEST_F(CommandLine, ErrorsExitWithOneAndOneLine) {
    const Outcome missing = run("render no-such-scene.pbrt");
    EXPECT_EQ(missing.exit_code, 1);
    expect_message(missing.err, "no-such-scene.pbrt");

    const Outcome controls = run("convert a.exr 'no\nfolder/\x1b[31m.png'");
    EXPECT_EQ(controls.exit_code, 1);
    expect_message(controls.err, "no?folder/?[31m.png");

    const Outcome compared = run("compare missing.exr missing.exr");
    EXPECT_EQ(compared.exit_code, 1);
    expect_message(compared.err, "missing.exr");

    const Outcome isa = run("render '" + kScenes + "/cornell-tube.pbrt'", "NUSSELT_ISA=mmx");
    EXPECT_EQ(isa.exit_code, 1);
    expect_message(isa.err, "mmx");

    const Outcome folder =
        run("render '" + kScenes + "/cornell-tube.pbrt' --resolution 16x16 -q -o no/such/folder/a.exr");
    EXPECT_EQ(folder.exit_code, 1);
    expect_message(folder.err, "no/such/folder");

    // Before the scene is read: otherwise the missing scene would be the error.
    for (const char* output : {"-o no/such/folder/a.exr", "-o a.bmp", "--json no/such/folder/a.json"}) {
        const Outcome early = run(std::string("render no-such-scene.pbrt ") + output);
        EXPECT_EQ(early.exit_code, 1) << output;
        expect_message(early.err, "cannot write");
    }
    for (const char* command : {"bench accuracy", "bench samplers", "bench worst-case", "bench tubes",
                                "bench rays no-such-scene.pbrt", "fuzz", "fit-ltc -o table"}) {
        const Outcome early = run_lab(std::string(command) + " --json no/such/folder/a");
        EXPECT_EQ(early.exit_code, 1) << command;
        expect_lab_message(early.err, "cannot write");
    }
}

TEST_F(CommandLine, LostOutputIsAnError) {
    const std::string lose = " >/dev/full 2>lost.txt #";
    for (const char* command : {"techniques", "--help"}) {
        EXPECT_EQ(run(command + lose).exit_code, 1) << command;
        expect_message(read("lost.txt"), "cannot be written");
    }
    for (const char* command : {"--help", "fuzz --count 1", "bench worst-case --starts 1 --convergence 0"}) {
        EXPECT_EQ(run_lab(command + lose).exit_code, 1) << command;
        expect_lab_message(read("lost.txt"), "cannot be written");
    }
}

TEST_F(CommandLine, LostMessagesCostNothing) {
    std::ofstream(path("a.pbrt")) << "WorldBegin\nShape \"nosuch\"\n";
    for (const char* streams : {">&- 2>&-", "<&- >&- 2>&-", "2>/dev/full"}) {
        EXPECT_EQ(run("render nosuch.pbrt " + std::string(streams) + " #").exit_code, 1) << streams;
        std::filesystem::remove(path("a.pfm"));
        EXPECT_EQ(run("render a.pbrt --resolution 4x4 -q -o a.pfm " + std::string(streams) + " #").exit_code,
                  0)
            << streams;
        // No message is in it.
        EXPECT_EQ(read("a.pfm").size(), std::string("PF\n4 4\n-1.0\n").size() + 4 * 4 * 12) << streams;
    }
}

} // namespace

} // namespace nusselt
