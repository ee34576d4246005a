#include "core/cordic/kernel.h"
#include "core/cordic_rtl/internal/verilog_processor.h"

#include <fmt/format.h>

#include <string_view>

namespace millwright::cordic::internal {
namespace {

constexpr std::string_view fold_ports = R"(module pre_cordic (
    input wire WORD x_in,
    input wire WORD y_in,
    output wire WORD x,
    output wire WORD y,
    output wire f1,
    output wire f2,
    output wire overflow
);
)";

constexpr std::string_view pre_text = R"(
    wire [W:0] minus_x = add_sub(1'b1, {W{1'b0}}, x_in);
    assign f1 = y_in >= x_in;
    wire signed [W-1:0] xq = f1 ? y_in : x_in;
    wire signed [W-1:0] yq = f1 ? minus_x[W-1:0] : y_in;
    assign f2 = xq[W-1];
    wire [W:0] minus_xq = add_sub(1'b1, {W{1'b0}}, xq);
    wire [W:0] minus_yq = add_sub(1'b1, {W{1'b0}}, yq);
    assign x = f2 ? minus_xq[W-1:0] : xq;
    assign y = f2 ? minus_yq[W-1:0] : yq;
    assign overflow = (f1 && minus_x[W]) || (f2 && (minus_xq[W] || minus_yq[W]));
endmodule

module post_cordic (
    input wire WORD x_in,
    input wire WORD y_in,
    input wire f1,
    input wire f2,
    output wire WORD x,
    output wire WORD y,
    output wire overflow
);
)";

constexpr std::string_view post_text = R"(
    wire [W:0] minus_y = add_sub(1'b1, {W{1'b0}}, y_in);
    wire signed [W-1:0] xq = f1 ? minus_y[W-1:0] : x_in;
    wire signed [W-1:0] yq = f1 ? x_in : y_in;
    wire [W:0] minus_xq = add_sub(1'b1, {W{1'b0}}, xq);
    wire [W:0] minus_yq = add_sub(1'b1, {W{1'b0}}, yq);
    assign x = f2 ? minus_xq[W-1:0] : xq;
    assign y = f2 ? minus_yq[W-1:0] : yq;
    assign overflow = (f1 && minus_y[W]) || (f2 && (minus_xq[W] || minus_yq[W]));
endmodule
)";

constexpr std::string_view unit_ports = R"(module arithmetic_unit (
    input wire clk,
    input wire reset,
    input wire run,
    input wire [CONTROLS-1:0] control,
    input wire clockwise,
    input wire chords_left,
    input wire WORD xi,
    input wire WORD yj,
    input wire WORD vmax,
    input wire WORD amax,
    input wire WORD dz,
    input wire WORD x0,
    input wire WORD y0,
    input wire WORD height,      // register Z
    input wire WORD z0,
    input wire stores_z0,        // a MOV or LD of Z0
    input wire WORD number,      // what it loads
    output reg WORD xe,
    output reg WORD ye,
    output reg WORD ze,
    output wire WORD vx,         // with unfold_speed
    output wire WORD vy,
    output wire WORD ax,
    output wire WORD ay,
    output wire WORD vz,         // with unfold_rise
    output wire WORD az,
    output wire overflow,
    output wire no_speed,
    output wire arc_too_coarse
);
)";

constexpr std::string_view normaliser = R"(
    // Bits that a and b need, the larger of the two, without their sign.
    function [6:0] width_of(input signed [W-1:0] a, input signed [W-1:0] b);
        reg [W-1:0] m;
        integer k;
        begin
            m = (a ^ {W{a[W-1]}}) | (b ^ {W{b[W-1]}});
            width_of = 0;
            for (k = 0; k < W; k = k + 1) if (m[k]) width_of = k + 1;
        end
    endfunction

    // How far to shift so that vectoring has all digits of the word and cannot overflow.
    function signed [7:0] normalising(input [6:0] used);
        normalising = (used == 0) ? 8'sd0 : W - 3 - used;
    endfunction

    function signed [W-1:0] normalised(input signed [W-1:0] v, input signed [7:0] by);
        reg [5:0] back;
        begin
            back = -by;
            normalised = (by < 0) ? shifted(v, back) : v <<< by;
        end
    endfunction
)";

constexpr std::string_view fold_text = R"(
    reg signed [W-1:0] x, y, z, x2, y2, rise, bearing;
    reg f1, f2, standing, upright;
    reg [5:0] step;
    reg [3:0] fix;               // correction

    // The subtractor of end and start, and Pre (figures 3.3, 4.4, 4.5).
    wire [W:0] dx = add_sub(1'b1, fold_radius ? x0 : xe, fold_radius ? xi : x0);
    wire [W:0] dy = add_sub(1'b1, fold_radius ? y0 : ye, fold_radius ? yj : y0);
    wire [W:0] dh = add_sub(1'b1, ze, z0);
    wire signed [W-1:0] px, py;
    wire pf1, pf2, pre_overflow;
    pre_cordic pre (.x_in(dx[W-1:0]), .y_in(dy[W-1:0]), .x(px), .y(py), .f1(pf1), .f2(pf2),
                    .overflow(pre_overflow));
    wire folds = fold_radius || fold_move || fold_space;
    wire nowhere = px == 0 && py == 0;
    wire signed [7:0] in_plane = normalising(width_of(px, py));
    wire signed [7:0] of_rise = normalising(width_of(dh[W-1:0], dh[W-1:0]));
    wire by_rise = fold_space && dh[W-1:0] != 0 && (nowhere || of_rise < in_plane);
    wire signed [7:0] by = fold_radius ? 8'sd0 : by_rise ? of_rise : in_plane;
    wire [W:0] minus_dz = add_sub(1'b1, {W{1'b0}}, dz);
    assign arc_too_coarse = fold_radius && (dz > DZ_MOST || dz < DZ_LEAST || !chords_left);
    assign no_speed = load_speed && !(vmax > 0 && amax > 0);

    // Post (figure 3.4), for speed or radius and for the acceleration.
    wire signed [W-1:0] qx, qy, q2x, q2y;
    wire post_overflow, post2_overflow;
    post_cordic post (.x_in(x), .y_in(y), .f1(f1), .f2(f2), .x(qx), .y(qy), .overflow(post_overflow));
    post_cordic post2 (.x_in(x2), .y_in(y2), .f1(f1), .f2(f2), .x(q2x), .y(q2y), .overflow(post2_overflow));
    assign vx = upright ? {W{1'b0}} : qx;
    assign vy = upright ? {W{1'b0}} : qy;
    assign ax = upright ? {W{1'b0}} : q2x;
    assign ay = upright ? {W{1'b0}} : q2y;
    assign vz = standing ? {W{1'b0}} : y;
    assign az = standing ? {W{1'b0}} : y2;
    wire [W:0] end_x = add_sub(1'b0, qx, xi);
    wire [W:0] end_y = add_sub(1'b0, qy, yj);
    wire [W:0] end_z = add_sub(1'b0, z0, height);
)";

constexpr std::string_view step_head = R"(
    // The iteration (figure 3.2): a step shifts the other coordinate, a correction its own.
    wire [6:0] n = correct ? STEPS + {3'd0, fix} : {1'b0, step};
    reg [5:0] s;
    reg [W-1:0] angle;
    reg corrects, subtracts;
    always @* begin
        s = 0;
        angle = 0;
        corrects = 0;
        subtracts = 0;
        case (n)
)";

constexpr std::string_view step_text = R"(            default: ;
        endcase
    end
    wire turns = rotate || vector;
    wire plus = vector ? y[W-1] : !z[W-1];
    wire signed [W-1:0] xs = shifted(correct ? x : y, s);
    wire signed [W-1:0] ys = shifted(correct ? y : x, s);
    wire signed [W-1:0] x2s = shifted(correct ? x2 : y2, s);
    wire signed [W-1:0] y2s = shifted(correct ? y2 : x2, s);
    wire less_x = correct ? subtracts : plus;
    wire less_y = correct ? subtracts : !plus;
    wire [W:0] xt = add_sub(less_x, x, xs);
    wire [W:0] yt = add_sub(less_y, y, ys);
    wire [W:0] zt = add_sub(plus, z, angle);
    wire [W:0] x2t = add_sub(less_x, x2, x2s);
    wire [W:0] y2t = add_sub(less_y, y2, y2s);
)";

/// What a correction makes of a coordinate: the same adders, or a multiplier.
constexpr std::string_view added_corrections = R"(    wire [W:0] xc = corrects ? xt : {1'b0, x};
    wire [W:0] yc = corrects ? yt : {1'b0, y};
    wire [W:0] x2c = corrects ? x2t : {1'b0, x2};
    wire [W:0] y2c = corrects ? y2t : {1'b0, y2};
)";
constexpr std::string_view multiplied_corrections = R"(    wire [W:0] xc = scaled(x);
    wire [W:0] yc = scaled(y);
    wire [W:0] x2c = scaled(x2);
    wire [W:0] y2c = scaled(y2);
)";

constexpr std::string_view overflow_text = R"(
    wire step_overflow = xt[W] || yt[W] || zt[W] || (rotate_both && (x2t[W] || y2t[W]));
    wire fix_overflow = xc[W] || yc[W] || (correct_both && (x2c[W] || y2c[W]));
    assign overflow = correct ? fix_overflow : turns ? step_overflow :
                      (folds && (dx[W] || dy[W] || pre_overflow)) || (fold_space && dh[W])
                   || (fold_radius && clockwise && minus_dz[W])
                   || (unfold_radius && (post_overflow || end_x[W] || end_y[W]))
                   || (unfold_speed && (post_overflow || post2_overflow)) || (add_rise && end_z[W]);

    always @(posedge clk) begin
        if (reset) begin
            {x, y, z, x2, y2, rise, bearing, xe, ye, ze} <= 0;
            {f1, f2, standing, upright, step, fix} <= 0;
        end else if (run) begin
            if (correct) begin
                fix <= fix + 4'd1;
                x <= xc[W-1:0];
                y <= yc[W-1:0];
                if (correct_both) begin
                    x2 <= x2c[W-1:0];
                    y2 <= y2c[W-1:0];
                end
            end else if (turns) begin
                step <= step + 6'd1;
                x <= xt[W-1:0];
                y <= yt[W-1:0];
                z <= zt[W-1:0];
                if (rotate_both) begin
                    x2 <= x2t[W-1:0];
                    y2 <= y2t[W-1:0];
                end
            end
)";

constexpr std::string_view unit_registers_text =
    R"(            if (folds || fold_rise || load_speed || unfold_rise) begin
                step <= 0;
                fix <= 0;
            end
            if (folds) begin
                x <= normalised(px, by);
                y <= normalised(py, by);
                z <= !fold_radius ? {W{1'b0}} : clockwise ? minus_dz[W-1:0] : dz;
                f1 <= pf1;
                f2 <= pf2;
            end
            if (fold_move || fold_space) begin
                upright <= nowhere;
                standing <= nowhere && (fold_move || dh[W-1:0] == 0);
            end
            if (fold_space) rise <= normalised(dh[W-1:0], by);
            if (fold_rise) begin
                bearing <= z;
                if (upright) x <= 0;
                y <= rise;
                z <= 0;
            end
            if (load_speed) begin
                x <= vmax;
                y <= 0;
                x2 <= HALVES ? shifted(amax, 6'd1) : amax;
                y2 <= 0;
            end
            if (unfold_rise) begin
                y <= 0;
                y2 <= 0;
                z <= bearing;
            end
            if (unfold_radius) begin
                xe <= end_x[W-1:0];
                ye <= end_y[W-1:0];
            end
            if (take_end) begin
                xe <= xi;
                ye <= yj;
            end
            if (add_rise) ze <= end_z[W-1:0];
            if (take_height) ze <= height;
            if (stores_z0) ze <= number;
        end
    end
endmodule
)";

Kernel<FixedArithmetic> kernel_of(const Verilog& verilog) {
    return {verilog.arithmetic(), verilog.sequence()};
}

/// Whether the steps turn by the least number of the word, whose opposite it does not have.
bool turns_by_least(const Verilog& verilog) {
    return kernel_of(verilog).reach_of_rotation(-verilog.arithmetic().largest() - 1) == Reach::inside;
}

/// The largest angle of a chord that the steps turn by, as the kernel judges it.
std::int64_t largest_chord_angle(const Verilog& verilog) {
    const Kernel<FixedArithmetic> kernel = kernel_of(verilog);
    std::int64_t inside = 0;
    std::int64_t step = std::int64_t{1} << (verilog.word() - 2);
    for (; step > 0; step /= 2) {
        if (inside + step <= verilog.arithmetic().largest() &&
            kernel.reach_of_rotation(inside + step) == Reach::inside) {
            inside += step;
        }
    }
    return inside;
}

} // namespace

std::string fold_modules(const Verilog& verilog) {
    return verilog.head("PreCORDIC and PostCORDIC (figures 3.3 and 3.4): exact quarter turns.") +
           verilog.filled(fold_ports) + verilog.functions() + verilog.filled(pre_text) + verilog.functions() +
           std::string(post_text);
}

std::string arithmetic_module(const Verilog& verilog, bool halves_acceleration) {
    std::string text = verilog.head("Arithmetic unit: lines and arcs by one iteration (figure 4.6).") +
                       verilog.filled(unit_ports) + verilog.functions() + control_wires() +
                       std::string(normaliser);
    const std::int64_t most = largest_chord_angle(verilog);
    text += fmt::format(
        "\n    // Angles of a chord that the steps turn by.\n"
        "    localparam signed [W-1:0] DZ_MOST = {0}'h{1};\n"
        "    localparam signed [W-1:0] DZ_LEAST = {0}'h{2};\n"
        "    localparam HALVES = {3};\n",
        verilog.word(),
        verilog.hex(static_cast<Word>(most)),
        verilog.hex(static_cast<Word>(turns_by_least(verilog) ? -verilog.arithmetic().largest() - 1 : -most)),
        halves_acceleration ? 1 : 0);
    text += std::string(fold_text) + verilog.filled(step_head) + verilog.step_cases();
    text += step_text;
    text += verilog.sequence().multiplies ? multiplied_corrections : added_corrections;
    text += std::string(overflow_text) + std::string(unit_registers_text);
    replace_all(text, "CONTROLS", std::to_string(control_count));
    return text;
}

} // namespace millwright::cordic::internal
