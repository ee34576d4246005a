#include "core/cordic_rtl/internal/verilog.h"

#include <fmt/format.h>

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

} // namespace millwright::cordic::internal
