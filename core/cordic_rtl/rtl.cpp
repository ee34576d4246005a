#include "core/cordic_rtl/rtl.h"

#include "core/cordic_rtl/internal/verilog.h"

#include <fmt/format.h>

#include <cstdlib>

namespace millwright::cordic {

Error no_hardware_of(const NumberFormat& format) {
    return Error(fmt::format("hardware can only be generated for fixed point, not for {}", to_text(format)),
                 {},
                 "use a format such as q2.22, for which a shift is a wire; floating point would need an "
                 "adder that aligns, normalises and rounds in each step, which is not generated");
}

std::vector<RtlFile> make_rtl(const NumberFormat& format,
                              const Sequence& sequence,
                              std::int64_t vector_count,
                              std::uint64_t seed) {
    if (format.kind != NumberKind::fixed) {
        throw no_hardware_of(format);
    }
    expects(vector_count > 0, "a test bench has vectors");
    const internal::Verilog verilog(format, sequence);
    return {{"cordic_core.v", internal::core_module(verilog)},
            {"cordic_pipeline.v", internal::pipeline_module(verilog)},
            {"cordic_core_tb.v", internal::core_bench(verilog, vector_count)},
            {"cordic_pipeline_tb.v", internal::pipeline_bench(verilog, vector_count)},
            {"vectors.hex", internal::test_vectors(verilog, vector_count, seed)}};
}

} // namespace millwright::cordic

namespace millwright::cordic::internal {

namespace {

/// Shift, angle and kind of each step and correction, by the counter.
std::string selection(const Verilog& verilog) {
    return fmt::format(R"(
    localparam STEPS = {};
    localparam CLOCKS = {};

    reg [6:0] n;
    reg vectors;
    reg [5:0] s;           // shift of this step or correction
    reg [W-1:0] angle;
    reg corrects, subtracts;
    assign busy = n < CLOCKS;

    always @* begin
        s = 0;
        angle = 0;
        corrects = 0;
        subtracts = 0;
        case (n)
{}            default: ;
        endcase
    end
)",
                       verilog.sequence().step_count,
                       verilog.sequence().clock_count(),
                       verilog.step_cases());
}

constexpr std::string_view clocked = R"(
    always @(posedge clk) begin
        if (reset) begin
            n <= CLOCKS;
            overflow <= 0;
        end else if (start) begin
            n <= 0;
            vectors <= vectoring;
            x <= x_in;
            y <= y_in;
            z <= z_in;
            overflow <= 0;
        end else if (n < STEPS) begin
            n <= n + 1'b1;
            x <= xt[W-1:0];
            y <= yt[W-1:0];
            z <= zt[W-1:0];
            overflow <= overflow | xt[W] | yt[W] | zt[W];
        end else if (busy) begin
            n <= n + 1'b1;
            x <= xc[W-1:0];
            y <= yc[W-1:0];
            overflow <= overflow | xc[W] | yc[W];
        end
    end
endmodule
)";

} // namespace

std::string core_module(const Verilog& verilog) {
    const Sequence& sequence = verilog.sequence();
    std::string text = verilog.head("CORDIC, one step or correction per clock.");
    text += R"(module cordic_core (
    input wire clk,
    input wire reset,
    input wire start,
    input wire vectoring,
)" + verilog.inputs() +
            verilog.outputs("reg") + R"(    output reg overflow,
    output wire busy
);
)" + verilog.functions();
    text += selection(verilog);
    text += R"(
    wire signed [W-1:0] xs = shifted(x, s);
    wire signed [W-1:0] ys = shifted(y, s);
    wire plus = vectors ? y[W-1] : !z[W-1]; // turns counter-clockwise
)";
    text += verilog.turned({.x = "x",
                            .y = "y",
                            .z = "z",
                            .shifted_x = "xs",
                            .shifted_y = "ys",
                            .plus = "plus",
                            .angle = "angle",
                            .next_x = "xt",
                            .next_y = "yt",
                            .next_z = "zt"});
    text += sequence.multiplies ? "    wire [W:0] xc = scaled(x);\n    wire [W:0] yc = scaled(y);\n"
                                : "    wire [W:0] xc = !corrects ? {1'b0, x} : add_sub(subtracts, x, xs);\n"
                                  "    wire [W:0] yc = !corrects ? {1'b0, y} : add_sub(subtracts, y, ys);\n";
    text += clocked;
    return text;
}

namespace {

/// From register `n` to the wires in front of the next: a step of the iteration.
std::string pipeline_step(const Verilog& verilog, int n) {
    const auto name = [&](const char* text) { return fmt::format("{}{}", text, n); };
    const auto shifted = [&](const char* text) {
        return fmt::format("shifted({}{}, {})", text, n, verilog.shift(n));
    };
    return fmt::format("    wire p{0} = v{0} ? y{0}[W-1] : !z{0}[W-1];\n", n) +
           verilog.turned({.x = name("x"),
                           .y = name("y"),
                           .z = name("z"),
                           .shifted_x = shifted("x"),
                           .shifted_y = shifted("y"),
                           .plus = name("p"),
                           .angle = verilog.angle(n),
                           .next_x = name("xt"),
                           .next_y = name("yt"),
                           .next_z = name("zt")});
}

/// What a correction makes of x or y.
std::string corrected(const Verilog& verilog, int n, char axis) {
    if (verilog.sequence().multiplies) {
        return fmt::format("scaled({}{})", axis, n);
    }
    const int a = verilog.correction(n - verilog.sequence().step_count);
    return a == 0 ? fmt::format("{{1'b0, {}{}}}", axis, n)
                  : fmt::format("add_sub({0}, {1}{2}, shifted({1}{2}, {3}))",
                                a < 0 ? "1'b1" : "1'b0",
                                axis,
                                n,
                                std::abs(a));
}

std::string pipeline_correction(const Verilog& verilog, int n) {
    return fmt::format("    wire [W:0] xt{0} = {1};\n    wire [W:0] yt{0} = {2};\n"
                       "    wire [W:0] zt{0} = {{1'b0, z{0}}};\n",
                       n,
                       corrected(verilog, n, 'x'),
                       corrected(verilog, n, 'y'));
}

/// Register `n` + 1 takes what is in front of it.
std::string stage_register(int n) {
    return fmt::format(
        "    always @(posedge clk) begin\n"
        "        x{1} <= xt{0}[W-1:0];\n        y{1} <= yt{0}[W-1:0];\n        z{1} <= zt{0}[W-1:0];\n"
        "        v{1} <= v{0};\n        o{1} <= o{0} | xt{0}[W] | yt{0}[W] | zt{0}[W];\n"
        "        k{1} <= k{0};\n    end\n",
        n,
        n + 1);
}

} // namespace

std::string pipeline_module(const Verilog& verilog) {
    const int clocks = verilog.sequence().clock_count();
    std::string text = verilog.head("CORDIC, a vector in and one out in each clock.");
    text += R"(module cordic_pipeline (
    input wire clk,
    input wire valid_in,
    input wire vectoring,
)" + verilog.inputs() +
            verilog.outputs("wire") + R"(    output wire overflow,
    output wire valid
);
)" + verilog.functions() +
            R"(
    wire signed [W-1:0] x0 = x_in;
    wire signed [W-1:0] y0 = y_in;
    wire signed [W-1:0] z0 = z_in;
    wire v0 = vectoring;
    wire o0 = 1'b0;
    wire k0 = valid_in;
)";
    for (int n = 0; n < clocks; ++n) {
        text += fmt::format("\n    reg signed [W-1:0] x{0}, y{0}, z{0};\n    reg v{0}, o{0}, k{0};\n", n + 1);
        text +=
            n < verilog.sequence().step_count ? pipeline_step(verilog, n) : pipeline_correction(verilog, n);
        text += stage_register(n);
    }
    text += fmt::format(
        "\n    assign x = x{0};\n    assign y = y{0};\n    assign z = z{0};\n    assign overflow = o{0};\n"
        "    assign valid = k{0};\nendmodule\n",
        clocks);
    return text;
}

} // namespace millwright::cordic::internal
