/// The subcommand `nusselt compare`, from the command line to its outputs.

#include "apps/nusselt/image/compare.h"

#include "image/difference.h"
#include "image/flip.h"
#include "image/io.h"
#include "image/metrics.h"
#include "image/ssim.h"
#include "image_fixture.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <sstream>

namespace nusselt::image::test {

namespace {

struct Outcome {
    int exit_code = 0;
    std::string output;
    std::string errors;
};

/// \throws CLI::ParseError  for a wrong command line
Outcome run_command_line(std::vector<std::string> arguments) {
    CLI::App app;
    Outcome outcome;
    outcome.exit_code = -1; // must be overwritten by the callback
    app::setup_compare(app, outcome.exit_code);
    arguments.insert(arguments.begin(), "compare");
    std::reverse(arguments.begin(), arguments.end()); // CLI11 takes vectors from the back
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    try {
        app.parse(std::move(arguments));
    } catch (...) {
        testing::internal::GetCapturedStdout();
        testing::internal::GetCapturedStderr();
        throw;
    }
    outcome.output = testing::internal::GetCapturedStdout();
    outcome.errors = testing::internal::GetCapturedStderr();
    return outcome;
}

class CompareCommand : public ImageTest {
protected:
    CompareCommand() {
        image_.pixels[3 * 18] = std::numeric_limits<float>::quiet_NaN(); // x 5 y 1
        write_image(a_, image_);
        write_image(b_, reference_);
    }

    Image image_ = random_image(13, 12, 1);
    Image reference_ = random_image(13, 12, 2);
    std::string a_ = in_folder("a with space.exr").string();
    std::string b_ = in_folder("b.exr").string();
};

/// The numbers behind the labels of a list.
std::map<std::string, double> listed_numbers(const std::string& output) {
    std::map<std::string, double> numbers;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        if (line.size() > 19)
            numbers[line.substr(0, line.find_last_not_of(' ', 18) + 1)] = std::atof(&line[19]);
    }
    return numbers;
}

TEST_F(CompareCommand, PrintsTheMetrics) {
    const Outcome outcome = run_command_line({a_, b_});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.errors, "");
    const auto numbers = listed_numbers(outcome.output);
    const Comparison expected = compare(image_, reference_);
    EXPECT_NEAR(numbers.at("mse"), expected.mse, 1e-8);
    EXPECT_NEAR(numbers.at("rmse"), expected.rmse, 1e-8);
    EXPECT_NEAR(numbers.at("relative_rmse"), expected.relative_rmse, 1e-8);
    EXPECT_NEAR(numbers.at("mae"), expected.mae, 1e-8);
    EXPECT_NEAR(numbers.at("rel_mse"), expected.rel_mse, 1e-8 * expected.rel_mse);
    EXPECT_NEAR(numbers.at("mrse"), expected.mrse, 1e-8 * expected.mrse);
    EXPECT_NEAR(numbers.at("psnr"), psnr(image_, reference_), 1e-7);
    EXPECT_NEAR(numbers.at("ssim"), ssim(image_, reference_), 1e-8);
    EXPECT_NEAR(numbers.at("mean"), expected.mean_a, 1e-8);
    EXPECT_NEAR(numbers.at("mean of reference"), expected.mean_b, 1e-8);
    EXPECT_EQ(numbers.at("invalid"), 1);
    EXPECT_EQ(numbers.count("flip"), 0u) << "only on request";
    EXPECT_NE(outcome.output.find("x 5 y 1: nan"), std::string::npos) << outcome.output;
}

TEST_F(CompareCommand, MetricsCanBeChosen) {
    const Outcome some = run_command_line({a_, b_, "--metrics", "hdr_flip,mae"});
    const auto numbers = listed_numbers(some.output);
    EXPECT_EQ(numbers.count("mse"), 0u);
    EXPECT_NEAR(numbers.at("hdr_flip"),
                mean_of_valid(hdr_flip(image_, reference_, flip_exposures(reference_)), image_, reference_),
                1e-8);
    EXPECT_NEAR(numbers.at("mae"), compare(image_, reference_).mae, 1e-8);
    const auto all = listed_numbers(
        run_command_line({a_, b_, "--metrics", "all", "--exposure", "-2", "--ppd", "30"}).output);
    EXPECT_NEAR(all.at("flip"), mean_of_valid(flip(image_, reference_, 30, -2), image_, reference_), 1e-8);
    EXPECT_NEAR(all.at("ssim"), ssim(image_, reference_, -2), 1e-8);
    EXPECT_NEAR(all.at("psnr"), psnr(image_, reference_, -2), 1e-7);
}

TEST_F(CompareCommand, JsonOnTheStandardOutputReplacesTheText) {
    const Outcome outcome = run_command_line({a_, b_, "--json", "-", "--metrics", "all"});
    EXPECT_EQ(outcome.exit_code, 0);
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json.at("reference"), b_);
    EXPECT_EQ(json.at("width"), 13);
    EXPECT_EQ(json.at("height"), 12);
    EXPECT_EQ(json.at("invalid_reference").at("count"), 0);
    ASSERT_EQ(json.at("images").size(), 1u);
    const auto entry = json.at("images").at(0);
    const Comparison expected = compare(image_, reference_);
    EXPECT_EQ(entry.at("image"), a_);
    EXPECT_EQ(entry.at("mse"), expected.mse);
    EXPECT_EQ(entry.at("rmse"), expected.rmse);
    EXPECT_EQ(entry.at("relative_rmse"), expected.relative_rmse);
    EXPECT_EQ(entry.at("mae"), expected.mae);
    EXPECT_EQ(entry.at("rel_mse"), expected.rel_mse);
    EXPECT_EQ(entry.at("mrse"), expected.mrse);
    EXPECT_EQ(entry.at("psnr"), psnr(image_, reference_));
    EXPECT_EQ(entry.at("ssim"), ssim(image_, reference_));
    EXPECT_EQ(entry.at("flip"), mean_of_valid(flip(image_, reference_), image_, reference_));
    EXPECT_GT(entry.at("hdr_flip"), 0.0);
    EXPECT_EQ(entry.at("invalid"), 1);
    EXPECT_EQ(entry.at("mean_image"), expected.mean_a);
    EXPECT_EQ(entry.at("mean_reference"), expected.mean_b);
    EXPECT_EQ(entry.at("compared_pixels"), 13 * 12 - 1);
    EXPECT_EQ(entry.at("invalid_image").at("count"), 1);
    EXPECT_EQ(entry.at("invalid_image").at("first").at(0).at("x"), 5);
    EXPECT_EQ(entry.at("invalid_image").at("first").at(0).at("y"), 1);
    EXPECT_EQ(entry.at("invalid_image").at("first").at(0).at("rgb").at(0), "nan");
    EXPECT_TRUE(json.at("broken_limits").empty());
}

TEST_F(CompareCommand, SeveralImagesBecomeATable) {
    const Outcome table = run_command_line({a_, b_, b_, "--metrics", "mse,invalid"});
    EXPECT_EQ(table.exit_code, 0);
    std::istringstream lines(table.output);
    std::string header, first, second;
    std::getline(lines, header);
    std::getline(lines, first);
    std::getline(lines, second);
    EXPECT_EQ(header.size(), first.size()) << table.output;
    EXPECT_EQ(header.size(), second.size());
    EXPECT_EQ(first.substr(0, a_.size()), a_);
    EXPECT_NEAR(std::atof(first.substr(a_.size()).c_str()), compare(image_, reference_).mse, 1e-8);
    EXPECT_EQ(std::atof(second.substr(a_.size()).c_str()), 0);
    EXPECT_NE(table.output.find("x 5 y 1: nan"), std::string::npos) << table.output;

    const auto json = nlohmann::json::parse(run_command_line({a_, b_, b_, "--json", "-"}).output);
    EXPECT_EQ(json.at("images").size(), 2u);
    EXPECT_EQ(json.at("images").at(1).at("mse"), 0.0);
    EXPECT_EQ(json.at("images").at(1).at("psnr"), "inf");
}

TEST_F(CompareCommand, BlackImagesHaveNumbersAndEmptyOnesNone) {
    write_image(in_folder("black.exr"), make_image(4, 4));
    const std::string black = in_folder("black.exr").string();
    const Outcome same = run_command_line({black, black});
    EXPECT_EQ(same.output.find("nan"), std::string::npos) << same.output;
    EXPECT_EQ(listed_numbers(same.output).at("relative_rmse"), 0);
    EXPECT_NE(same.output.find("ssim               undefined"), std::string::npos) << "below 11 pixels";
}

TEST_F(CompareCommand, BrokenLimitsExitWithThree) {
    const double mse = compare(image_, reference_).mse;
    const auto limit = [](const std::string& metric, double value) {
        return metric + "=" + std::to_string(value);
    };
    const Outcome kept = run_command_line(
        {"--max", limit("mse", 1.001 * mse), a_, "--min", "psnr=0.5", b_, "--max", "invalid=1"});
    EXPECT_EQ(kept.exit_code, 0) << kept.errors;
    EXPECT_EQ(kept.errors, "");

    const Outcome broken = run_command_line({a_, b_, "--max", limit("mse", 0.999 * mse), "--min",
                                             "ssim=0.999", "--metrics", "mae", "--json", "-"});
    EXPECT_EQ(broken.exit_code, 3);
    EXPECT_EQ(std::count(broken.errors.begin(), broken.errors.end(), '\n'), 2) << broken.errors;
    EXPECT_NE(broken.errors.find("a with space.exr': mse is "), std::string::npos) << broken.errors;
    EXPECT_NE(broken.errors.find(", below the limit of 0.999"), std::string::npos) << broken.errors;
    const auto json = nlohmann::json::parse(broken.output);
    ASSERT_EQ(json.at("broken_limits").size(), 2u);
    EXPECT_EQ(json.at("broken_limits").at(0).at("metric"), "mse");
    EXPECT_EQ(json.at("broken_limits").at(0).at("value"), mse);
    EXPECT_EQ(json.at("broken_limits").at(1).at("limit"), 0.999);

    // With several images, only those that break the limit are listed.
    const Outcome second = run_command_line({b_, a_, b_, "--max", "mse=0"});
    EXPECT_EQ(second.exit_code, 3);
    EXPECT_EQ(std::count(second.errors.begin(), second.errors.end(), '\n'), 1) << second.errors;

    // Without a valid pixel, metrics are undefined and all limits are broken.
    Image invalid = make_image(13, 12);
    for (float& value : invalid.pixels) value = std::numeric_limits<float>::quiet_NaN();
    write_image(in_folder("n.exr"), invalid);
    EXPECT_EQ(run_command_line({in_folder("n.exr").string(), b_, "--max", "mse=1e30"}).exit_code, 3);
    EXPECT_EQ(run_command_line({in_folder("n.exr").string(), b_, "--min", "psnr=-1000"}).exit_code, 3);
}

TEST_F(CompareCommand, WritesJsonAndDifferenceToFiles) {
    const std::string json_path = in_folder("c.json").string();
    const std::string difference_path = in_folder("d.exr").string();
    const std::string absolute_path = in_folder("e.exr").string();
    const Outcome outcome = run_command_line(
        {a_, b_, "--json", json_path, "--diff", difference_path, "--abs-diff", absolute_path});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(nlohmann::json::parse(read_bytes(json_path)).at("images").at(0).at("mse"),
              compare(image_, reference_).mse);
    EXPECT_NE(outcome.output.find("rel_mse"), std::string::npos);
    const double scale = difference_scale(image_, reference_);
    EXPECT_EQ(read_image(difference_path).pixels, signed_difference_image(image_, reference_, scale).pixels);
    EXPECT_EQ(read_image(absolute_path).pixels, absolute_difference_image(image_, reference_, scale).pixels);

    EXPECT_EQ(run_command_line({a_, b_, "--diff", difference_path, "--diff-scale", "0.5"}).exit_code, 0);
    EXPECT_EQ(read_image(difference_path).pixels, signed_difference_image(image_, reference_, 0.5).pixels);
}

TEST_F(CompareCommand, WritesMapsOfFlip) {
    const std::string map = in_folder("f.exr").string();
    const std::string hdr_map = in_folder("h.exr").string();
    EXPECT_EQ(run_command_line({a_, b_, "--metrics", "mse", "--flip-map", map, "--hdr-flip-map", hdr_map})
                  .exit_code,
              0);
    EXPECT_EQ(read_image(map).pixels, error_map_image(flip(image_, reference_)).pixels);
    EXPECT_EQ(read_image(hdr_map).pixels,
              error_map_image(hdr_flip(image_, reference_, flip_exposures(reference_))).pixels);
}

TEST_F(CompareCommand, ErrorsAreThrownWithTheFile) {
    const std::string other_size = in_folder("c.exr").string();
    write_image(other_size, random_image(5, 4, 1));
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{a_, other_size}, "a with space.exr' has 13 x 12"},
        {{a_, other_size}, "c.exr' 5 x 4"},
        {{b_, other_size, b_}, "c.exr' has 5 x 4"},
        {{a_, in_folder("missing.exr").string()}, "missing.exr"},
        {{a_, b_, "--diff", in_folder("d.bmp").string()}, "d.bmp"},
        {{a_, in_folder("missing.exr").string(), "--flip-map", in_folder("d.bmp").string()}, "d.bmp"},
        {{a_, b_, "--json", in_folder("missing/d.json").string()}, "missing/d.json"},
    };
    for (const auto& [arguments, expected] : cases) {
        const std::string error =
            error_of([&command_line = arguments] { (void)run_command_line(command_line); });
        EXPECT_NE(error.find(expected), std::string::npos) << error;
    }
}

TEST_F(CompareCommand, WrongUsageIsAParseError) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{},
                                               {a_},
                                               {a_, b_, "--diff-scale", "1"},
                                               {a_, b_, "--diff", "d.png", "--diff-scale", "0"},
                                               {a_, b_, "--diff", "d.png", "--diff-scale", "inf"},
                                               {a_, b_, b_, "--diff", "d.png"},
                                               {a_, b_, "--metrics", "mse,beauty"},
                                               {a_, b_, "--metrics", "mse,,mae"},
                                               {a_, b_, "--metrics", ""},
                                               {a_, b_, "--max", "mse"},
                                               {a_, b_, "--max", "beauty=1"},
                                               {a_, b_, "--max", "mse=many"},
                                               {a_, b_, "--min", "psnr=nan"},
                                               {a_, b_, "--exposure", "nan"},
                                               {a_, b_, "--exposure", "65"},
                                               {a_, b_, "--ppd", "0"},
                                               {a_, b_, "--ppd", "nan"},
                                               {a_, b_, "--ppd", "1001"},
                                               {a_, b_, "--unknown"}})
        EXPECT_THROW(run_command_line(arguments), CLI::ParseError)
            << (arguments.empty() ? "" : arguments.back());
}

TEST(CompareHelp, NamesWhatItTakes) {
    CLI::App app;
    int exit_code = 0;
    app::setup_compare(app, exit_code);
    const std::string help = app.get_subcommand("compare")->help();
    for (const std::string option :
         {"REFERENCE", "--diff", "--diff-scale", "--json", "--max", "--metrics", "hdr_flip"})
        EXPECT_NE(help.find(option), std::string::npos) << option;
}

} // namespace

} // namespace nusselt::image::test
