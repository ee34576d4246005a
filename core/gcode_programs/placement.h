// What a program takes for known and never says: where the axes are at the start, and where the work lies on
// the machine. Its text is the same program for another control only if nothing in it depends on either.
#pragma once

#include "core/base/error.h"
#include "core/gcode/canon.h"
#include "core/gcode_programs/internal/start_moves.h"
#include "core/geometry/vectors.h"
#include "core/kinematics/machine_model.h"
#include "core/program/program.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::gcode {

class Placement {
public:
    /// `start_known`: the axes are where the first move takes them to be. The machine must outlive it.
    Placement(const kinematics::MachineModel& machine, std::filesystem::path file, bool start_known);

    /// `line`: as in UnsupportedFeatures.
    void command(const Command& command, std::string_view line);
    /// From `from` to `to`, machine positions in mm and degrees; before its blocks are made.
    void move(const Move& move, const AxisValues& from, const AxisValues& to, std::string_view line);
    /// A spline in X and Y.
    void curve(SourcePlace source, std::string_view line);

    /// The machine's axes that the last move names: those with a word whose position the program has said by
    /// now.
    [[nodiscard]] const program::AxisSet& named() const { return named_; }
    /// The last move is the first to name one of its axes, so its length is not known.
    [[nodiscard]] bool starts_anywhere() const { return starts_anywhere_; }

    /// What depends on a position that was not said, the first of each kind.
    [[nodiscard]] std::vector<Diagnostic> take_unplaced() { return std::move(unplaced_); }
    /// That axes move while others have no known position yet, all of them in one sentence, with the line
    /// that sets each; nothing where the first move names all, be it behind rapid moves of the retract axis
    /// to heights above the work's zero and above everything that is cut later.
    [[nodiscard]] std::optional<Diagnostic> start_notice() const;

private:
    enum class Kind {
        increment,
        arc,
        measured,
        stored,
        machine_position,
        two_systems,
        lowers,
        inverse_time,
        compensation
    };
    /// What the positions of an axis count from, by what of it is not known; the machine's zero where all is.
    struct Frame {
        int system = 0;   ///< that has an unknown offset, 1: G54 to 9: G59.3; 0: the offset is known
        int turned = 0;   ///< place among turned_places_, from 1, of an unknown rotation; 0: it is known
        bool g92 = false; ///< a stored G92 offset, which is not known, is added

        [[nodiscard]] bool is_machine() const { return *this == Frame{}; }
        friend bool operator==(const Frame&, const Frame&) = default;
    };
    /// Where a system of unknown rotation is turned about: positions of two such places have nothing to do
    /// with each other.
    struct TurnedPlace {
        int system = 1;
        Vec2 offset = Vec2::Zero(); ///< with that of the tool, mm
    };

    void refuse(Kind kind, SourcePlace source, std::string_view line, char letter, Diagnostic found);
    void refuse_at(Kind kind, SourcePlace source, int column, Diagnostic found);
    void measured(const Command& command, std::string_view line);
    void read_unknown(const Command& command);
    void take_rotation(const Command& command);
    void find_turned_place();
    [[nodiscard]] bool is_turned(int axis) const;
    [[nodiscard]] Frame frame_of(int axis) const;
    [[nodiscard]] std::string name_of_unknown(const Frame& frame, const Frame& other) const;
    [[nodiscard]] static std::string remedy_for(const Frame& frame, const Frame& other);
    void expect_known_begin(const Move& move, const std::vector<int>& moving, std::string_view line);
    void take_words(const Move& move, std::string_view line);
    void look_at_frame(const Move& move, const std::vector<int>& moving, std::string_view line);
    void expect_one_frame(int axis, SourcePlace source, std::string_view line);
    void
    look_at_reference(const Move& move, const AxisValues& from, const AxisValues& to, std::string_view line);
    [[nodiscard]] bool knows_height(const Move& move) const;
    [[nodiscard]] char letter_of(int axis) const { return machine_.axis(axis).letter; }

    const kinematics::MachineModel& machine_;
    std::filesystem::path file_;
    internal::StartMoves starts_;
    std::vector<std::size_t> index_of_; ///< of each axis among axis_letters
    program::AxisSet known_, named_;
    bool starts_anywhere_ = false;
    int system_ = 1;                               ///< 1: G54 to 9: G59.3
    AxisBits system_known_ = 0;                    ///< axes whose offset in it is known
    AxisBits g92_known_ = 0;                       ///< the same for G92
    bool rotation_known_ = true;                   ///< of the system
    double rotation_deg_ = 0.0;                    ///< of the system
    double unit_ = 1.0;                            ///< of the program, mm
    Vec2 offset_ = Vec2::Zero();                   ///< of the system in X and Y, mm
    Vec2 tool_ = Vec2::Zero();                     ///< offset of the tool in X and Y, mm
    bool touched_off_ = false;                     ///< the offset that comes next is one of G10 L20
    std::vector<TurnedPlace> turned_places_;       ///< so far
    int turned_ = 0;                               ///< Frame::turned of X and Y
    std::vector<std::optional<Frame>> frame_used_; ///< of each axis by the moves so far
    std::set<Kind> refused_;
    std::vector<Diagnostic> unplaced_;
};

/// G54 to G59.3, of 1 to 9.
[[nodiscard]] std::string name_of_system(int system);

} // namespace millwright::gcode
