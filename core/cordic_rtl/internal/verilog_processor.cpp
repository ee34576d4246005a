#include "core/cordic_rtl/internal/verilog_processor.h"

#include "core/cordic/instruction.h"

#include <fmt/format.h>

#include <string_view>

namespace millwright::cordic::internal {
namespace {

constexpr std::string_view bus_text = R"(module bus_unit #(parameter WAIT_STATES = 0) (
    input wire clk,
    input wire reset,
    input wire run,
    input wire fetch,            // begin to read a byte of the program,
    input wire read,             // of data,
    input wire write,            // to write one
    input wire [15:0] to_address,
    input wire [7:0] to_write,
    output wire busy,
    output reg [7:0] data,       // last byte read
    output wire rom_write,       // the byte meets the program ROM
    // The pins, as on an MCS-51: P0 with the address's low byte during ALE, P2, and the strobes. They are valid
    // at the rising edge of the clock.
    input wire [7:0] p0_in,
    output wire [7:0] p0_out,
    output wire p0_drives,
    output wire [7:0] p2,
    output wire ale,
    output wire psen_n,
    output wire rd_n,
    output wire wr_n
);
    localparam NONE = 2'd0, FETCH = 2'd1, READ = 2'd2, WRITE = 2'd3;

    reg [1:0] cycle;             // under way, after its address clock
    reg [7:0] waits;
    reg [15:0] address;
    reg [7:0] out;
    wire begins = fetch || read || write;
    wire strobes = run && !begins;
    wire last = cycle != NONE && waits == 0;

    assign busy = cycle != NONE && waits != 0;
    assign ale = run && begins;
    assign psen_n = !(strobes && cycle == FETCH);
    assign rd_n = !(strobes && cycle == READ);
    assign wr_n = !(strobes && cycle == WRITE);
    assign p2 = ale ? to_address[15:8] : address[15:8];
    assign p0_out = ale ? to_address[7:0] : out;
    assign p0_drives = ale || !wr_n;
    assign rom_write = !wr_n && last && !address[15];

    always @(posedge clk) begin
        if (reset) begin
            cycle <= NONE;
            waits <= 0;
            address <= 0;
            data <= 0;
            out <= 0;
        end else if (ale) begin
            cycle <= fetch ? FETCH : read ? READ : WRITE;
            waits <= WAIT_STATES;
            address <= to_address;
            out <= to_write;
        end else if (strobes && last) begin
            cycle <= NONE;
            if (cycle != WRITE) data <= p0_in;
        end else if (strobes && cycle != NONE) begin
            waits <= waits - 8'd1;
        end
    end
endmodule
)";

constexpr std::string_view register_file_text = R"(module register_file (
    input wire clk,
    input wire reset,
    input wire run,
    input wire [CONTROLS-1:0] control,
    input wire store,            // MOV and LD
    input wire [3:0] target,
    input wire [BITS-1:0] immediate,
    input wire turn_page,
    input wire WORD xe,
    input wire WORD ye,
    input wire WORD ze,
    input wire WORD vx_in,
    input wire WORD vy_in,
    input wire WORD ax_in,
    input wire WORD ay_in,
    input wire WORD vz_in,
    input wire WORD az_in,
    input wire [4:0] source,     // of ST
    output reg [BITS-1:0] stored,
    output wire WORD number,     // of the immediate, held at the ends of the range
    output wire overflow,
    output wire no_speed,
    output reg WORD xi,
    output reg WORD yj,
    output reg WORD vmax,
    output reg WORD amax,
    output reg WORD dz,
    output reg [31:0] n,
    output reg WORD x0,
    output reg WORD y0,
    output reg WORD vx,
    output reg WORD vy,
    output reg WORD ax,
    output reg WORD ay,
    output reg [15:0] pc,
    output reg WORD z,
    output reg WORD z0,
    output reg [31:0] p,
    output reg WORD vz,
    output reg WORD az
);
    localparam W = WIDTH;
    localparam XI = 0, YJ = 1, VMAX = 2, AMAX = 3, DZ = 4, N = 5, X0 = 6, Y0 = 7, VX = 8, VY = 9, AX = 10,
               AY = 11, PC = 12, Z = 13, Z0 = 14, P = 15, VZ = 16, AZ = 17;
CONTROL_WIRES
    wire whole = target == N || target == PC || target == P;
    wire fits = &immediate[BITS-1:W-1] || ~|immediate[BITS-1:W-1];
    wire whole_fits = (target == PC ? immediate >> 16 : immediate >> 32) == 0;
    assign number = fits ? immediate[W-1:0] : {immediate[BITS-1], {(W-1){!immediate[BITS-1]}}};
    assign overflow = store && (whole ? !whole_fits : !fits);
    assign no_speed = store && (target == VMAX || target == AMAX) && !(number > 0);

    always @* begin
        stored = 0;
        case (source)
SOURCES            default: ;
        endcase
    end

    always @(posedge clk) begin
        if (reset) begin
            {xi, yj, vmax, amax, dz, n, x0, y0, vx, vy, ax, ay, pc, z, z0, p, vz, az} <= 0;
        end else if (run) begin
            if (load_opcode || shift_byte) pc <= pc + 16'd1;
            if (turn_page) pc <= 0;
            if (take_position) begin
                x0 <= xe;
                y0 <= ye;
                z0 <= ze;
            end
            if (count_chord) n <= n - 1;
            if (fold_move) begin
                vz <= 0;
                az <= 0;
            end
            if (unfold_rise) begin
                vz <= vz_in;
                az <= az_in;
            end
            if (unfold_speed) begin
                vx <= vx_in;
                vy <= vy_in;
                ax <= ax_in;
                ay <= ay_in;
            end
            if (store && !(whole && overflow)) case (target)
                XI: xi <= number;
                YJ: yj <= number;
                VMAX: vmax <= number;
                AMAX: amax <= number;
                DZ: dz <= number;
                N: n <= immediate[31:0];
                X0: x0 <= number;
                Y0: y0 <= number;
                VX: vx <= number;
                VY: vy <= number;
                AX: ax <= number;
                AY: ay <= number;
                PC: pc <= immediate[15:0];
                Z: z <= number;
                Z0: z0 <= number;
                default: p <= immediate[31:0];
            endcase
        end
    end
endmodule
)";

constexpr std::string_view processor_head = R"(module gcode_processor #(parameter WAIT_STATES = 0) (
    input wire clk,
    input wire reset,            // synchronous
    input wire [7:0] last_page,  // of the program ROM
    output reg [7:0] rom_page,
    input wire [7:0] p0_in,
    output wire [7:0] p0_out,
    output wire p0_drives,
    output wire [7:0] p2,
    output wire ale,
    output wire psen_n,
    output wire rd_n,
    output wire wr_n,
    // To the motion controller, all at once: X, Y, Vx, Vy, Ax, Ay, Z, Vz, Az from the lowest bits on.
    output reg [9*BITS-1:0] record,
    output reg set_point,        // a record is new
    output reg [7:0] command_code,
    output reg [31:0] command_parameter,
    output reg new_command,
    output reg [4:0] stop        // why it stopped; 0: it runs
);
)";

constexpr std::string_view processor_text = R"(
    reg [7:0] ir;
    reg [BITS-1:0] temporary;    // immediate or data on its way in
    reg [3:0] bytes;             // of the temporary, or of a register on its way out
    reg [16:0] data_address;
    reg [7:0] record_byte;

    wire run = stop == 0;
    wire [CONTROLS-1:0] control;
    wire ends, unknown;
    wire [1:0] fault;
    wire bus_busy;
    wire [7:0] bus_data;
    wire rom_write;
    wire WORD xi, yj, vmax, amax, dz, x0, y0, vx, vy, ax, ay, z, z0, vz, az, number;
    wire [31:0] n, p;
    wire [15:0] pc;
    wire WORD xe, ye, ze, vx_new, vy_new, ax_new, ay_new, vz_new, az_new;
    wire [BITS-1:0] stored;
    wire register_overflow, register_no_speed, overflow, no_speed, arc_too_coarse;
CONTROL_WIRES
    control_unit microprogram (.clk(clk), .reset(reset), .run(run), .opcode(ir), .bus_busy(bus_busy),
                               .chords_left(n != 0), .control(control), .ends(ends), .unknown(unknown),
                               .fault(fault));

    wire turns_page = next_page && rom_page != last_page;
    register_file registers (.clk(clk), .reset(reset), .run(run), .control(control), .store(store_register),
                             .target(ir[3:0]), .immediate(temporary), .turn_page(turns_page), .xe(xe),
                             .ye(ye), .ze(ze), .vx_in(vx_new), .vy_in(vy_new), .ax_in(ax_new),
                             .ay_in(ay_new), .vz_in(vz_new), .az_in(az_new), .source(ir[4:0]),
                             .stored(stored), .number(number), .overflow(register_overflow),
                             .no_speed(register_no_speed), .xi(xi), .yj(yj), .vmax(vmax), .amax(amax),
                             .dz(dz), .n(n), .x0(x0), .y0(y0), .vx(vx), .vy(vy), .ax(ax), .ay(ay), .pc(pc),
                             .z(z), .z0(z0), .p(p), .vz(vz), .az(az));

    arithmetic_unit arithmetic (.clk(clk), .reset(reset), .run(run), .control(control),
                                .clockwise(ir[0] != G02_CLOCKWISE), .chords_left(n != 0), .xi(xi), .yj(yj),
                                .vmax(vmax), .amax(amax), .dz(dz), .x0(x0), .y0(y0), .height(z), .z0(z0),
                                .stores_z0(store_register && ir[3:0] == 14), .number(number), .xe(xe),
                                .ye(ye), .ze(ze), .vx(vx_new), .vy(vy_new), .ax(ax_new), .ay(ay_new),
                                .vz(vz_new), .az(az_new), .overflow(overflow), .no_speed(no_speed),
                                .arc_too_coarse(arc_too_coarse));

    // The interface unit: the program at PC, data at its address, the record at the motion controller's port.
    wire beyond_bus = (read_data || write_data) && data_address[16];
    wire [BITS-1:0] stored_rest = stored >> {bytes, 3'd0};
    wire [39:0] command_rest = {command_parameter, command_code} >> {record_byte[2:0], 3'd0};
    wire [9*BITS-1:0] record_rest = record >> {record_byte, 3'd0};
    bus_unit #(.WAIT_STATES(WAIT_STATES)) bus (
        .clk(clk), .reset(reset), .run(run), .fetch(read_program), .read(read_data && !beyond_bus),
        .write((write_data && !beyond_bus) || write_byte),
        .to_address(read_program ? pc : write_byte ? {8'hc0, record_byte} : data_address[15:0]),
        .to_write(write_data ? stored_rest[7:0] : record_byte[7] ? command_rest[7:0] : record_rest[7:0]),
        .busy(bus_busy), .data(bus_data), .rom_write(rom_write), .p0_in(p0_in), .p0_out(p0_out),
        .p0_drives(p0_drives), .p2(p2), .ale(ale), .psen_n(psen_n), .rd_n(rd_n), .wr_n(wr_n));

    // The bytes of LD and ST lie in one memory.
    function [1:0] device(input [15:0] address);
        device = !address[15] ? 2'd0 : !address[14] ? 2'd1 : 2'd2;
    endfunction
    wire [16:0] last_data = {1'b0, temporary[15:0]} + BITS / 8 - 1;
    wire across = !last_data[16] && device(temporary[15:0]) != device(last_data[15:0]);

    // The first reason of a clock stays.
    wire [4:0] stops = unknown ? ILLEGAL_INSTRUCTION
                     : fault == 1 ? STACK_OVERFLOW
                     : fault == 2 ? STACK_UNDERFLOW
                     : fault == 3 ? MICROPROGRAM_END
                     : beyond_bus ? BEYOND_BUS
                     : rom_write ? ROM_WRITE
                     : no_speed ? NO_SPEED
                     : arc_too_coarse ? ARC_TOO_COARSE
                     : overflow ? OVERFLOW
                     : take_address && across ? ACROSS_MEMORIES
                     : register_overflow ? OVERFLOW
                     : register_no_speed ? NO_SPEED
                     : next_page && !turns_page ? NO_PAGE
                     : halt ? HALTED : 5'd0;

    reg takes_parameter;
    always @* begin
        takes_parameter = 0;
        case (ir)
            PARAMETERS: takes_parameter = 1;
            default: ;
        endcase
    end

    always @(posedge clk) begin
        if (reset) begin
            stop <= 0;
            ir <= 0;
            temporary <= 0;
            bytes <= 0;
            data_address <= 0;
            record_byte <= 0;
            rom_page <= 0;
            record <= 0;
            set_point <= 0;
            command_code <= 0;
            command_parameter <= 0;
            new_command <= 0;
        end else if (run) begin
            stop <= stops;
            set_point <= publish;
            new_command <= command;
            if (load_opcode) begin
                ir <= bus_data;
                temporary <= 0;
                bytes <= 0;
            end
            if (shift_byte || shift_data) begin
                temporary <= temporary | ({{(BITS-8){1'b0}}, bus_data} << {bytes, 3'd0});
                bytes <= bytes + 4'd1;
            end
            if (take_address) begin
                data_address <= {1'b0, temporary[15:0]};
                temporary <= 0;
                bytes <= 0;
            end
            if (read_data || write_data) data_address <= data_address + 17'd1;
            if (write_data) bytes <= bytes + 4'd1;
            if (turns_page) rom_page <= rom_page + 8'd1;
            if (publish) begin
                record <= {EXTENDED};
                record_byte <= 0;
            end
            if (command) begin
                command_code <= ir;
                command_parameter <= takes_parameter ? p : 32'd0;
                record_byte <= 8'h80;
            end
            if (write_byte) record_byte <= record_byte + 8'd1;
        end else begin
            set_point <= 0;
            new_command <= 0;
        end
    end
endmodule
)";

/// `name` as BITS bits; a wire to name it by.
std::string extended(const NumberFormat& format, std::string_view name) {
    const int spare = 8 * immediate_bytes(format) - format.word();
    return spare == 0 ? std::string(name)
                      : fmt::format("{{{{{}{{{}[{}]}}}}, {}}}", spare, name, format.word() - 1, name);
}

std::string sources(const NumberFormat& format) {
    std::string text;
    for (int number = 0; number < register_count; ++number) {
        const auto name = static_cast<Register>(number);
        std::string wire;
        for (const char c : to_text(name)) {
            wire += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        }
        text += fmt::format(
            "            {}: stored = {};\n", number, is_whole(name) ? wire : extended(format, wire));
    }
    return text;
}

std::string stop_codes() {
    const auto code = [](std::string_view name, Stop stop) {
        return fmt::format("    localparam [4:0] {} = {};\n", name, static_cast<int>(stop));
    };
    return code("HALTED", Stop::halted) + code("OVERFLOW", Stop::overflow) +
           code("NO_SPEED", Stop::no_speed) + code("ILLEGAL_INSTRUCTION", Stop::illegal_instruction) +
           code("STACK_OVERFLOW", Stop::stack_overflow) + code("STACK_UNDERFLOW", Stop::stack_underflow) +
           code("MICROPROGRAM_END", Stop::microprogram_end) + code("ROM_WRITE", Stop::rom_write) +
           code("ACROSS_MEMORIES", Stop::across_memories) + code("BEYOND_BUS", Stop::beyond_bus) +
           code("NO_PAGE", Stop::no_page) + code("ARC_TOO_COARSE", Stop::arc_too_coarse);
}

std::string opcodes_with_parameter() {
    std::string text;
    for (const NamedOpcode& known : named_opcodes()) {
        if (takes_parameter(known.opcode)) {
            text += fmt::format("{}8'h{:02x}", text.empty() ? "" : ", ", static_cast<int>(known.opcode));
        }
    }
    return text;
}

/// The record, highest word first.
std::string record_concatenation(const NumberFormat& format) {
    std::string text;
    for (const char* name : {"az", "vz", "ze", "ay", "ax", "vy", "vx", "ye", "xe"}) {
        text += fmt::format("{}{}", text.empty() ? "" : ", ", extended(format, name));
    }
    return text;
}

void replace_sizes(std::string& text, const NumberFormat& format) {
    replace_all(text, "CONTROL_WIRES\n", control_wires());
    replace_all(text, "CONTROLS", std::to_string(control_count));
    replace_all(text, "BITS", std::to_string(8 * immediate_bytes(format)));
    replace_all(text, "WIDTH", std::to_string(format.word()));
}

} // namespace

std::string control_wires() {
    std::string text = "\n";
    for (int n = 0; n < control_count; ++n) {
        text += fmt::format("    wire {} = control[{}];\n", to_text(static_cast<Control>(n)), n);
    }
    return text;
}

std::string bus_module(const Verilog& verilog) {
    return verilog.head("Interface unit: read and write cycles of an MCS-51-like bus.") +
           std::string(bus_text);
}

std::string register_module(const Verilog& verilog, const NumberFormat& format) {
    std::string text = verilog.head("Register file.") + verilog.filled(register_file_text);
    replace_all(text, "SOURCES", sources(format));
    replace_sizes(text, format);
    return text;
}

std::string
processor_module(const Verilog& verilog, const NumberFormat& format, const ProcessorSettings& settings) {
    std::string text = verilog.head("The processor: control unit, registers, arithmetic unit and bus.") +
                       std::string(processor_head) + stop_codes() + verilog.filled(processor_text);
    replace_all(text, "G02_CLOCKWISE", settings.sense == ArcSense::iso ? "1'b1" : "1'b0");
    replace_all(text, "PARAMETERS", opcodes_with_parameter());
    replace_all(text, "EXTENDED", record_concatenation(format));
    replace_sizes(text, format);
    return text;
}

} // namespace millwright::cordic::internal
