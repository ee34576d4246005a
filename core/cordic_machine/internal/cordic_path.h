// The instructions of lines and arcs along X, Y and Z. It knows where each instruction leaves the processor,
// bit by bit, and so divides arcs where rounding would lead them astray.
#pragma once

#include "core/cordic_machine/internal/cordic_code.h"
#include "core/cordic_machine/internal/cordic_turn.h"

#include <optional>
#include <string_view>

namespace millwright::cordic_machine::internal {

/// Of a motion, and who asked for it.
struct FeedOf {
    double speed = 0.0; ///< mm/s
    gcode::SourcePlace source;
};

/// The instructions of a line in the plane and of one that rises.
struct LineOpcodes {
    cordic::Opcode plane = cordic::Opcode::g01;
    cordic::Opcode space = cordic::Opcode::g01z;
};

/// And its registers.
struct DividedTurn {
    CordicTurn turn;
    cordic::ArcWords words;
};

class CordicPath {
public:
    /// From `start`, which is given to the processor. `code` outlives it.
    CordicPath(const CordicProgramSettings& settings, CordicCode& code, const Place3& start);

    /// A line, or a warning where the format sees none.
    void line(const LineOpcodes& opcodes, const Place3& to, const FeedOf& feed);

    /// A line to the end of a chord. False, and a fault, where the format holds that farther than `slack` mm
    /// from its place.
    bool chord(const Place3& to, const FeedOf& feed, double slack);

    /// From where the path is to `end`, or to where all its rotations lead. In more chords than `turn` has
    /// where the processor turns those more exactly.
    void arc(const CordicTurn& turn, const Place3& end, const FeedOf& feed);

    [[nodiscard]] const Place3& at() const { return at_; }

private:
    std::optional<cordic::Word> start_word(cordic::Register target, double value, std::string_view what);
    std::optional<HeldPlace> held_at(const Place3& place, gcode::SourcePlace source);
    [[nodiscard]] bool is_held(const HeldPlace& to) const;
    bool load(cordic::Register target, double value, std::string_view what, const FaultyWord& word);
    bool load_speed(const FeedOf& feed);
    void go(const LineOpcodes& opcodes, const HeldPlace& to, const Place3& exact, const FeedOf& feed);
    void publish(const Place3& to, const FeedOf& feed);

    std::optional<cordic::ArcWords> words_of(const CordicTurn& turn, gcode::SourcePlace source);
    std::optional<DividedTurn> best_divided(const CordicTurn& turn, bool rotated, gcode::SourcePlace source);
    void whole_arc(const DividedTurn& arc, const FeedOf& feed);
    void arc_in_parts(const DividedTurn& arc, const Place3& end, const FeedOf& feed);
    [[nodiscard]] Rotations part_of(const DividedTurn& arc, std::int64_t k) const;
    [[nodiscard]] double slack_of(const CordicTurn& turn) const;
    [[nodiscard]] bool turns(const cordic::ArcWords& words) const;
    bool rotate(const DividedTurn& arc, std::int64_t k, const Rotations& rotations, const FeedOf& feed);

    CordicProgramSettings settings_;
    cordic::ChordEndModel turner_;
    CordicCode& code_;
    Place3 at_;      ///< as the program has it
    HeldPlace held_; ///< as the processor has it
};

} // namespace millwright::cordic_machine::internal
