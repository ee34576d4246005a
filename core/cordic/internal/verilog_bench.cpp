#include "core/cordic/internal/verilog.h"
#include "core/cordic/kernel.h"

#include <fmt/format.h>

#include <iterator>
#include <random>

namespace millwright::cordic::internal {

std::string test_bench(const Verilog& verilog, std::int64_t count) {
    std::string text =
        verilog.head("Compares core and pipeline with the vectors of the model; prints PASS or FAIL.");
    text += fmt::format(R"(module cordic_tb;
    localparam W = {0};
    localparam F = {1};        // bits of a field in vectors.hex
    localparam CLOCKS = {2};
    localparam COUNT = {3};
    localparam ITERATIVE = COUNT < 2000 ? COUNT : 2000;

    reg [6*F+7:0] vectors [0:COUNT-1];
    reg clk, reset, start, vectoring, valid_in;
    reg signed [W-1:0] x_in, y_in, z_in;
    wire signed [W-1:0] xc, yc, zc, xp, yp, zp;
    wire oc, busy, op, valid;
    integer n, wrong;

    cordic_core core (.clk(clk), .reset(reset), .start(start), .vectoring(vectoring), .x_in(x_in), .y_in(y_in),
                      .z_in(z_in), .x(xc), .y(yc), .z(zc), .overflow(oc), .busy(busy));
    cordic_pipeline pipeline (.clk(clk), .valid_in(valid_in), .vectoring(vectoring), .x_in(x_in), .y_in(y_in),
                              .z_in(z_in), .x(xp), .y(yp), .z(zp), .overflow(op), .valid(valid));

    task drive(input integer k);
        begin
            vectoring = vectors[k][6*F+4];
            x_in = vectors[k][6*F-1 -: F];
            y_in = vectors[k][5*F-1 -: F];
            z_in = vectors[k][4*F-1 -: F];
        end
    endtask
    task check(input integer k, input [W-1:0] x, input [W-1:0] y, input [W-1:0] z, input o);
        reg [W-1:0] ex, ey, ez;
        begin
            ex = vectors[k][3*F-1 -: F];
            ey = vectors[k][2*F-1 -: F];
            ez = vectors[k][F-1 -: F];
            if (x !== ex || y !== ey || z !== ez || o !== vectors[k][6*F]) begin
                wrong = wrong + 1;
                if (wrong < 10) $display("vector %0d: %h %h %h %b", k, x, y, z, o);
            end
        end
    endtask
    task tick;
        begin
            #1 clk = 1;
            #1 clk = 0;
        end
    endtask

    initial begin
        $readmemh("vectors.hex", vectors);
        clk = 0;
        wrong = 0;
        valid_in = 0;
        start = 0;
        reset = 1;
        tick;
        reset = 0;
        for (n = 0; n < ITERATIVE; n = n + 1) begin
            drive(n);
            start = 1;
            tick;
            start = 0;
            repeat (CLOCKS) tick;
            if (busy) wrong = wrong + 1;
            check(n, xc, yc, zc, oc);
        end
        for (n = 0; n < COUNT + CLOCKS - 1; n = n + 1) begin
            valid_in = n < COUNT;
            if (n < COUNT) drive(n);
            tick;
            if (n >= CLOCKS - 1) begin
                if (!valid) wrong = wrong + 1;
                check(n - CLOCKS + 1, xp, yp, zp, op);
            end
        end
        if (wrong == 0) $display("PASS %0d iterative %0d pipelined", ITERATIVE, COUNT);
        else $display("FAIL %0d", wrong);
        $finish;
    end
endmodule
)",
                        verilog.word(),
                        4 * verilog.digits(),
                        verilog.sequence().clock_count(),
                        count);
    return text;
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
