/// The subcommand `nusselt compare`, from the command line to its outputs.

#include "compare.h"

#include "image/difference.h"
#include "image/io.h"
#include "image/metrics.h"
#include "temporary_folder.h"

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

class CompareCommand : public TemporaryFolder {
protected:
    CompareCommand() {
        image_.pixels[3 * 13] = std::numeric_limits<float>::quiet_NaN(); // x 5 y 1
        write_image(a_, image_);
        write_image(b_, reference_);
    }

    Image image_ = random_image(8, 6, 1);
    Image reference_ = random_image(8, 6, 2);
    std::string a_ = in_folder("a with space.exr").string();
    std::string b_ = in_folder("b.exr").string();
};

TEST_F(CompareCommand, PrintsTheMetrics) {
    const Outcome outcome = run_command_line({a_, b_});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.errors, "");
    std::map<std::string, double> numbers;
    std::istringstream lines(outcome.output);
    for (std::string line; std::getline(lines, line);) {
        if (line.size() > 18)
            numbers[line.substr(0, line.find_last_not_of(' ', 17) + 1)] = std::atof(&line[18]);
    }
    const Comparison expected = compare(image_, reference_);
    EXPECT_NEAR(numbers.at("MSE"), expected.mse, 1e-8);
    EXPECT_NEAR(numbers.at("RMSE"), expected.rmse, 1e-8);
    EXPECT_NEAR(numbers.at("RMSE / mean of B"), expected.relative_rmse, 1e-8);
    EXPECT_NEAR(numbers.at("relMSE"), expected.rel_mse, 1e-8 * expected.rel_mse);
    EXPECT_NEAR(numbers.at("mean of A"), expected.mean_a, 1e-8);
    EXPECT_NEAR(numbers.at("mean of B"), expected.mean_b, 1e-8);
    EXPECT_EQ(numbers.at("NaN or inf in A"), 1);
    EXPECT_EQ(numbers.at("NaN or inf in B"), 0);
    EXPECT_NE(outcome.output.find("x 5 y 1: nan"), std::string::npos) << outcome.output;
}

TEST_F(CompareCommand, JsonOnTheStandardOutputReplacesTheText) {
    const Outcome outcome = run_command_line({a_, b_, "--json", "-"});
    EXPECT_EQ(outcome.exit_code, 0);
    const auto json = nlohmann::json::parse(outcome.output);
    const Comparison expected = compare(image_, reference_);
    EXPECT_EQ(json.at("mse"), expected.mse);
    EXPECT_EQ(json.at("rmse"), expected.rmse);
    EXPECT_EQ(json.at("relative_rmse"), expected.relative_rmse);
    EXPECT_EQ(json.at("rel_mse"), expected.rel_mse);
    EXPECT_EQ(json.at("mean_image"), expected.mean_a);
    EXPECT_EQ(json.at("mean_reference"), expected.mean_b);
    EXPECT_EQ(json.at("compared_pixels"), 47);
    EXPECT_EQ(json.at("width"), 8);
    EXPECT_EQ(json.at("height"), 6);
    EXPECT_EQ(json.at("invalid_image").at("count"), 1);
    EXPECT_EQ(json.at("invalid_image").at("first").at(0).at("x"), 5);
    EXPECT_EQ(json.at("invalid_image").at("first").at(0).at("y"), 1);
    EXPECT_EQ(json.at("invalid_image").at("first").at(0).at("rgb").at(0), "nan");
    EXPECT_EQ(json.at("invalid_reference").at("count"), 0);
}

TEST_F(CompareCommand, WritesJsonAndDifferenceToFiles) {
    const std::string json_path = in_folder("c.json").string();
    const std::string difference_path = in_folder("d.exr").string();
    const Outcome outcome = run_command_line({a_, b_, "--json", json_path, "--diff", difference_path});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(nlohmann::json::parse(read_bytes(json_path)).at("mse"), compare(image_, reference_).mse);
    EXPECT_NE(outcome.output.find("relMSE"), std::string::npos);
    const double scale = difference_scale(image_, reference_);
    EXPECT_EQ(read_image(difference_path).pixels, signed_difference_image(image_, reference_, scale).pixels);

    EXPECT_EQ(run_command_line({a_, b_, "--diff", difference_path, "--diff-scale", "0.5"}).exit_code, 0);
    EXPECT_EQ(read_image(difference_path).pixels, signed_difference_image(image_, reference_, 0.5).pixels);
}

TEST_F(CompareCommand, ErrorsAreOneLineAndExitCodeOne) {
    const std::string other_size = in_folder("c.exr").string();
    write_image(other_size, random_image(5, 4, 1));
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{a_, other_size}, "8 x 6"},
        {{a_, other_size}, "5 x 4"},
        {{a_, in_folder("missing.exr").string()}, "missing.exr"},
        {{a_, b_, "--diff", in_folder("d.bmp").string()}, "d.bmp"},
        {{a_, b_, "--json", in_folder("missing/d.json").string()}, "missing/d.json"},
    };
    for (const auto& [arguments, expected] : cases) {
        const Outcome outcome = run_command_line(arguments);
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_NE(outcome.errors.find(expected), std::string::npos) << outcome.errors;
        EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    }
}

TEST_F(CompareCommand, WrongUsageIsAParseError) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{},
                                               {a_},
                                               {a_, b_, "--diff-scale", "1"},
                                               {a_, b_, "--diff", "d.png", "--diff-scale", "0"},
                                               {a_, b_, "--unknown"}})
        EXPECT_THROW(run_command_line(arguments), CLI::ParseError);
}

TEST(CompareHelp, SaysDefaultsAndRanges) {
    CLI::App app;
    int exit_code = 0;
    app::setup_compare(app, exit_code);
    const std::string help = app.get_subcommand("compare")->help();
    for (const std::string option : {"A ", "B ", "--diff", "--diff-scale", "--json"})
        EXPECT_NE(help.find(option), std::string::npos) << option;
    for (const CLI::Option* option : app.get_subcommand("compare")->get_options()) {
        if (option->get_items_expected_max() == 0 || option->get_required()) continue;
        EXPECT_NE(option->get_description().find("Default: "), std::string::npos) << option->get_name();
    }
}

} // namespace

} // namespace nusselt::image::test
