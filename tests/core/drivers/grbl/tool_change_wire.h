// A wire to an emulated Grbl on which programs with tool changes run, and where its machine was meanwhile.
#pragma once

#include "core/jobs/job.h"
#include "core/jobs/tool_check.h"
#include "tests/core/drivers/grbl/grbl_wire.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace millwright::test {

class ToolChangeWire : public GrblWire {
public:
    using Place = std::array<double, 3>;

    /// `surface`: what a probe touches.
    explicit ToolChangeWire(std::function<double(double, double)> surface = {})
        : GrblWire({}, {.surface = std::move(surface)}) {}

    /// With limits, and at its upper corner, which is zero.
    void home_machine() {
        command("$22=1\n$130=400\n$131=300\n$132=100\n$27=0");
        session.home(now);
        run_until([this] { return state() == drivers::DriverState::idle; }, 120.0);
    }
    void command(const std::string& lines) {
        (void)session.command(drivers::grbl::command_lines(lines), now);
        run_until([this] { return rests(); }, 120.0);
    }
    void jog(const Place& way) {
        session.jog({kinematics::AxisPositions(Vec3(way[0], way[1], way[2])), 20.0, 0.0}, now);
        run_until([this] { return rests(); }, 60.0);
    }

    /// As a dispatcher does.
    void begin(const std::string& text, const drivers::ToolChangePlan& plan) {
        jobs::Job job = jobs::text_job(text, "test.ngc");
        job.tool_change = plan;
        const drivers::DriverStatus before = session.status();
        std::vector<drivers::StoredOffset> offsets;
        for (const auto& [name, axes] : session.readout().offsets) {
            offsets.push_back({name, kinematics::AxisPositions(Vec3(axes[0], axes[1], axes[2]))});
        }
        using kinematics::AxisKind;
        const jobs::ProgramCheck found = jobs::check_program(
            jobs::controller_text(job),
            "test.ngc",
            {.dialect = gcode::Dialect::grbl,
             .axes = {{'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}},
             .start = before.position,
             .offsets = offsets,
             .modes = before.modes,
             .watched = jobs::watched_lines(job)});
        session.start(
            drivers::grbl::program_lines(*job.listing, "test.ngc"), now, {}, jobs::tool_changes(job, found));
    }

    /// Until it waits for another tool. False: it came to an end before.
    bool run_to_change() {
        return run_until([this] { return waits() || ended(); }, 600.0) && waits();
    }
    [[nodiscard]] bool waits() const {
        const drivers::DriverStatus now_there = session.status();
        return now_there.tool_change && now_there.tool_change->waits &&
               now_there.state == drivers::DriverState::holding;
    }
    [[nodiscard]] bool ended() const {
        return state() == drivers::DriverState::idle || state() == drivers::DriverState::stopped ||
               state() == drivers::DriverState::alarm;
    }

    /// Steps as long as `going`, and remembers every place where the machine was.
    template <class Going> std::vector<Place> path_while(const Going& going, double seconds = 600.0) {
        std::vector<Place> path{grbl.position()};
        for (const double end = now + seconds; now < end && going();) {
            step();
            if (grbl.position() != path.back()) {
                path.push_back(grbl.position());
            }
        }
        return path;
    }

    /// Lowest Z in which it went across.
    [[nodiscard]] static double lowest_across(const std::vector<Place>& path) {
        double lowest = 1e9;
        for (std::size_t n = 1; n < path.size(); ++n) {
            const bool across =
                std::abs(path[n][0] - path[n - 1][0]) > 1e-6 || std::abs(path[n][1] - path[n - 1][1]) > 1e-6;
            lowest = across ? std::min({lowest, path[n][2], path[n - 1][2]}) : lowest;
        }
        return lowest;
    }

    /// What was sent, without questions for the status.
    [[nodiscard]] std::string sent_lines() const {
        std::string text = sent;
        std::erase(text, '?');
        return text;
    }

private:
    [[nodiscard]] bool rests() const { return ended() || waits(); }
};

/// With a tool sensor: at X-10 Y-290, its top at Z-60 for the first tool.
struct Bench : ToolChangeWire {
    double longer = 0.0; ///< than the first tool, mm

    Bench()
        : ToolChangeWire([this](double x, double y) {
              return std::hypot(x + 10.0, y + 290.0) < 5.0 ? -60.0 + longer : -1000.0;
          }) {
        home_machine();
        command("G10 L2 P1 X-200 Y-100 Z-50");
        command("G53 G0 X-150 Y-100 Z-20");
    }
};

inline const drivers::ToolChangePlan probe_plan{
    .way = drivers::ToolChangeWay::probe,
    .spin_up = 0.0,
    .sensor = {.x = -10.0, .y = -290.0, .travel_z = -2.0, .deepest_z = -80.0}};

inline const std::string three_tools =
    "G21 G90 G94\nT1 M6\nG0 Z5\nX10\nG1 Z1 F500\nG0 Z5\nT2 M6\nX20\nG1 Z1\nG0 Z5\n"
    "T3 M6\nX30\nG1 Z1\nG0 Z5\nM30\n";

} // namespace millwright::test
