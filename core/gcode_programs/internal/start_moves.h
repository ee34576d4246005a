// The moves of a program that begin while axes have no known position, and whether they are safe: rapid moves
// of the retract axis alone are, above the part's zero and everything that is cut later. Heights in mm,
// growing away from the part.
#pragma once

#include "core/base/error.h"
#include "core/gcode/canon.h"
#include "core/kinematics/machine_model.h"
#include "core/program/program.h"
#include "core/program/retract.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::gcode::internal {

/// Of one move, by their places in the machine.
struct MoveAxes {
    const program::AxisSet& known; ///< with those that the move sets
    const program::AxisSet& named;
    const std::vector<int>& moving;
    bool height_is_known = true; ///< along the retract axis, as to the part's zero
};

class StartMoves {
public:
    /// The machine must outlive it.
    explicit StartMoves(const kinematics::MachineModel& machine);

    /// The tool's offset in the program's unit, which is `unit` mm.
    void use_tool(const AxisValues& offset, double unit);
    /// The program states the position of `axis` for the first time.
    void set(int axis, int line);
    /// From `from` to `to`, machine positions in mm and degrees.
    void move(const Move& move, const AxisValues& from, const AxisValues& to, const MoveAxes& axes);
    /// A spline at the height of the last move.
    void curve();

    /// That axes move while others have no known position, with the line that sets each; nothing if all is
    /// safe.
    [[nodiscard]] std::optional<Diagnostic> notice(const std::filesystem::path& file) const;

private:
    struct Height {
        double tip = 0.0;        ///< without the length of the tool, from machine zero
        double above_part = 0.0; ///< for its sign only: in the program's unit
        double travelled = 0.0;  ///< by the move
    };
    struct EarlyMove {
        SourcePlace source;
        program::AxisSet known;  ///< with those that it sets
        std::vector<int> moving; ///< axes
        double height = 0.0;     ///< Height::tip
    };

    [[nodiscard]] Height height_of(const Move& move, const AxisValues& from, const AxisValues& to) const;
    [[nodiscard]] bool lifts(const Move& move, const Height& height, const MoveAxes& axes) const;
    void note_cut(const Move& move, const Height& height, const MoveAxes& axes);
    void note_early(const Move& move, const Height& height, const MoveAxes& axes);
    [[nodiscard]] std::string letters_of(const std::vector<int>& axes) const;
    [[nodiscard]] std::string when_set(const std::vector<int>& unknown) const;

    const kinematics::MachineModel& machine_;
    std::optional<program::RetractAxis> retract_;
    std::size_t letter_ = 0;                     ///< of the retract axis among axis_letters
    double tool_length_ = 0.0;                   ///< along it, mm
    double last_height_ = 0.0;                   ///< Height::tip
    std::optional<double> highest_cut_;          ///< Height::tip
    std::optional<EarlyMove> lowest_lift_;       ///< of the rapid moves of the retract axis before the others
    std::optional<EarlyMove> first_move_;        ///< that is no such
    std::vector<std::pair<int, int>> first_set_; ///< axis, line; in the order of the program
};

} // namespace millwright::gcode::internal
