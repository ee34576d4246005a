// hp2xx 3.4.4 reads the sample plots too, and must draw what we draw: the same extents and the same length of
// strokes of each pen.
#include "core/base/files.h"
#include "core/plot/hpgl/reader.h"
#include "tests/support/oracle.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace millwright::plot {
namespace {

constexpr double tolerance = 0.05; // mm

/// What hp2xx's simplified HPGL holds: vectors in plotter units.
struct Drawing {
    Strokes strokes;
    std::map<int, double> length; ///< of each pen, mm
};

// hp2xx counts its output from the corner that it is given, in plotter units.
constexpr double corner = -20000.0;
constexpr double mm_per_unit = 0.025;

Drawing drawing_in(const std::string& text) {
    Drawing drawing;
    int pen = 1;
    Vec2 at = Vec2::Zero();
    std::set<std::array<long, 4>> seen;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t end = std::min(text.find(';', from), text.size());
        const std::string command = text.substr(from, end - from);
        from = end + 1;
        double x = 0.0;
        double y = 0.0;
        if (command.rfind("SP", 0) == 0) {
            pen = std::stoi(command.substr(2));
        } else if (std::sscanf(command.c_str(), "P%*1[UD]%lf,%lf", &x, &y) == 2) {
            const Vec2 to = (Vec2(x, y) + Vec2(corner, corner)) * mm_per_unit;
            // It draws the first chord of a circle once more at the end.
            const std::array<long, 4> vector = {std::lround(1e3 * at.x()),
                                                std::lround(1e3 * at.y()),
                                                std::lround(1e3 * to.x()),
                                                std::lround(1e3 * to.y())};
            if (command[1] == 'D' && seen.insert(vector).second) {
                drawing.strokes.push_back({.pen = pen, .points = {at, to}});
                drawing.length[pen] += (to - at).norm();
            }
            at = to;
        }
    }
    return drawing;
}

std::map<int, double> lengths_of(const Strokes& strokes) {
    std::map<int, double> lengths;
    for (const Stroke& stroke : strokes) {
        lengths[stroke.pen] += length(stroke);
    }
    return lengths;
}

class Hp2xx : public OracleTest {
protected:
    Hp2xx() : OracleTest("hp2xx", "hp2xx") {}

    Drawing draw(const std::string& bytes) {
        write_file(folder_ / "plot.plt", bytes);
        const auto answer = run({"-q",
                                 "-t",
                                 "-n",
                                 "-mhpgl",
                                 "-x-20000",
                                 "-y-20000",
                                 "-f" + (folder_ / "out").string(),
                                 (folder_ / "plot.plt").string()});
        EXPECT_EQ(answer.exit_code, 0) << answer.output;
        return drawing_in(read_file(folder_ / "out"));
    }

    void expect_same_drawing(const std::string& bytes) {
        ReaderSettings settings;
        settings.fill = FillMode::outline;
        settings.p2 = Vec2(33600.0, 47520.0); // the sheet that hp2xx assumes
        const Plot ours = read_hpgl(bytes, "plot.plt", settings);
        EXPECT_TRUE(ours.diagnostics.empty()) << to_text(ours.diagnostics.front());
        const Drawing theirs = draw(bytes);
        const auto box = extents(ours.strokes);
        const auto their_box = extents(theirs.strokes);
        ASSERT_TRUE(box && their_box);
        EXPECT_LT((box->lower - their_box->lower).cwiseAbs().maxCoeff(), tolerance)
            << box->lower.transpose() << " theirs " << their_box->lower.transpose();
        EXPECT_LT((box->upper - their_box->upper).cwiseAbs().maxCoeff(), tolerance)
            << box->upper.transpose() << " theirs " << their_box->upper.transpose();
        const std::map<int, double> lengths = lengths_of(ours.strokes);
        for (const auto& [pen, length] : theirs.length) {
            const auto known = lengths.find(pen);
            ASSERT_TRUE(known != lengths.end()) << "pen " << pen;
            EXPECT_NEAR(known->second, length, tolerance) << "pen " << pen;
        }
        EXPECT_EQ(lengths.size(), theirs.length.size());
    }

    void expect_same_pen_place(const std::string& style, const std::string& text) {
        const std::string plot = "IN;SP1;SI0.6,0.8;" + style + "PU2000,3000;" + text + "PD5000,5000;PU;SP0;";
        SCOPED_TRACE(plot);
        expect_same_drawing(plot);
    }

    static std::string sample(const std::string& name) {
        return read_file("assets/samples/plot/" + name + ".plt");
    }

private:
    test::ScratchFolder folder_;
};

TEST_F(Hp2xx, DrawsMovesLikeUs) {
    expect_same_drawing(sample("moves"));
}

TEST_F(Hp2xx, DrawsArcsAndCirclesLikeUs) {
    expect_same_drawing(sample("arcs"));
}

TEST_F(Hp2xx, DrawsRectanglesWedgesAndPolygonsLikeUs) {
    expect_same_drawing(sample("figures"));
}

TEST_F(Hp2xx, ScalesRotatesAndClipsLikeUs) {
    expect_same_drawing(sample("scaling"));
}

TEST_F(Hp2xx, DashesLikeUs) {
    expect_same_drawing(sample("line-types"));
}

TEST_F(Hp2xx, DecodesPolylinesLikeUs) {
    expect_same_drawing(sample("encoded"));
}

TEST_F(Hp2xx, DrawsBezierCurvesLikeUs) {
    expect_same_drawing(sample("curves"));
}

TEST_F(Hp2xx, DrawsTicksLikeUs) {
    expect_same_drawing(sample("ticks"));
}

// Behind the switch back to PCL, hp2xx begins another picture over the first.
TEST_F(Hp2xx, ReadsFilesOfTodayLikeUs) {
    const std::string bytes = sample("everyday");
    expect_same_drawing(bytes.substr(0, bytes.find("\x1b%0A")));
}

// Wrapped lines are beyond hp2xx: it gets them unwrapped.
TEST_F(Hp2xx, DrawsAnAutocadFileLikeUs) {
    std::string bytes = sample("autocad-7475");
    std::erase_if(bytes, [](char c) { return c == '\r' || c == '\n'; });
    expect_same_drawing(bytes);
}

// Our letters are our own, so labels of blanks show that the pen ends where hp2xx has it.
TEST_F(Hp2xx, LeavesThePenBehindALabelWhereWeDo) {
    const std::vector<std::string> styles = {
        "", "ES1,1;", "ES0.5;", "DI1,1;", "DI0,-3;", "DR2,1;", "SR1,2;", "SL0.5;", "RO90;", "SI1,1;"};
    const std::vector<std::string> texts = {
        "LB    \x03", "LB  \r\n   \x03", "LB  \x03LB \x03", "CP2,1;", "CP-1,-3.5;", "BL   \x03PB;"};
    for (const std::string& style : styles) {
        for (const std::string& text : texts) {
            expect_same_pen_place(style, text);
        }
    }
    // Justified, and downwards: one line only, with more hp2xx forgets it.
    for (const char* style : {"LO4;", "LO5;", "LO7;", "LO9;", "LO14;", "DV1;"}) {
        expect_same_pen_place(style, "LB    \x03");
    }
}

TEST_F(Hp2xx, DrawsCharactersOfOnesOwnLikeUs) {
    expect_same_drawing("IN;SP1;SI0.6,0.8;PU1000,1000;UC99,4,0,0,7,-99,2,2,99,-4,0;PD3000,3000;PU;SP0;");
}

} // namespace
} // namespace millwright::plot
