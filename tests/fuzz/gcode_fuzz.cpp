// Any bytes are a program: they give operations with finite numbers, arcs that are arcs, and diagnostics with
// a place; never a crash, a hang or a NaN.
#include "core/base/error.h"
#include "core/gcode/canon_printer.h"
#include "core/gcode/interpreter.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace {

using namespace millwright;        // NOLINT(google-build-using-namespace)
using namespace millwright::gcode; // NOLINT(google-build-using-namespace)

void expect_finite(const AxisValues& values) {
    for (std::size_t n = 0; n < axis_count; ++n) {
        expects(std::isfinite(values[n]), "a coordinate is finite");
    }
}

/// Checks what comes, and prints it nowhere.
class Checker final : public CanonSink {
public:
    void move(const Move& move, const SourceLine& now) override {
        expect_finite(move.target);
        expects(move.source.line >= 1 && move.source.line <= now.place.line + 1'000'000,
                "a move knows its line");
        if (move.kind == MoveKind::arc) {
            constexpr double largest_radius = 1.1e6;
            expects(std::isfinite(move.centre_1) && std::isfinite(move.centre_2), "a centre is finite");
            expects(std::abs(move.sweep) >= hair_sweep, "an arc is no hair");
            expects((move.sweep > 0.0) == (move.turns > 0), "an arc turns as it says");
            expects(radius(move) <= largest_radius, "an arc is not giant");
        }
        print(move, now);
    }
    void curve(const Curve& curve, const SourceLine& now) override {
        for (const ControlPoint& point : curve.points) {
            expects(std::isfinite(point.x + point.y) && point.weight > 0.0, "a control point is finite");
        }
        printer_.curve(curve, now);
    }
    void command(const Command& command, const SourceLine& now) override {
        expects(std::isfinite(command.value) && std::isfinite(command.value_2), "a value is finite");
        expect_finite(command.axes);
        printer_.command(command, now);
    }

private:
    static double radius(const Move& move) {
        const auto second = move.plane == Plane::xy ? Axis::y : move.plane == Plane::xz ? Axis::x : Axis::z;
        const auto first = move.plane == Plane::xy ? Axis::x : move.plane == Plane::xz ? Axis::z : Axis::y;
        return std::hypot(move.target[first] - move.centre_1, move.target[second] - move.centre_2);
    }
    /// Some of them: a cycle makes a million.
    void print(const Move& move, const SourceLine& now) {
        constexpr int most_printed = 1000;
        if (++printed_ < most_printed) {
            printer_.move(move, now);
        }
    }

    CanonPrinter printer_{[](std::string_view) {}};
    int printed_ = 0;
};

void read(std::string_view text, Dialect dialect) {
    ReaderSettings settings;
    settings.dialect = dialect;
    settings.most_errors = 20;
    settings.most_repeated_lines = 2000;
    settings.most_moves_of_a_line = 1000;
    settings.tools = parse_tool_table("T1 P1 Z10 D5\nT2 P2 X1 Z2 D-3 Q2", "fuzz.tbl");
    Checker checker;
    Interpreter program(text, "fuzz.ngc", settings, checker);
    program.run();
    for (const Diagnostic& error : program.errors()) {
        expects(error.place.line >= 0 && error.place.column >= 1 && !error.message.empty(),
                "an error has a place and a rule");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    read(text, Dialect::linuxcnc);
    read(text, Dialect::grbl);
    return 0;
}
