/// The subcommand `nusselt convert`, from the command line to its outputs.

#include "apps/nusselt/image/convert.h"

#include "image/io.h"
#include "image/layers.h"
#include "image/srgb.h"
#include "image_fixture.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nusselt::image::test {

namespace {

class ConvertCommand : public ImageTest {
protected:
    ConvertCommand() {
        LayeredImage file{{3, 4, 12, 9}, {0, 0, 64, 48}, {}, {{"spp", "16"}}, {{"owner", "somebody"}}};
        file.layers = {color_layer(image_),
                       {"depth", {"Z"}, std::vector<float>(12 * 9, 0.5f)},
                       {"light.lamp", {"R", "G", "B"}, random_image(12, 9, 2).pixels},
                       {"uv", {"u", "v"}, std::vector<float>(12 * 9 * 2)}};
        write_layers(in_folder("in.exr"), file);
    }

    /// Names of files are relative to the folder. \returns what was printed
    std::string convert(std::vector<std::string> arguments) const {
        for (std::string& argument : arguments)
            if (argument.find('.') != std::string::npos && argument.find("light") != 0)
                argument = in_folder(argument);
        CLI::App app;
        int exit_code = -1;
        app::setup_convert(app, exit_code);
        arguments.insert(arguments.begin(), "convert");
        std::reverse(arguments.begin(), arguments.end()); // CLI11 takes vectors from the back
        testing::internal::CaptureStdout();
        try {
            app.parse(std::move(arguments));
        } catch (...) {
            testing::internal::GetCapturedStdout();
            throw;
        }
        EXPECT_EQ(exit_code, 0);
        return testing::internal::GetCapturedStdout();
    }

    std::vector<float> pixels(const std::string& name) const { return read_image(in_folder(name)).pixels; }

    Image image_ = random_image(12, 9, 1);
};

TEST_F(ConvertCommand, FloatsSurviveAndOthersAreRounded) {
    convert({"in.exr", "a.pfm"});
    convert({"a.pfm", "b.exr"});
    EXPECT_EQ(pixels("b.exr"), image_.pixels);
    convert({"b.exr", "c.hdr"});
    convert({"b.exr", "d.png"});
    convert({"d.png", "e.exr"});
    for (std::size_t i = 0; i < image_.pixels.size(); ++i) {
        EXPECT_NEAR(pixels("c.hdr")[i], image_.pixels[i], 0.01 * 8);
        EXPECT_NEAR(srgb_from_linear(pixels("e.exr")[i]), display_code(image_.pixels[i]), 0.5 / 255 + 1e-6);
    }
}

TEST_F(ConvertCommand, ExposureMultipliesInEveryFormat) {
    convert({"in.exr", "a.pfm", "--exposure", "-1"});
    convert({"in.exr", "b.exr", "--exposure", "2"});
    convert({"in.exr", "c.png", "--exposure", "-3"});
    for (std::size_t i = 0; i < image_.pixels.size(); ++i) {
        ASSERT_EQ(pixels("a.pfm")[i], 0.5f * image_.pixels[i]);
        ASSERT_EQ(pixels("b.exr")[i], 4 * image_.pixels[i]);
        ASSERT_NEAR(srgb_from_linear(pixels("c.png")[i]), display_code(image_.pixels[i] / 8),
                    0.5 / 255 + 1e-6);
    }
}

TEST_F(ConvertCommand, ValuesThatBecomeInfiniteCauseAWarning) {
    Image image = make_image(2, 1);
    image.pixels = {1e30f, -1e30f, 1, 1e10f, 0, std::numeric_limits<float>::infinity()};
    write_image(in_folder("large.pfm"), image);
    testing::internal::CaptureStderr();
    convert({"large.pfm", "b.exr", "--exposure", "60"});
    EXPECT_EQ(testing::internal::GetCapturedStderr().find(
                  "warning: --exposure 60 makes 2 of 6 values larger than a float can be"),
              0u);
    EXPECT_TRUE(std::isinf(pixels("b.exr")[1]));
    testing::internal::CaptureStderr();
    convert({"large.pfm", "b.exr", "--exposure", "1"});
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ConvertCommand, ExrKeepsMetadataAndPlaceOnTheFilm) {
    convert({"in.exr", "a.exr"});
    const LayeredImage file = read_layers(in_folder("a.exr"));
    EXPECT_EQ(file.metadata, (Metadata{{"converted", "yes"}, {"spp", "16"}}));
    EXPECT_EQ(file.foreign_metadata, (Metadata{{"owner", "somebody"}}));
    EXPECT_EQ(file.data, (Window{3, 4, 12, 9}));
    EXPECT_EQ(file.display, (Window{0, 0, 64, 48}));
    ASSERT_EQ(file.layers.size(), 1u);
    EXPECT_EQ(file.layers[0].data, image_.pixels);
}

TEST_F(ConvertCommand, LayersAreListedAndExtracted) {
    EXPECT_EQ(convert({"in.exr", "--list-layers"}), "(picture)                R G B\n"
                                                    "depth                    Z\n"
                                                    "light.lamp               R G B\n"
                                                    "uv                       u v\n");
    convert({"in.exr", "a.pfm", "--layer", "depth"});
    EXPECT_EQ(pixels("a.pfm"), std::vector<float>(12 * 9 * 3, 0.5f));
    convert({"in.exr", "b.exr", "--layer", "light.lamp"});
    EXPECT_EQ(pixels("b.exr"), random_image(12, 9, 2).pixels);
    EXPECT_EQ(read_layers(in_folder("b.exr")).metadata.at("spp"), "16");
}

TEST_F(ConvertCommand, ErrorsSayWhatToDo) {
    const auto error = [&](const std::vector<std::string>& arguments) {
        return error_of([&] { convert(arguments); });
    };
    convert({"in.exr", "in.png"});
    EXPECT_NE(error({"in.exr", "a.pfm", "--layer", "albedo"}).find("--list-layers"), std::string::npos);
    EXPECT_NE(error({"in.exr", "a.pfm", "--layer", "uv"}).find("2 channels"), std::string::npos);
    EXPECT_NE(error({"in.png", "a.pfm", "--layer", "depth"}).find("only EXR"), std::string::npos);
    EXPECT_NE(error({"in.png", "--list-layers"}).find("only EXR"), std::string::npos);
    EXPECT_NE(error({"missing.exr", "a.pfm"}).find("missing.exr"), std::string::npos);
    EXPECT_NE(error({"missing.exr", "a.bmp"}).find("a.bmp"), std::string::npos) << "noticed first";
    EXPECT_EQ(file_names(), (std::set<std::string>{"in.exr", "in.png"}));
}

TEST_F(ConvertCommand, WrongUsageIsAParseError) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{},
                                               {"in.exr"},
                                               {"in.exr", "a.png", "--exposure", "nan"},
                                               {"in.exr", "a.png", "--exposure", "inf"},
                                               {"in.exr", "a.png", "--exposure", "65"},
                                               {"in.exr", "a.png", "--exposure", "1x"},
                                               {"in.exr", "a.png", "b.png"},
                                               {"in.exr", "a.png", "--layer", ""},
                                               {"in.exr", "a.png", "--list-layers"},
                                               {"in.exr", "--list-layers", "--layer", "depth"}})
        EXPECT_THROW(convert(arguments), CLI::ParseError);
}

} // namespace

} // namespace nusselt::image::test
