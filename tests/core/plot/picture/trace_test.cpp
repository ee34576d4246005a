// Outlines are compared with what the potrace program finds, and with what is known of figures.
#include "core/plot/picture/trace.h"

#include "core/base/files.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/plot_strokes/region.h"
#include "tests/support/oracle.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>

namespace millwright::plot {
namespace {

using testing::HasSubstr;

/// Dark where `dark(x, y)`, y up from the lower edge, at the middles of pixels.
Picture drawn(int width, int height, const std::function<bool(double x, double y)>& dark) {
    Picture picture{width, height, {}, {}};
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            picture.gray.push_back(dark(column + 0.5, height - row - 0.5) ? 0 : white);
        }
    }
    return picture;
}

Picture ring() {
    return drawn(120, 100, [](double x, double y) {
        const double r = std::hypot(x - 60.0, y - 50.0);
        return r < 40.0 && r > 20.0;
    });
}

/// Blots of any form.
Picture blots(int width, int height, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> phase(0.0, 2.0 * pi);
    const double a = phase(random);
    const double b = phase(random);
    const double c = phase(random);
    return drawn(width, height, [=](double x, double y) {
        return std::sin(0.11 * x + a) + std::sin(0.13 * y + b) + std::sin(0.05 * (x - 2.0 * y) + c) > 0.7;
    });
}

double area(const Ring& ring) {
    double twice = 0.0;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const Vec2& a = ring[n];
        const Vec2& b = ring[(n + 1) % ring.size()];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return twice / 2.0;
}

TEST(Trace, FindsACircleAndItsHole) {
    const auto paths = trace(ring());
    ASSERT_EQ(paths.size(), 2U);
    EXPECT_FALSE(paths[0].hole);
    EXPECT_TRUE(paths[1].hole);
    const Strokes strokes = strokes_of(paths, 0.5, 0.001);
    const double radii[] = {20.0, 10.0}; // mm
    for (std::size_t n = 0; n < 2; ++n) {
        EXPECT_EQ(strokes[n].points.front(), strokes[n].points.back());
        EXPECT_NEAR(std::abs(area(strokes[n].points)), pi * square(radii[n]), 0.02 * pi * square(radii[n]));
        for (const Vec2& point : strokes[n].points) {
            EXPECT_NEAR((point - Vec2(30.0, 25.0)).norm(), radii[n], 0.25); // half a pixel
        }
    }
}

TEST(Trace, LeavesOutSpeckles) {
    const Picture picture = drawn(40, 40, [](double x, double y) {
        return (x > 10.0 && x < 12.0 && y > 10.0 && y < 12.0) ||
               (x > 20.0 && x < 30.0 && y > 20.0 && y < 30.0);
    });
    EXPECT_EQ(trace(picture, {.speckle = 3}).size(), 2U);
    EXPECT_EQ(trace(picture, {.speckle = 4}).size(), 1U);
}

TEST(Trace, KeepsCornersOrRoundsThem) {
    const Picture picture =
        drawn(40, 40, [](double x, double y) { return x > 10.0 && x < 30.0 && y > 10.0 && y < 30.0; });
    const auto straight = [&](double corner) {
        int count = 0;
        const auto traced = trace(picture, {.corner = corner});
        for (const TracedCurve& curve : traced.at(0).curves) {
            count += curve.straight ? 1 : 0;
        }
        return count;
    };
    EXPECT_EQ(straight(1.0), 8); // both sides of four corners
    EXPECT_EQ(straight(1.334), 0);
}

TEST(Trace, JoinsCurvesWithinTheTolerance) {
    const auto count = [](double tolerance) {
        return trace(ring(), {.tolerance = tolerance}).at(0).curves.size();
    };
    EXPECT_LT(count(1.0), count(0.2));
    EXPECT_LT(count(0.2), count(0.0));
}

TEST(Trace, ChordsKeepWithinTheirTolerance) {
    const auto paths = trace(blots(150, 120, 3));
    for (const double tolerance : {0.05, 0.002}) {
        const Strokes coarse = strokes_of(paths, 0.3, tolerance);
        const Strokes fine = strokes_of(paths, 0.3, 1e-5);
        for (std::size_t n = 0; n < fine.size(); ++n) {
            for (const Vec2& point : fine[n].points) {
                double nearest = 1e9;
                for (std::size_t k = 1; k < coarse[n].points.size(); ++k) {
                    const Vec2& a = coarse[n].points[k - 1];
                    const Vec2 way = coarse[n].points[k] - a;
                    const double t =
                        std::clamp((point - a).dot(way) / std::max(way.squaredNorm(), 1e-30), 0.0, 1.0);
                    nearest = std::min(nearest, (a + t * way - point).norm());
                }
                ASSERT_LE(nearest, tolerance * 1.001);
            }
        }
    }
}

TEST(Trace, OfNothingIsEmpty) {
    EXPECT_TRUE(trace(drawn(10, 10, [](double, double) { return false; })).empty());
    EXPECT_EQ(trace(drawn(1, 1, [](double, double) { return true; }), {.speckle = 0}).size(), 1U);
}

TEST(Trace, NamesTheSettingThatIsWrong) {
    const millwright::test::WithoutTraps no_traps;
    const Picture picture = ring();
    const auto error_of = [&](const TraceSettings& settings) -> std::string {
        try {
            static_cast<void>(trace(picture, settings));
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    };
    EXPECT_THAT(error_of({.threshold = 1.5}), HasSubstr("the threshold is 1.5"));
    EXPECT_THAT(error_of({.speckle = -1}), HasSubstr("the speckle size is -1"));
    EXPECT_THAT(error_of({.corner = std::nan("")}), HasSubstr("the corner smoothing is nan"));
    EXPECT_THAT(error_of({.tolerance = -0.1}), HasSubstr("the tolerance is -0.1"));
    EXPECT_THROW(static_cast<void>(strokes_of(trace(picture), 0.0, 0.1)), Error);
}

/// The curves of an SVG as the potrace program writes them: relative, in whole units of 1/1000 pixel, y up.
class SvgReader {
public:
    explicit SvgReader(const std::string& svg) {
        for (std::size_t at = 0; (at = svg.find(" d=\"", at)) != std::string::npos; ++at) {
            const std::size_t begin = at + 4;
            read(svg.substr(begin, svg.find('"', begin) - begin));
        }
    }

    std::vector<std::vector<Vec2>> paths; ///< start and all control points

private:
    void read(const std::string& text) {
        const char* at = text.c_str();
        char command = 'z';
        while (*at != '\0') {
            if (std::isspace(static_cast<unsigned char>(*at)) != 0) {
                ++at;
            } else if (std::isalpha(static_cast<unsigned char>(*at)) != 0) {
                command = *at++;
            } else {
                at = numbers(at, command);
            }
        }
    }

    const char* numbers(const char* at, char command) {
        const Vec2 from = at_;
        const int count = command == 'c' ? 3 : 1;
        if (command == 'M' || command == 'm') {
            paths.emplace_back();
        }
        for (int n = 0; n < count; ++n) {
            char* end = nullptr;
            const double x = std::strtod(at, &end);
            const double y = std::strtod(end, &end);
            at = end;
            at_ = (command == 'M' ? Vec2(0.0, 0.0) : from) + Vec2(x, y);
            paths.back().emplace_back(at_ / 1000.0);
        }
        return at;
    }

    Vec2 at_ = Vec2::Zero();
};

std::string pbm_of(const Picture& picture) {
    std::string text = "P1\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n";
    for (int row = 0; row < picture.height; ++row) {
        for (int column = 0; column < picture.width; ++column) {
            text += picture.at(row, column) == 0 ? "1 " : "0 ";
        }
        text += "\n";
    }
    return text;
}

class Potrace : public OracleTest {
protected:
    Potrace() : OracleTest("potrace", "potrace") {}

    void expect_same_curves(const Picture& picture,
                            const TraceSettings& settings,
                            const std::vector<std::string>& arguments) {
        write_file(folder_ / "in.pbm", pbm_of(picture));
        std::vector<std::string> all = {
            "-b", "svg", "-u", "1000", "-o", (folder_ / "out.svg").string(), (folder_ / "in.pbm").string()};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const ProgramRun answer = run(all);
        ASSERT_EQ(answer.exit_code, 0) << answer.output;
        const SvgReader theirs(read_file(folder_ / "out.svg"));
        const auto ours = trace(picture, settings);
        ASSERT_EQ(ours.size(), theirs.paths.size());
        for (std::size_t n = 0; n < ours.size(); ++n) {
            // Lines give their ends, curves their control points; a start may be repeated by a line of length
            // 0.
            std::vector<Vec2> points = {ours[n].start};
            for (const TracedCurve& curve : ours[n].curves) {
                if (!curve.straight) {
                    points.push_back(curve.first);
                    points.push_back(curve.second);
                }
                points.push_back(curve.end);
            }
            EXPECT_GE(points.size() + 1, theirs.paths[n].size());
            for (const Vec2& point : theirs.paths[n]) {
                double nearest = 1e9;
                for (const Vec2& candidate : points) {
                    nearest = std::min(nearest, (candidate - point).norm());
                }
                ASSERT_LT(nearest, 0.01); // each of its relative steps is rounded
            }
        }
    }

private:
    test::ScratchFolder folder_;
};

TEST_F(Potrace, FindsTheCurvesThatWeFind) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        expect_same_curves(blots(200, 160, seed), {}, {});
    }
    expect_same_curves(ring(), {}, {});
}

TEST_F(Potrace, UnderstandsTheSettingsAsWeDo) {
    const Picture picture = blots(200, 160, 4);
    expect_same_curves(picture, {.speckle = 300}, {"-t", "300"});
    expect_same_curves(picture, {.corner = 0.0}, {"-a", "0"});
    expect_same_curves(picture, {.corner = 1.334}, {"-a", "1.334"});
    expect_same_curves(picture, {.tolerance = 1.0}, {"-O", "1"});
    expect_same_curves(picture, {.tolerance = 0.0}, {"-n"});
    const Picture board = drawn(20, 20, [](double x, double y) {
        return (static_cast<int>(x / 5.0) + static_cast<int>(y / 5.0)) % 2 == 0;
    });
    expect_same_curves(board, {.turns = TurnPolicy::connect_black}, {"-z", "black"});
    expect_same_curves(board, {.turns = TurnPolicy::connect_white}, {"-z", "white"});
    expect_same_curves(board, {.turns = TurnPolicy::left}, {"-z", "left"});
}

} // namespace
} // namespace millwright::plot
