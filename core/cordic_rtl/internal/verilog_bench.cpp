#include "core/cordic/kernel.h"
#include "core/cordic_rtl/internal/verilog.h"

#include <fmt/format.h>

#include <iterator>
#include <random>
#include <string_view>

namespace millwright::cordic::internal {

namespace {

/// What differs between the benches.
struct Bench {
    std::string_view module;
    std::string_view wires;    ///< declarations, with the instance of the module
    std::string_view compares; ///< drives every vector and checks every result
};

/// Sets the inputs, compares the outputs with what a vector expects, gives a clock.
constexpr std::string_view tasks = R"(
    task drive(input integer k);
        begin
            vectoring = vectors[k][6*F+4];
            x_in = vectors[k][6*F-1 -: F];
            y_in = vectors[k][5*F-1 -: F];
            z_in = vectors[k][4*F-1 -: F];
        end
    endtask
    task check(input integer k);
        reg [W-1:0] ex, ey, ez;
        begin
            ex = vectors[k][3*F-1 -: F];
            ey = vectors[k][2*F-1 -: F];
            ez = vectors[k][F-1 -: F];
            if (x !== ex || y !== ey || z !== ez || overflow !== vectors[k][6*F]) begin
                wrong = wrong + 1;
                if (wrong < 10) $display("vector %0d: %h %h %h %b", k, x, y, z, overflow);
            end
        end
    endtask
    task tick;
        begin
            #1 clk = 1;
            #1 clk = 0;
        end
    endtask
)";

std::string bench_of(const Verilog& verilog, std::int64_t count, const Bench& bench) {
    std::string text = verilog.head(
        fmt::format("Compares {} with the vectors of the model; prints PASS or FAIL.", bench.module));
    text += fmt::format(R"(module {}_tb;
    localparam W = {};
    localparam F = {};         // bits of a field in vectors.hex
    localparam CLOCKS = {};
    localparam COUNT = {};

    reg [6*F+7:0] vectors [0:COUNT-1];
    reg clk, vectoring;
    reg signed [W-1:0] x_in, y_in, z_in;
    wire signed [W-1:0] x, y, z;
    wire overflow;
    integer n, wrong;
)",
                        bench.module,
                        verilog.word(),
                        4 * verilog.digits(),
                        verilog.sequence().clock_count(),
                        count);
    text += bench.wires;
    text += tasks;
    text += R"(
    initial begin
        $readmemh("vectors.hex", vectors);
        clk = 0;
        wrong = 0;
)";
    text += bench.compares;
    return text + bench_verdict("vectors");
}

} // namespace

std::string bench_verdict(std::string_view what) {
    return fmt::format(R"(        if (wrong == 0) $display("PASS %0d {}", COUNT);
        else begin
            $display("FAIL %0d", wrong);
            $fatal(1);    // the simulator's exit code is not 0
        end
        $finish;
    end
endmodule
)",
                       what);
}

std::string core_bench(const Verilog& verilog, std::int64_t count) {
    return bench_of(verilog,
                    count,
                    {.module = "cordic_core",
                     .wires = R"(    reg reset, start;
    wire busy;

    cordic_core core (.clk(clk), .reset(reset), .start(start), .vectoring(vectoring), .x_in(x_in), .y_in(y_in),
                      .z_in(z_in), .x(x), .y(y), .z(z), .overflow(overflow), .busy(busy));
)",
                     .compares = R"(        start = 0;
        reset = 1;
        tick;
        reset = 0;
        for (n = 0; n < COUNT; n = n + 1) begin
            drive(n);
            start = 1;
            tick;
            start = 0;
            repeat (CLOCKS - 1) tick;
            if (!busy) wrong = wrong + 1;
            tick;
            if (busy) wrong = wrong + 1;
            check(n);
        end
)"});
}

std::string pipeline_bench(const Verilog& verilog, std::int64_t count) {
    return bench_of(verilog,
                    count,
                    {.module = "cordic_pipeline",
                     .wires = R"(    reg valid_in;
    wire valid;

    cordic_pipeline pipeline (.clk(clk), .valid_in(valid_in), .vectoring(vectoring), .x_in(x_in), .y_in(y_in),
                              .z_in(z_in), .x(x), .y(y), .z(z), .overflow(overflow), .valid(valid));
)",
                     .compares = R"(        for (n = 0; n < COUNT + CLOCKS - 1; n = n + 1) begin
            valid_in = n < COUNT;
            if (n < COUNT) drive(n);
            tick;
            if (n >= CLOCKS - 1) begin
                if (!valid) wrong = wrong + 1;
                check(n - CLOCKS + 1);
            end
        end
)"});
}

std::string test_vectors(const Verilog& verilog, std::int64_t count, std::uint64_t seed) {
    constexpr int large_every = 50; // one in so many takes the whole word and mostly overflows
    const Kernel<FixedArithmetic> kernel(verilog.arithmetic(), verilog.sequence());
    std::mt19937_64 random(seed);
    const auto number = [&](int spare) {
        return static_cast<std::int64_t>(random()) >> (largest_word - verilog.word() + spare);
    };
    std::string text;
    for (std::int64_t n = 0; n < count; ++n) {
        const int spare = n % large_every == large_every - 1 ? 0 : 2;
        Vector3<std::int64_t> v{};
        v.x = number(spare);
        v.y = number(spare);
        v.z = number(n % 2 == 0 ? 0 : 2);
        bool overflow = false;
        const auto out = n % 2 == 0 ? kernel.rotated(v, overflow) : kernel.vectored(v, overflow);
        const auto field = [&](std::int64_t value) {
            return verilog.hex(verilog.arithmetic().to_word(value));
        };
        fmt::format_to(std::back_inserter(text),
                       "{}{}{}{}{}{}{}{}\n",
                       n % 2,
                       overflow ? 1 : 0,
                       field(v.x),
                       field(v.y),
                       field(v.z),
                       field(out.x),
                       field(out.y),
                       field(out.z));
    }
    return text;
}

} // namespace millwright::cordic::internal
