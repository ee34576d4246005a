#include "core/cordic/microprogram.h"

#include "core/base/error.h"
#include "core/cordic/instruction.h"

#include <string_view>
#include <utility>

namespace millwright::cordic {
namespace {

constexpr int record_words = 6; // X, Y, Vx, Vy, Ax, Ay
constexpr int space_words = 9;  // and Z, Vz, Az

constexpr std::string_view fetch_and_move = R"(
; Fetch. Reset begins here, and so does every instruction.
FETCH:  CONT                            | read_program
F1:     CJP   bus_busy F1
        CONT                            | load_opcode
        JMAP

NOP:    JZ
HLT:    JZ                              | halt
PAGE:   JZ                              | next_page

; Mov: the bytes of the immediate, lowest first.
MOV:    PUSH  always LAST_BYTE
        CONT                            | read_program
M2:     CJP   bus_busy M2
        RFCT                            | shift_byte
        JZ                              | store_register
)";

constexpr std::string_view line_head = R"(
; G00 and G01: a line to (XI, YJ).
LINE:   CJS   always SETPOINT           | take_end
)";

constexpr std::string_view arc_body = R"(
; G02 and G03: N chords about (XI, YJ).
ARC:    LDCT  LAST_STEP                 | fold_radius
A1:     RPCT  A1                        | rotate
        LDCT  LAST_CORRECTION
A3:     RPCT  A3                        | correct
        CJS   always SETPOINT           | unfold_radius
)";

constexpr std::string_view arc_tail = R"(
        CJP   chords_left ARC
        JZ
)";

constexpr std::string_view helix_body = R"(
; G02Z and G03Z: the same, and each chord is a line in space that rises by Z.
HELIX:  LDCT  LAST_STEP                 | fold_radius
H1:     RPCT  H1                        | rotate
        LDCT  LAST_CORRECTION
H3:     RPCT  H3                        | correct
        CJS   always SPACEPOINT         | unfold_radius, add_rise
)";
constexpr std::string_view helix_tail = R"(
        CJP   chords_left HELIX
        JZ
)";

constexpr std::string_view space_head = R"(
; G00Z and G01Z: a line to (XI, YJ, Z).
SPACE:  CJS   always SPACEPOINT         | take_end, take_height
)";

constexpr std::string_view space_point = R"(
; The same in space, to (XE, YE, ZE): bearing and length in the plane, then the slope; speed and acceleration
; are turned by the slope, what is left of them in the plane by the bearing. 140 clocks of CORDIC.
SPACEPOINT: LDCT LAST_STEP              | fold_space
P1:     RPCT  P1                        | vector
        LDCT  LAST_CORRECTION
P3:     RPCT  P3                        | correct
        LDCT  LAST_STEP                 | fold_rise
P5:     RPCT  P5                        | vector
        LDCT  LAST_STEP                 | load_speed
P7:     RPCT  P7                        | rotate, rotate_both
        LDCT  LAST_CORRECTION
P9:     RPCT  P9                        | correct, correct_both
        LDCT  LAST_STEP                 | unfold_rise
P11:    RPCT  P11                       | rotate, rotate_both
        LDCT  LAST_CORRECTION
P13:    RPCT  P13                       | correct, correct_both
        CRTN  always                    | unfold_speed
)";

constexpr std::string_view set_point = R"(
; Speed and acceleration of the axes on the way from (X0, Y0) to (XE, YE): vectoring, then rotation, 74 clocks.
SETPOINT: LDCT LAST_STEP                | fold_move
S1:     RPCT  S1                        | vector
        LDCT  LAST_CORRECTION
S3:     RPCT  S3                        | correct
        LDCT  LAST_STEP                 | load_speed
S5:     RPCT  S5                        | rotate, rotate_both
        LDCT  LAST_CORRECTION
S7:     RPCT  S7                        | correct, correct_both
        CRTN  always                    | unfold_speed
)";

/// The ends of the routines: all at once in one clock.
constexpr std::string_view latch_line = R"(        JZ                              | take_position, publish
)";
constexpr std::string_view latch_arc =
    R"(        CONT                            | take_position, publish, count_chord
)";
constexpr std::string_view latch_commands = R"(
; M-codes and G04. M02 and M30 stop the processor.
COMMAND: JZ                             | command
END:    JZ                              | command, halt
)";

/// The same with the record over the bus.
constexpr std::string_view bus_line = R"(        CJS   always STORE              | take_position, publish
        JZ
)";
constexpr std::string_view bus_space = R"(        CJS   always STORE_SPACE        | take_position, publish
        JZ
)";
constexpr std::string_view bus_arc =
    R"(        CJS   always STORE              | take_position, publish, count_chord
)";
constexpr std::string_view bus_helix =
    R"(        CJS   always STORE_SPACE        | take_position, publish, count_chord
)";
constexpr std::string_view bus_commands = R"(
; M-codes and G04. M02 and M30 stop the processor.
COMMAND: CJS  always STORE_COMMAND      | command
        JZ
END:    CJS   always STORE_COMMAND      | command
        JZ                              | halt
)";
constexpr std::string_view store = R"(
; The record, byte by byte to the motion controller.
STORE_COMMAND: LDCT LAST_COMMAND_BYTE
        CJP   always W1
STORE_SPACE: LDCT LAST_SPACE_BYTE
        CJP   always W1
STORE:  LDCT  LAST_RECORD_BYTE
W1:     CONT                            | write_byte
W2:     CJP   bus_busy W2
        RPCT  W1
        CRTN  always
)";

constexpr std::string_view memory_moves = R"(
; Ld and St: the two bytes of the address, then those of the register, lowest first.
LOAD:   CJS   always ADDRESS
        PUSH  always LAST_BYTE
        CONT                            | read_data
L2:     CJP   bus_busy L2
        RFCT                            | shift_data
        JZ                              | store_register
SAVE:   CJS   always ADDRESS
        LDCT  LAST_BYTE
V1:     CONT                            | write_data
V2:     CJP   bus_busy V2
        RPCT  V1
        JZ
ADDRESS: PUSH always LAST_ADDRESS_BYTE
        CONT                            | read_program
D2:     CJP   bus_busy D2
        RFCT                            | shift_byte
        CRTN  always                    | take_address
)";

constexpr std::string_view dispatch = R"(
.map 0x00 NOP
.map 0x01 HLT
.map 0x02 PAGE
.map 0x10 0x1f MOV
.map 0x20 0x21 LINE
.map 0x22 0x23 ARC
.map 0x24 COMMAND
.map 0x28 0x29 SPACE
.map 0x2a 0x2b HELIX
.map 0x40 0x41 COMMAND
.map 0x42 END
.map 0x43 0x49 COMMAND
.map 0x5e END
.map 0x60 COMMAND
.map 0x80 0x8f LOAD
.map 0xa0 0xb1 SAVE
)";

} // namespace

std::string microprogram_text(Publishing publishing) {
    const bool by_bus = publishing == Publishing::bus;
    std::string text(fetch_and_move.substr(1));
    text += line_head;
    text += by_bus ? bus_line : latch_line;
    text += arc_body;
    text += by_bus ? bus_arc : latch_arc;
    text += arc_tail.substr(1);
    text += space_head;
    text += by_bus ? bus_space : latch_line;
    text += helix_body;
    text += by_bus ? bus_helix : latch_arc;
    text += helix_tail.substr(1);
    text += set_point;
    text += space_point;
    text += by_bus ? bus_commands : latch_commands;
    text += by_bus ? store : std::string_view();
    text += memory_moves;
    text += dispatch;
    return text;
}

std::vector<std::pair<std::string, int>> microprogram_constants(const Sequence& sequence,
                                                                const NumberFormat& format) {
    const int corrections = sequence.clock_count() - sequence.step_count;
    expects(corrections > 0, "a sequence has something to correct");
    return {
        {"LAST_STEP", sequence.step_count - 1},
        {"LAST_CORRECTION", corrections - 1},
        {"LAST_BYTE", immediate_bytes(format) - 1},
        {"LAST_ADDRESS_BYTE", address_bytes - 1},
        {"LAST_RECORD_BYTE", record_words * immediate_bytes(format) - 1},
        {"LAST_SPACE_BYTE", space_words * immediate_bytes(format) - 1},
        {"LAST_COMMAND_BYTE", command_bytes - 1},
    };
}

Microprogram make_microprogram(const Sequence& sequence, const NumberFormat& format, Publishing publishing) {
    AssembledMicroprogram made = assemble_microprogram(
        microprogram_text(publishing), "microprogram", microprogram_constants(sequence, format));
    expects(made.errors.empty(), "our microprogram has no errors");
    return std::move(made.program);
}

} // namespace millwright::cordic
