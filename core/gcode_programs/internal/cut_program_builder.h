// From the blocks of a program to what a plot has. Lengths mm, speeds mm/s, times s.
#pragma once

#include "core/gcode_programs/cut_program.h"
#include "core/program/program.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::gcode::internal {

/// Takes the blocks of `program` one after the other; `safe_height` and `file` as read_cut_program().
class CutProgramBuilder {
public:
    CutProgramBuilder(const program::Program& program,
                      std::filesystem::path file,
                      const std::optional<double>& safe_height);

    /// `tool`: that a change brings; 0: unknown.
    void add(const program::Block& block, int tool);
    /// Once, after the last block.
    [[nodiscard]] CutProgram take();

private:
    struct Stroke {
        std::vector<Vec3> points;
        int tool = 1;
        int line = 0; ///< of its first cut
        double cutting = 0.0, plunging = 0.0;
    };
    struct LeftOut {
        int line = 0; ///< of the first
        int count = 0;
    };

    void find_safe_height(const program::Program& program, const std::optional<double>& given);
    [[nodiscard]] bool in_the_air(double z) const;
    void move(const program::Block& block);
    void approach(const program::Block& block);
    void expect_known_place(const program::Block& first_feed);
    void begin(const program::Block& first_feed);
    void feed(const Vec3& to, const program::Block& block);
    void travel_at_feed(const Vec3& to, double speed, int line);
    void close_stroke();
    void change_tool(int tool);
    void turn_spindle(const program::Block& block);
    void leave_out(const program::Block& block, const char* what);
    void append(const Vec3& to, double speed, plot::CutMove move);
    int pen_of(const Stroke& stroke, const std::optional<double>& z);
    void see_from_above(const Stroke& stroke);
    void tell_travel();

    std::filesystem::path file_;
    CutProgram made_;
    Vec3 at_;
    program::AxisSet named_; ///< axes that have been named before the path begins
    int tool_ = 1;
    bool height_was_given_ = false;
    double air_at_feed_ = 0.0;     ///< feeds across that are taken for travel
    int first_air_ = 0;            ///< line of the first
    std::optional<Stroke> stroke_; ///< that is being cut; of one point as long as the tool went down alone
    std::vector<Stroke> strokes_;
    std::map<std::pair<int, std::optional<long long>>, int> pens_;
    std::map<std::string, LeftOut> left_out_;
};

} // namespace millwright::gcode::internal
