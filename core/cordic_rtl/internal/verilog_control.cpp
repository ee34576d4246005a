#include "core/cordic_rtl/internal/verilog_processor.h"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

namespace millwright::cordic::internal {
namespace {

constexpr std::string_view sequencer_text = R"(module micro_sequencer (
    input wire clk,
    input wire reset,
    input wire enable,
    input wire [3:0] op,
    input wire pass,
    input wire [7:0] branch,
    input wire [7:0] map,
    input wire [7:0] vector,
    output wire [7:0] next,     // address of the micro-instruction of the next clock
    output reg [7:0] counter,
    output reg [2:0] depth,     // words on the stack
    output wire [1:0] fault     // 1 overflow of the stack, 2 underflow, 3 no address behind the last one
);
    localparam JZ = 0, CJS = 1, JMAP = 2, CJP = 3, PUSH = 4, JSRP = 5, CJV = 6, JRP = 7, RFCT = 8, RPCT = 9,
               CRTN = 10, CJPP = 11, LDCT = 12, LOOP = 13, CONT = 14, TWB = 15;

    reg [7:0] address;          // micro-PC: of the micro-instruction of this clock
    reg [7:0] stack [0:3];
    wire [8:0] behind = address + 9'd1;
    wire [1:0] at_top = depth[1:0] - 2'd1;
    wire [7:0] top = (depth == 0) ? 8'd0 : stack[at_top];
    wire counted = counter != 0;

    reg [8:0] to;
    reg push, pop, peek, clear, load, count;
    always @* begin
        to = behind;
        push = 0;
        pop = 0;
        peek = 0;
        clear = 0;
        load = 0;
        count = 0;
        case (op)
            JZ: begin to = 0; clear = 1; end
            CJS: if (pass) begin to = branch; push = 1; end
            JMAP: to = map;
            CJP: if (pass) to = branch;
            PUSH: begin push = 1; load = pass; end
            JSRP: begin to = pass ? branch : counter; push = 1; end
            CJV: if (pass) to = vector;
            JRP: to = pass ? branch : counter;
            RFCT: if (counted) begin to = top; peek = 1; count = 1; end else pop = 1;
            RPCT: if (counted) begin to = branch; count = 1; end
            CRTN: if (pass) begin to = top; pop = 1; end
            CJPP: if (pass) begin to = branch; pop = 1; end
            LDCT: load = 1;
            LOOP: if (pass) pop = 1; else begin to = top; peek = 1; end
            TWB: begin
                pop = pass || !counted;
                peek = !pop;
                count = counted;
                if (!pass) to = counted ? top : branch;
            end
            default: ;          // CONT
        endcase
    end

    assign fault = (to[8] || (push && behind[8])) ? 2'd3
                 : ((pop || peek) && depth == 0) ? 2'd2
                 : (push && depth == 4) ? 2'd1 : 2'd0;
    wire steps = enable && fault == 0;
    assign next = steps ? to[7:0] : address;

    always @(posedge clk) begin
        if (reset) begin
            address <= 0;
            counter <= 0;
            depth <= 0;
        end else if (steps) begin
            address <= to[7:0];
            if (push) stack[depth[1:0]] <= behind[7:0];
            if (push) depth <= depth + 3'd1;
            else if (pop) depth <= depth - 3'd1;
            else if (clear) depth <= 0;
            if (load) counter <= branch;
            else if (count) counter <= counter - 8'd1;
        end
    end
endmodule
)";

constexpr std::string_view control_text = R"(module control_unit (
    input wire clk,
    input wire reset,
    input wire run,
    input wire [7:0] opcode,
    input wire bus_busy,
    input wire chords_left,
    output wire [CONTROLS-1:0] control, // signals of the micro-instruction that this clock executes
    output wire ends,                   // the last clock of an instruction
    output wire unknown,                // the mapping ROM has no address for the opcode
    output wire [1:0] fault             // of the sequencer
);
MICRO_ROM
MAPPING_ROM
    // Pipeline register: {operation, condition, branch, control signals}.
    reg [CONTROLS+14:0] pl;
    wire [3:0] op = pl[CONTROLS+14:CONTROLS+11];
    wire [2:0] condition = pl[CONTROLS+10:CONTROLS+8];
    wire [7:0] branch = pl[CONTROLS+7:CONTROLS];
    wire [7:0] next, counter;
    wire [2:0] depth;
    wire [8:0] mapped = mapping_rom(opcode);
    wire pass = condition == 1 || (condition == 2 && bus_busy) || (condition == 3 && chords_left)
             || (condition == 4 && counter != 0);
    assign control = pl[CONTROLS-1:0];
    assign ends = op == 0;
    assign unknown = op == 2 && !mapped[8];

    micro_sequencer sequencer (.clk(clk), .reset(reset), .enable(run && !unknown), .op(op), .pass(pass),
                               .branch(branch), .map(mapped[7:0]), .vector(branch + {4'd0, opcode[3:0]}),
                               .next(next), .counter(counter), .depth(depth), .fault(fault));

    always @(posedge clk) begin
        if (reset) pl <= micro_rom(0);
        else if (run) pl <= micro_rom(next);
    end
endmodule
)";

std::string micro_rom(const Microprogram& program) {
    constexpr int width = 4 + 3 + 8 + control_count;
    std::string text =
        fmt::format("    function [{}:0] micro_rom(input [7:0] at);\n        case (at)\n", width - 1);
    std::istringstream lines(listing(program));
    std::string line;
    for (int address = 0; address < program.count && std::getline(lines, line); ++address) {
        const MicroWord& word = program.words[static_cast<std::size_t>(address)];
        const std::uint64_t bits = std::uint64_t{static_cast<std::uint8_t>(word.op)} << (control_count + 11) |
                                   std::uint64_t{static_cast<std::uint8_t>(word.condition)}
                                       << (control_count + 8) |
                                   std::uint64_t{word.branch} << control_count | word.controls;
        text +=
            fmt::format("            8'd{}: micro_rom = {}'h{:012x}; // {}\n", address, width, bits, line);
    }
    return text + "            default: micro_rom = 0;\n        endcase\n    endfunction\n";
}

std::string mapping_rom(const Microprogram& program) {
    std::string text =
        "    // {known, address}\n    function [8:0] mapping_rom(input [7:0] code);\n        case (code)\n";
    for (std::size_t opcode = 0; opcode < program.map.size(); ++opcode) {
        if (const auto& address = program.map[opcode]) {
            text += fmt::format("            8'h{:02x}: mapping_rom = {{1'b1, 8'd{}}};\n",
                                opcode,
                                static_cast<int>(*address));
        }
    }
    return text + "            default: mapping_rom = 0;\n        endcase\n    endfunction\n";
}

} // namespace

void replace_all(std::string& text, std::string_view name, std::string_view value) {
    for (auto at = text.find(name); at != std::string::npos; at = text.find(name, at + value.size())) {
        text.replace(at, name.size(), value);
    }
}

std::string sequencer_module(const Verilog& verilog) {
    return verilog.head("Microprogram sequencer: sixteen operations, a counter and a stack of four.") +
           std::string(sequencer_text);
}

std::string control_module(const Verilog& verilog, const Microprogram& program) {
    std::string text =
        verilog.head("Control unit: micro-ROM, mapping ROM, pipeline register and sequencer.") +
        std::string(control_text);
    replace_all(text, "MICRO_ROM\n", micro_rom(program));
    replace_all(text, "MAPPING_ROM\n", mapping_rom(program));
    replace_all(text, "CONTROLS", std::to_string(control_count));
    return text;
}

} // namespace millwright::cordic::internal
