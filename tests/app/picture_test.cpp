#include "tests/app/gray_alpha_png.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A BMP of gray pixels, rows from the top.
std::string bmp(int width, int height, const std::vector<int>& gray) {
    std::string bytes = "BM";
    const auto put = [&](std::uint32_t value, int count) {
        for (int n = 0; n < count; ++n) {
            bytes.push_back(static_cast<char>(value >> (8 * n)));
        }
    };
    for (const std::uint32_t word : {0U, 0U, 54U, 40U}) {
        put(word, 4);
    }
    put(static_cast<std::uint32_t>(width), 4);
    put(static_cast<std::uint32_t>(-height), 4);
    put(1 + (32U << 16U), 4);
    for (int n = 0; n < 6; ++n) {
        put(0, 4);
    }
    for (const int level : gray) {
        put(static_cast<std::uint32_t>(level) * 0x010101U, 4);
    }
    return bytes;
}

struct Place {
    double x = 0.0, y = 0.0, z = 0.0;
};

/// Where the tool goes, in a program that names axes where they change.
std::vector<Place> places(const std::string& program) {
    std::vector<Place> found;
    Place at;
    std::istringstream lines(program);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        bool moves = false;
        for (std::string word; line.front() != '(' && words >> word;) {
            const double value = std::strtod(word.c_str() + 1, nullptr);
            double* axis = word[0] == 'X' ? &at.x : word[0] == 'Y' ? &at.y : word[0] == 'Z' ? &at.z : nullptr;
            if (axis != nullptr) {
                *axis = value;
                moves = true;
            }
        }
        if (moves) {
            found.push_back(at);
        }
    }
    return found;
}

// Every pixel is looked at from many places of every move of the program that was written.
TEST(PictureCommand, ReliefOverCutsNoPixelOfItsProgram) {
    const ScratchFolder folder;
    constexpr int side = 12;
    constexpr double pitch = 0.25;
    std::vector<int> gray;
    for (int n = 0; n < side * side; ++n) {
        gray.push_back(n * 7919 % 256);
    }
    write_content(folder / "noise.bmp", bmp(side, side, gray));
    const std::string file = (folder / "noise.ngc").string();
    const Ended ended = run({"picture",
                             "relief",
                             (folder / "noise.bmp").string(),
                             "--width",
                             "3",
                             "--depth",
                             "0.8",
                             "--tool",
                             "ball:1.0",
                             "--depth-per-pass",
                             "0.3",
                             "--out",
                             file});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("12 x 12 pixels of 0.25 mm: 3.00 x 3.00 mm"));
    EXPECT_EQ(run({"gcode", "check", file}).exit_code, 0);
    const std::vector<Place> way = places(content_of(file));
    ASSERT_GT(way.size(), 100U);
    double worst = -1.0;
    for (std::size_t n = 2; n < way.size(); ++n) {
        for (int k = 0; k <= 10; ++k) {
            const double t = 0.1 * k;
            const Place& a = way[n - 1];
            const Place& b = way[n];
            const Place at{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
            for (int pixel = 0; pixel < side * side; ++pixel) {
                const double r = std::hypot(at.x - pixel % side * pitch,
                                            at.y - (side - 1 - pixel / side) * pitch); // NOLINT
                if (r <= 0.5) {
                    const double tool = at.z + 0.5 - std::sqrt(0.25 - r * r);
                    worst = std::max(worst, -0.8 * gray[static_cast<std::size_t>(pixel)] / 255.0 - tool);
                }
            }
        }
    }
    EXPECT_LT(worst, 1e-4);  // the last digit
    EXPECT_GT(worst, -0.01); // and it does touch
}

TEST(PictureCommand, ReliefIsCutOutOfItsPlateWithTabs) {
    const ScratchFolder folder;
    const std::string file = (folder / "frame.ngc").string();
    std::vector<std::string> command = {"picture",
                                        "relief",
                                        "assets/samples/pictures/snail.png",
                                        "--width",
                                        "40",
                                        "--depth",
                                        "1",
                                        "--tool",
                                        "ball:2",
                                        "--step-over",
                                        "1",
                                        "--frame",
                                        "3",
                                        "--tabs",
                                        "3",
                                        "--out",
                                        file};
    const Ended outside = run(command); // the frame is around the picture, which begins at 0, 0
    EXPECT_EQ(outside.exit_code, 1);
    EXPECT_THAT(outside.err, HasSubstr("axis X would have to move to -2.100"));
    EXPECT_THAT(outside.err, HasSubstr("--origin 2.100,2.100"));
    command.insert(command.begin() + 2, {"--origin", "3,3"});
    const Ended ended = run(command);
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out,
                testing::ContainsRegex("points: [0-9]+.[0-9]+ m at feed rate, [0-9]+.[0-9]+ m at rapid"));
    EXPECT_THAT(ended.out, testing::ContainsRegex("lines, [0-9]+:[0-9]+ min on forming table"));
    const std::vector<Place> way = places(content_of(file));
    EXPECT_NEAR(std::ranges::min(way, {}, &Place::z).z, -3.0, 1e-9);
    double left = 480.0; // where the tool cuts
    for (const Place& p : way) {
        left = p.z < 0.0 ? std::min(left, p.x) : left;
    }
    EXPECT_NEAR(left, 3.0 - 0.1 - 1.0 - 1.0, 1e-9);
    const auto on_tabs =
        std::ranges::count_if(way, [](const Place& p) { return std::abs(p.z + 2.0) < 1e-9; });
    EXPECT_GE(on_tabs, 6);
}

TEST(PictureCommand, CutsNoDeeperThanThePlateUnlessItIsAllowed) {
    const ScratchFolder folder;
    const std::string file = (folder / "deep.ngc").string();
    write_content(folder / "pixel.bmp", bmp(1, 1, {255}));
    const auto relief = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {
            "picture", "relief", (folder / "pixel.bmp").string(), "--depth", "3", "--out", file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    };
    const Ended refused = relief({"--plate", "2.5"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_EQ(relief({"--plate", "2.5", "--through"}).exit_code, 0);
    EXPECT_EQ(relief({"--plate", "3"}).exit_code, 0);
}

TEST(PictureCommand, TraceWritesCurvesOrAProgram) {
    const ScratchFolder folder;
    const std::string boat = "assets/samples/pictures/boat.png";
    const std::string svg = (folder / "boat.svg").string();
    const Ended ended = run({"picture", "trace", boat, "--width", "120", "--out", svg});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("14 outlines of"));
    const std::string text = content_of(svg);
    EXPECT_THAT(text, HasSubstr("viewBox=\"0 0 120.0000 81.0000\""));
    EXPECT_EQ(std::ranges::count(text, 'M'), 14);
    EXPECT_EQ(std::ranges::count(text, 'Z'), 14);
    const std::string file = (folder / "boat.ngc").string();
    ASSERT_EQ(run({"picture", "trace", boat, "--width", "120", "--out", file}).exit_code, 0);
    EXPECT_EQ(run({"gcode", "check", file}).exit_code, 0);
    // The sun: a circle of 28 pixels around (340.5, 210), 0.3 mm each.
    int on_the_sun = 0;
    for (const Place& p : places(content_of(file))) {
        on_the_sun += std::abs(std::hypot(p.x - 102.15, p.y - 62.85) - 8.4) < 0.15 ? 1 : 0;
    }
    EXPECT_GT(on_the_sun, 20);
}

TEST(PictureCommand, TheEndingOfItsNameSaysWhatATraceIsWrittenAs) {
    const ScratchFolder folder;
    const std::string boat = "assets/samples/pictures/boat.png";
    const std::string capitals = folder / "B.SVG";
    ASSERT_EQ(run({"picture", "trace", boat, "--out", capitals}).exit_code, 0);
    EXPECT_THAT(content_of(capitals), HasSubstr("<svg"));
    const std::string document = folder / "boat.pdf";
    const Ended refused = run({"picture", "trace", boat, "--out", document});
    EXPECT_NE(refused.exit_code, 0);
    EXPECT_THAT(refused.err, HasSubstr("outlines cannot be written as .pdf"));
    EXPECT_FALSE(std::filesystem::exists(document));
}

TEST(PictureCommand, TraceToSvgLeavesNothingOutWithoutAWord) {
    const ScratchFolder folder;
    const std::string boat = "assets/samples/pictures/boat.png";
    for (const std::vector<std::string>& option :
         {std::vector<std::string>{"--hatch", "2"}, {"--arc-tolerance", "0.1"}, {"--depth", "3"}}) {
        std::vector<std::string> words{"picture", "trace", boat, "--out", folder / "boat.svg"};
        words.insert(words.end(), option.begin(), option.end());
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_THAT(ended.err, HasSubstr(option.front() + " applies only to a program"));
        EXPECT_FALSE(std::filesystem::exists(folder / "boat.svg"));
    }
}

TEST(PictureCommand, HalftoneSaysWhatTheToolIsTooNarrowFor) {
    const ScratchFolder folder;
    const auto engraved = [&](const std::string& tool) {
        return run({"picture",
                    "engrave",
                    "assets/samples/pictures/snail.png",
                    "--width",
                    "40",
                    "--pitch",
                    "2",
                    "--tool",
                    tool,
                    "--out",
                    folder / "dots.ngc"});
    };
    // Holes of 1 mm in squares of 2 mm: pi / 16.
    const Ended narrow = engraved("v:60:1");
    EXPECT_EQ(narrow.exit_code, 0);
    EXPECT_THAT(narrow.err, HasSubstr("areas darker than 20 % look the same"));
    EXPECT_EQ(engraved("v:60:6").err.find("look the same"), std::string::npos);
}

TEST(PictureCommand, EngravesDotsAndShowsThem) {
    const ScratchFolder folder;
    const std::string snail = "assets/samples/pictures/snail.png";
    for (const std::string mode : {"halftone", "dither"}) {
        const std::string file = (folder / (mode + ".ngc")).string();
        const std::string preview = (folder / (mode + ".png")).string();
        const Ended ended = run({"picture",
                                 "engrave",
                                 snail,
                                 "--width",
                                 "40",
                                 "--pitch",
                                 "1",
                                 "--mode",
                                 mode,
                                 "--out",
                                 file,
                                 "--preview",
                                 preview,
                                 "--preview-size",
                                 "200"});
        ASSERT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_EQ(run({"gcode", "check", file}).exit_code, 0);
        EXPECT_TRUE(content_of(preview).starts_with("\x89PNG"));
        EXPECT_GT(places(content_of(file)).size(), 500U);
    }
}

// A plate cut by the tool, as bright as the picture is: the preview is a picture that our reader takes.
TEST(PictureCommand, PreviewAgainstTheLightIsBrightWhereThePictureIs) {
    const ScratchFolder folder;
    std::vector<int> gray(400, 0);
    for (int n = 0; n < 400; ++n) {
        gray[static_cast<std::size_t>(n)] = n % 20 < 10 ? 0 : 255;
    }
    write_content(folder / "halves.bmp", bmp(20, 20, gray));
    const std::string preview = (folder / "light.png").string();
    const Ended ended = run({"picture",
                             "relief",
                             (folder / "halves.bmp").string(),
                             "--width",
                             "20",
                             "--depth",
                             "2",
                             "--tool",
                             "flat:1",
                             "--plate",
                             "2",
                             "--against-light",
                             "--preview-size",
                             "200",
                             "--preview",
                             preview,
                             "--out",
                             (folder / "halves.ngc").string()});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto traced = [&](const std::string& region) {
        return run(
            {"picture", "trace", preview, "--region", region, "--out", (folder / "dark.svg").string()});
    };
    EXPECT_THAT(traced("10,10,80,180").out, HasSubstr("1 outline of")); // all of it is dark
    EXPECT_THAT(traced("110,10,80,180").err, HasSubstr("nothing in it is dark enough"));
}

TEST(PictureCommand, ListsOfNumbersTakeNoFileForANumber) {
    const ScratchFolder folder;
    const std::string picture = "assets/samples/pictures/snail.png";
    const auto relief = [&](const std::string& name, const std::vector<std::string>& words) {
        const std::string out = (folder / name).string();
        std::vector<std::string> command = {"picture", "relief"};
        command.insert(command.end(), words.begin(), words.end());
        command.insert(command.end(), {"--width", "10", "--depth", "1", "--tool", "ball:2", "--out", out});
        const Ended ended = run(command);
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        return content_of(out);
    };
    const std::string before = relief("before.ngc", {"--region", "10,10,40,40", "--origin", "3,3", picture});
    const std::string behind = relief("behind.ngc", {picture, "--origin", "3,3", "--region", "10,10,40,40"});
    EXPECT_THAT(before, HasSubstr("X3.0000"));
    EXPECT_EQ(before, behind);
    const Ended few =
        run({"picture", "relief", "--region", "10,10,40", picture, "--depth", "1", "--out", "o"});
    EXPECT_EQ(few.exit_code, 2);
    EXPECT_THAT(few.err, HasSubstr("--region"));
}

TEST(PictureCommand, SaysWhatIsWrong) {
    const ScratchFolder folder;
    const std::string out = (folder / "out.ngc").string();
    const auto relief = [&](const std::string& name, std::vector<std::string> more) {
        std::vector<std::string> arguments = {"picture", "relief", (folder / name).string(), "--out", out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    };
    write_content(folder / "junk.png", std::string(1000, '\xff'));
    write_content(folder / "pixel.bmp", bmp(1, 1, {255}));
    write_content(folder / "wide.bmp", bmp(2, 1, {255, 0}));
    EXPECT_THAT(relief("junk.png", {"--depth", "1"}).err, HasSubstr("the picture format is not supported"));
    EXPECT_THAT(relief("none.png", {"--depth", "1"}).err, HasSubstr("none.png"));
    EXPECT_THAT(relief("pixel.bmp", {"--depth", "1", "--tool", "drill:3"}).err,
                HasSubstr("'drill:3' is not a tool"));
    for (const auto& [option, value] : {std::pair("--gray-steps", "1"),
                                        std::pair("--gray-steps", "257"),
                                        std::pair("--gray-steps", "-1"),
                                        std::pair("--tool", "ball:0"),
                                        std::pair("--pixel-aspect", "0")}) {
        const Ended refused = relief("pixel.bmp", {"--depth", "1", option, value});
        EXPECT_EQ(refused.exit_code, 2) << option; // as of any value out of its range; it was 1
        EXPECT_THAT(refused.err, HasSubstr(std::string(option) + ": ")) << option;
    }
    EXPECT_THAT(
        relief("pixel.bmp", {"--depth", "1", "--gray-steps", "1"}).err,
        HasSubstr(
            "--gray-steps: 1 gray levels are not possible (use 2 to 256, or 0 for the picture as it is)"));
    EXPECT_THAT(relief("pixel.bmp", {"--depth", "-1"}).err, HasSubstr("--depth: \"-1\" must be above 0"));
    EXPECT_EQ(relief("pixel.bmp", {}).exit_code, 2);
    EXPECT_EQ(relief("pixel.bmp", {"--depth", "1", "--width", "3", "--dpi", "96"}).exit_code, 2);
    EXPECT_THAT(relief("wide.bmp", {"--depth", "1", "--pixel", "1000"}).err, HasSubstr("X"));
    EXPECT_FALSE(std::filesystem::exists(out));
    write_content(folder / "black.bmp", bmp(2, 1, {0, 0}));
    const Ended black = relief("black.bmp", {"--depth", "1"});
    EXPECT_EQ(black.exit_code, 1);
    EXPECT_THAT(black.err, HasSubstr("the relief would cut nothing"));
    EXPECT_THAT(black.err, HasSubstr("use --invert to cut what is dark"));
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_EQ(relief("pixel.bmp", {"--depth", "1"}).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(out));
    EXPECT_THAT(run({"picture", "trace", (folder / "pixel.bmp").string(), "--out", out}).err,
                HasSubstr("nothing in it is dark enough"));
}

TEST(PictureCommand, InvertIsAdvisedWhereItHelpsAlone) {
    const ScratchFolder folder;
    const std::string picture = (folder / "picture.png").string();
    const std::string out = (folder / "out.ngc").string();
    const auto told = [&](const std::string& command, std::vector<std::string> more) {
        std::vector<std::string> words{"picture", command, picture, "--out", out};
        if (command == "relief") {
            words.insert(words.end(), {"--depth", "1"});
        }
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 1) << command;
        return ended.err;
    };
    write_content(picture, gray_alpha_png(12, [](int x, int y) {
                      const bool logo = x > 2 && x < 9 && y > 2 && y < 9;
                      return GrayAlpha{255, static_cast<unsigned char>(logo ? 255 : 0)};
                  }));
    EXPECT_THAT(told("trace", {}), HasSubstr("use --invert to trace what is bright"));
    EXPECT_THAT(told("engrave", {}), HasSubstr("use --invert to engrave what is bright"));
    write_content(picture, gray_alpha_png(12, [](int, int) { return GrayAlpha{0, 0}; }));
    for (const char* command : {"trace", "engrave", "relief"}) {
        for (const auto& more : {std::vector<std::string>{}, std::vector<std::string>{"--invert"}}) {
            const std::string text = told(command, more);
            EXPECT_THAT(text, HasSubstr("whole picture is transparent")) << command;
            EXPECT_THAT(text, Not(HasSubstr("--invert"))) << command;
        }
    }
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(PictureCommand, TraceTellsSpecksFromWhatIsNotDark) {
    const ScratchFolder folder;
    const std::string out = (folder / "out.svg").string();
    const auto traced = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"picture", "trace", (folder / "pixel.bmp").string(), "--out", out};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    write_content(folder / "pixel.bmp", bmp(1, 1, {0}));
    const Ended speck = traced({});
    EXPECT_EQ(speck.exit_code, 1);
    EXPECT_THAT(speck.err, HasSubstr("no dark area has more than 2 pixels"));
    EXPECT_THAT(speck.err, HasSubstr("--speckle 0"));
    EXPECT_THAT(speck.err, Not(HasSubstr("--threshold")));
    EXPECT_THAT(traced({"--speckle", "1"}).err, HasSubstr("more than 1 pixel,"));
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_THAT(traced({"--speckle", "0"}).out, HasSubstr("1 outline of"));
    const Ended bright = traced({"--invert", "--speckle", "0"});
    EXPECT_THAT(bright.err, HasSubstr("nothing in it is dark enough"));
    EXPECT_THAT(bright.err, HasSubstr("all of it is equally bright"));
    EXPECT_THAT(bright.err, Not(HasSubstr("--threshold")));
    EXPECT_THAT(bright.err, HasSubstr("leave out --invert to trace what is dark"));
    write_content(folder / "pixel.bmp", bmp(2, 1, {200, 255}));
    EXPECT_THAT(traced({}).err, HasSubstr("--threshold"));
}

} // namespace
} // namespace millwright::test
