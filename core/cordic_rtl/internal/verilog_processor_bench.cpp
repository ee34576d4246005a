#include "core/base/error.h"
#include "core/cordic_rtl/internal/verilog_processor.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <random>
#include <string_view>

namespace millwright::cordic::internal {
namespace {

constexpr int bits_of_counts = 32;

/// Bits of a register in expected.hex: whole digits, and never fewer than those of N and P.
int field_bits(const Verilog& verilog) {
    return std::max(bits_of_counts, 4 * verilog.digits());
}

/// The pins of a clock, as the bench sees them: the multiplexed ones only while the processor drives them.
std::uint32_t pin_bits(const BusPins& pins, bool on) {
    const bool ale = on && pins.ale;
    const bool wr = on && pins.wr;
    const std::uint32_t low = ale ? pins.address & 0xffU : wr ? pins.data : 0U;
    return static_cast<std::uint32_t>(ale) << 19U | static_cast<std::uint32_t>(on && pins.psen) << 18U |
           static_cast<std::uint32_t>(on && pins.rd) << 17U | static_cast<std::uint32_t>(wr) << 16U |
           (pins.address & 0xff00U) | low;
}

class Trace {
public:
    Trace(const Verilog& verilog, ProcessorVectors& vectors) : verilog_(verilog), vectors_(vectors) {}

    void run(Processor& processor, std::int64_t most_clocks) {
        std::uint32_t pins = 0;
        std::int64_t ended = 0;
        std::size_t points = 0;
        std::size_t commands = 0;
        const ProcessorState& state = processor.state();
        while (state.stop == Stop::none) {
            if (state.clocks.total >= most_clocks) {
                throw Error(fmt::format("the program runs for more than {} clocks", most_clocks),
                            {},
                            "choose a shorter program: the simulation compares every clock");
            }
            processor.clock();
            pins = std::rotl(pins, 1) ^ pin_bits(state.bus.pins, state.stop != Stop::beyond_bus);
            for (; points < processor.published().size(); ++points) {
                record(processor.published()[points], immediate_bytes(processor.format()));
            }
            for (; commands < processor.commanded().size(); ++commands) {
                record(processor.commanded()[commands], immediate_bytes(processor.format()));
            }
            if (state.instructions != ended || state.stop != Stop::none) {
                ended = state.instructions;
                line(state, pins);
            }
        }
        vectors_.instructions += ended;
        vectors_.most_clocks = std::max(vectors_.most_clocks, state.clocks.total);
    }

private:
    void line(const ProcessorState& state, std::uint32_t pins) {
        auto out = std::back_inserter(vectors_.expected);
        fmt::format_to(out,
                       "{:08x}{:08x}{:08x}{:02x}",
                       state.clocks.total,
                       state.clocks.cordic,
                       pins,
                       static_cast<int>(state.stop));
        const int digits = field_bits(verilog_) / 4;
        const auto field = [&](Word word, int bits) {
            fmt::format_to(out, "{:0{}x}", lowest_bits(word, bits), digits);
        };
        for (int n = 0; n < register_count; ++n) {
            const auto name = static_cast<Register>(n);
            field(register_of(state, name), is_whole(name) ? bits_of_counts : verilog_.word());
        }
        for (const Word word : {state.path.x, state.path.y, state.path.z, state.path.x2, state.path.y2}) {
            field(word, verilog_.word());
        }
        vectors_.expected += '\n';
        ++vectors_.lines;
    }

    void record(const Published& point, int bytes) {
        head(false, point.clock, point.opcode, 0);
        for (auto word = point.words.rbegin(); word != point.words.rend(); ++word) {
            fmt::format_to(
                std::back_inserter(vectors_.records), "{:0{}x}", lowest_bits(*word, 8 * bytes), 2 * bytes);
        }
        vectors_.records += '\n';
    }
    void record(const Commanded& command, int bytes) {
        head(true, command.clock, command.opcode, command.parameter);
        vectors_.records +=
            fmt::format("{:0{}x}\n", 0, 2 * bytes * static_cast<int>(Published{}.words.size()));
    }
    void head(bool command, std::int64_t clock, Opcode opcode, std::uint32_t parameter) {
        fmt::format_to(std::back_inserter(vectors_.records),
                       "{:02x}{:08x}{:02x}{:08x}",
                       command ? 1 : 0,
                       clock,
                       static_cast<int>(opcode),
                       parameter);
        ++vectors_.record_count;
    }

    const Verilog& verilog_;
    ProcessorVectors& vectors_;
};

constexpr std::string_view bench_text = R"(module gcode_processor_tb;
    localparam W = WIDTH;
    localparam F = FIELD;               // bits of a register in expected.hex
    localparam RUNS = RUN_COUNT;
    localparam LINES = LINE_COUNT;
    localparam RECORDS = RECORD_COUNT;
    localparam MOST_CLOCKS = CLOCK_COUNT; // of a run

    reg [7:0] rom [0:PAGE_COUNT*32768-1];
    reg [7:0] memory [0:32767];         // from 0x8000 on: dual-port RAM, then the motion controller's port
    reg [23*F+103:0] expected [0:LINES-1];
    reg [9*BITS+79:0] records [0:RECORDS-1];

    reg clk, reset;
    reg [7:0] first_page, last_page;
    wire [7:0] rom_page, p0_out, p2;
    wire p0_drives, ale, psen_n, rd_n, wr_n;
    wire [9*BITS-1:0] record;
    wire set_point, new_command;
    wire [7:0] command_code;
    wire [31:0] command_parameter;
    wire [4:0] stop;

    // The address register and the memories behind it. Pins are valid at the rising edge: ALE and the address go
    // away together behind it.
    reg [7:0] low;
    always @(posedge clk) if (ale) low <= p0_out;
    wire [15:0] address = {p2, low};
    wire [7:0] page = first_page + rom_page;
    wire [7:0] p0_in = (!psen_n || !rd_n)
                     ? (address[15] ? memory[address[14:0]] : rom[{page, address[14:0]}]) : 8'hff;

    gcode_processor #(.WAIT_STATES(WAITS)) processor (
        .clk(clk), .reset(reset), .last_page(last_page), .rom_page(rom_page), .p0_in(p0_in), .p0_out(p0_out),
        .p0_drives(p0_drives), .p2(p2), .ale(ale), .psen_n(psen_n), .rd_n(rd_n), .wr_n(wr_n),
        .record(record), .set_point(set_point), .command_code(command_code),
        .command_parameter(command_parameter), .new_command(new_command), .stop(stop));

    integer r, k, line, taken, wrong, total;
    reg [31:0] clocks, cordic, pins;
    reg ended, writes;
    reg [14:0] write_to;
    reg [7:0] write_data;

    reg [31:0] e_clocks, e_cordic, e_pins;
    reg [7:0] e_stop;
    reg [F-1:0] e_xi, e_yj, e_vmax, e_amax, e_dz, e_n, e_x0, e_y0, e_vx, e_vy, e_ax, e_ay, e_pc, e_z, e_z0, e_p,
                e_vz, e_az, e_x, e_y, e_zr, e_x2, e_y2;
    task check_line;
        begin
            {e_clocks, e_cordic, e_pins, e_stop, e_xi, e_yj, e_vmax, e_amax, e_dz, e_n, e_x0, e_y0, e_vx, e_vy,
             e_ax, e_ay, e_pc, e_z, e_z0, e_p, e_vz, e_az, e_x, e_y, e_zr, e_x2, e_y2} = expected[line];
            if (clocks !== e_clocks || cordic !== e_cordic || pins !== e_pins || stop !== e_stop[4:0]
                || processor.registers.xi !== e_xi[W-1:0] || processor.registers.yj !== e_yj[W-1:0]
                || processor.registers.vmax !== e_vmax[W-1:0] || processor.registers.amax !== e_amax[W-1:0]
                || processor.registers.dz !== e_dz[W-1:0] || processor.registers.n !== e_n[31:0]
                || processor.registers.x0 !== e_x0[W-1:0] || processor.registers.y0 !== e_y0[W-1:0]
                || processor.registers.vx !== e_vx[W-1:0] || processor.registers.vy !== e_vy[W-1:0]
                || processor.registers.ax !== e_ax[W-1:0] || processor.registers.ay !== e_ay[W-1:0]
                || processor.registers.pc !== e_pc[15:0] || processor.registers.z !== e_z[W-1:0]
                || processor.registers.z0 !== e_z0[W-1:0] || processor.registers.p !== e_p[31:0]
                || processor.registers.vz !== e_vz[W-1:0] || processor.registers.az !== e_az[W-1:0]
                || processor.arithmetic.x !== e_x[W-1:0] || processor.arithmetic.y !== e_y[W-1:0]
                || processor.arithmetic.z !== e_zr[W-1:0] || processor.arithmetic.x2 !== e_x2[W-1:0]
                || processor.arithmetic.y2 !== e_y2[W-1:0]) begin
                wrong = wrong + 1;
                if (wrong < 10)
                    $display("run %0d, instruction %0d, opcode %h: clock %0d, expected %0d; stop %0d, %0d; pins %h, %h",
                             r, line, processor.ir, clocks, e_clocks, stop, e_stop, pins, e_pins);
            end
            line = line + 1;
        end
    endtask

    reg [7:0] r_kind, r_code;
    reg [31:0] r_clocks, r_parameter;
    reg [9*BITS-1:0] r_record;
    task check_record(input kind);
        begin
            {r_kind, r_clocks, r_code, r_parameter, r_record} = records[taken];
            if (r_kind !== {7'd0, kind} || r_clocks !== clocks
                || (kind ? command_code !== r_code || command_parameter !== r_parameter : record !== r_record)) begin
                wrong = wrong + 1;
                if (wrong < 10) $display("run %0d, record %0d, clock %0d: %h", r, taken, clocks, record);
            end
            taken = taken + 1;
        end
    endtask

    // A clock: the pins as they are before its edge, registers and records as they are behind it.
    task tick;
        begin
            #1 ended = processor.ends;
            cordic = cordic + (processor.arithmetic.turns || processor.arithmetic.correct);
            pins = {pins[30:0], pins[31]} ^ {12'd0, ale, !psen_n, !rd_n, !wr_n, p2, p0_drives ? p0_out : 8'd0};
            writes = !wr_n && address[15];
            write_to = address[14:0];
            write_data = p0_out;
            clk = 1;
            #1 if (writes) memory[write_to] = write_data;
            clocks = clocks + 1;
            if (!reset) begin
                if (set_point) check_record(1'b0);
                if (new_command) check_record(1'b1);
                if (ended || stop != 0) check_line;
            end
            clk = 0;
        end
    endtask

    initial begin
        for (k = 0; k < PAGE_COUNT * 32768; k = k + 1) rom[k] = 8'hff;
        $readmemh("program.hex", rom);
        $readmemh("expected.hex", expected);
        $readmemh("records.hex", records);
        clk = 0;
        line = 0;
        taken = 0;
        wrong = 0;
        total = 0;
        for (r = 0; r < RUNS; r = r + 1) begin
            case (r)
PAGES                default: ;
            endcase
            for (k = 0; k < 32768; k = k + 1) memory[k] = 8'hff;
            reset = 1;
            tick;
            reset = 0;
            clocks = 0;
            cordic = 0;
            pins = 0;
            while (stop == 0 && clocks < MOST_CLOCKS) tick;
            total = total + clocks;
        end
        if (wrong == 0 && line == LINES && taken == RECORD_TOTAL)
            $display("PASS %0d instructions, %0d clocks, %0d set-points and commands", INSTRUCTIONS, total, taken);
        else begin
            $display("FAIL %0d of %0d lines, %0d of %0d records", wrong, LINES, taken, RECORD_TOTAL);
            $fatal(1);    // the simulator's exit code is not 0
        end
        $finish;
    end
endmodule
)";

constexpr std::string_view sequencer_bench_text = R"(module micro_sequencer_tb;
    localparam COUNT = VECTOR_COUNT;
    reg [55:0] vectors [0:COUNT-1];     // op, pass, branch, map, vector, fault, depth, counter, next
    reg clk, reset;
    reg [3:0] op;
    reg [3:0] pass;
    reg [7:0] branch, map, vector;
    wire [7:0] next, counter;
    wire [2:0] depth;
    wire [1:0] fault;
    reg [1:0] met;
    reg [3:0] e_fault, e_depth;
    reg [7:0] e_counter, e_next;
    integer n, wrong;

    micro_sequencer sequencer (.clk(clk), .reset(reset), .enable(1'b1), .op(op), .pass(pass[0]), .branch(branch),
                               .map(map), .vector(vector), .next(next), .counter(counter), .depth(depth),
                               .fault(fault));

    initial begin
        $readmemh("sequencer.hex", vectors);
        clk = 0;
        wrong = 0;
        reset = 1;
        #1 clk = 1;
        #1 clk = 0;
        reset = 0;
        for (n = 0; n < COUNT; n = n + 1) begin
            {op, pass, branch, map, vector, e_fault, e_depth, e_counter, e_next} = vectors[n];
            #1 met = fault;
            if (next !== e_next) wrong = wrong + 1;
            clk = 1;
            #1 if (met !== e_fault[1:0] || depth !== e_depth[2:0] || counter !== e_counter) wrong = wrong + 1;
            clk = 0;
        end
)";

} // namespace

ProcessorVectors processor_vectors(const Verilog& verilog,
                                   const ProcessorSettings& settings,
                                   std::span<const Image> programs,
                                   std::int64_t most_clocks) {
    constexpr std::size_t bytes_per_line = 32;
    ProcessorVectors vectors;
    Trace trace(verilog, vectors);
    int page = 0;
    for (const Image& image : programs) {
        Processor processor(settings, image);
        trace.run(processor, most_clocks);
        fmt::format_to(std::back_inserter(vectors.program), "@{:x}", page * rom_size);
        for (std::size_t n = 0; n < image.code.size(); ++n) {
            vectors.program += n % bytes_per_line == 0 ? '\n' : ' ';
            fmt::format_to(std::back_inserter(vectors.program), "{:02x}", image.code[n]);
        }
        vectors.program += '\n';
        vectors.first_pages.push_back(page);
        vectors.pages.push_back(processor.memory().pages());
        page += processor.memory().pages();
    }
    if (page > most_pages) {
        throw Error(fmt::format("the programs have {} pages, but the test bench holds {}", page, most_pages));
    }
    return vectors;
}

std::string processor_bench(const Verilog& verilog,
                            const NumberFormat& format,
                            const ProcessorSettings& settings,
                            const ProcessorVectors& vectors) {
    std::string pages;
    for (std::size_t n = 0; n < vectors.pages.size(); ++n) {
        pages += fmt::format("                {}: begin first_page = {}; last_page = {}; end\n",
                             n,
                             vectors.first_pages[n],
                             vectors.pages[n] - 1);
    }
    constexpr std::int64_t spare_clocks = 1000;
    std::string text =
        verilog.head("Compares gcode_processor with the model, clock by clock; prints PASS or FAIL.") +
        std::string(bench_text);
    replace_all(text, "PAGES", pages);
    replace_all(text, "PAGE_COUNT", std::to_string(vectors.first_pages.back() + vectors.pages.back()));
    replace_all(text, "RUN_COUNT", std::to_string(vectors.pages.size()));
    replace_all(text, "LINE_COUNT", std::to_string(vectors.lines));
    replace_all(text, "RECORD_COUNT", std::to_string(std::max<std::int64_t>(vectors.record_count, 1)));
    replace_all(text, "RECORD_TOTAL", std::to_string(vectors.record_count));
    replace_all(text, "CLOCK_COUNT", std::to_string(vectors.most_clocks + spare_clocks));
    replace_all(text, "INSTRUCTIONS", std::to_string(vectors.instructions));
    replace_all(text, "WAITS", std::to_string(settings.wait_states));
    replace_all(text, "FIELD", std::to_string(field_bits(verilog)));
    replace_all(text, "BITS", std::to_string(8 * immediate_bytes(format)));
    replace_all(text, "WIDTH", std::to_string(verilog.word()));
    return text;
}

std::string sequencer_vectors(std::int64_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto byte = [&] { return static_cast<std::uint8_t>(random()); };
    SequencerState state;
    std::string text;
    for (std::int64_t n = 0; n < count; ++n) {
        // Small counts and the last address come up often: what the operations do there differs.
        const auto op = static_cast<MicroOp>(random() % micro_op_count);
        const std::uint64_t kind = random() % 4;
        const SequencerInputs in{.pass = random() % 2 != 0,
                                 .branch = kind == 0   ? std::uint8_t{0xff}
                                           : kind == 1 ? static_cast<std::uint8_t>(random() % 3)
                                                       : byte(),
                                 .map = byte(),
                                 .vector = byte()};
        step(state, op, in);
        fmt::format_to(std::back_inserter(text),
                       "{:x}{:x}{:02x}{:02x}{:02x}{:x}{:x}{:02x}{:02x}\n",
                       static_cast<int>(op),
                       in.pass ? 1 : 0,
                       in.branch,
                       in.map,
                       in.vector,
                       static_cast<int>(state.fault),
                       state.depth,
                       state.counter,
                       state.address);
    }
    return text;
}

std::string sequencer_bench(const Verilog& verilog, std::int64_t count) {
    std::string text = verilog.head("Compares micro_sequencer with the model; prints PASS or FAIL.") +
                       std::string(sequencer_bench_text) + bench_verdict("operations");
    replace_all(text, "VECTOR_COUNT", std::to_string(count));
    return text;
}

} // namespace millwright::cordic::internal
