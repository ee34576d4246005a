#include "core/gcode/reader/cut_program.h"

#include "core/base/units.h"
#include "core/gcode/plot_program.h"
#include "core/gcode/reader/interpreter.h"
#include "core/gcode/reader/machine_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace millwright::gcode {

namespace {

constexpr double same_place = 1e-9;  // mm: rounding of offsets
constexpr double same_height = 1e-6; // mm: of turned and scaled programs

/// X, Y and Z without limits: what a path has.
kinematics::MachineModel path_machine() {
    kinematics::MachineDescription description;
    description.name = "X, Y, Z";
    for (int n = 0; n < 3; ++n) {
        kinematics::MachineAxis axis;
        axis.letter = "XYZ"[n];
        axis.direction = Vec3::Unit(n);
        axis.max_velocity = 1.0; // nothing is planned for it
        axis.max_acceleration = 1.0;
        description.head.push_back(axis);
    }
    return kinematics::MachineModel(std::move(description));
}

void throw_first(const std::vector<Diagnostic>& found) {
    if (!found.empty()) {
        throw Error(found.front());
    }
}

/// A tool without a diameter would leave the contour where it is.
void expect_known_diameter(const Interpreter& interpreter, const std::filesystem::path& file) {
    const CutterCompensation& cutter = interpreter.state().cutter;
    if (cutter.on() && !(cutter.radius > 0.0)) {
        throw Error(Diagnostic{.place = {.file = file, .line = interpreter.place().line},
                               .message = "the cutter is compensated for, and nobody told its diameter",
                               .hint = "give the tool table: --tools"});
    }
}

/// The feed as it was programmed, without what dividing by the time left of it.
double speed_of(const Block& block) {
    constexpr double steps = 1e9; // a mm/min
    return from_mm_per_min(std::round(to_mm_per_min(block.feed) * steps) / steps);
}

bool moves_across(const Vec3& from, const Vec3& to) {
    return (to - from).head<2>().norm() > same_place;
}

/// The blocks of a program, and which tool each change brings: they do not say.
class ProgramAndTools final : public CanonSink {
public:
    ProgramAndTools(const kinematics::MachineModel& machine,
                    const std::filesystem::path& file,
                    const CutProgramSettings& settings)
        : builder_(machine,
                   file,
                   {.chord_tolerance = settings.chord_tolerance,
                    .chord_length = settings.chord_length,
                    .most_blocks = most_program_points}) {}

    void move(const Move& move, const SourceLine& now) override { builder_.move(move, now); }
    void curve(const Curve& curve, const SourceLine& now) override { builder_.curve(curve, now); }
    void command(const Command& command, const SourceLine& now) override {
        if (command.kind == CommandKind::select_tool) {
            selected_ = command.index;
        } else if (command.kind == CommandKind::change_tool) {
            tools_[static_cast<std::size_t>(builder_.block_count())] = selected_;
        }
        builder_.command(command, now);
    }

    [[nodiscard]] MachineProgram take() { return builder_.take(); }
    /// That block `n` brings; 0: none.
    [[nodiscard]] int tool_of(std::size_t n) const {
        const auto found = tools_.find(n);
        return found == tools_.end() ? 0 : found->second;
    }

private:
    MachineProgramBuilder builder_;
    int selected_ = 0;
    std::map<std::size_t, int> tools_; ///< by block
};

/// From the blocks of a program to what a plot has.
class CutProgramBuilder {
public:
    CutProgramBuilder(const Program& program,
                      std::filesystem::path file,
                      const std::optional<double>& safe_height)
        : file_(std::move(file)), at_(program.start) {
        find_safe_height(program, safe_height);
    }

    /// `tool`: that a change brings; 0: nobody said.
    void add(const Block& block, int tool) {
        switch (block.kind) {
        case BlockKind::rapid:
        case BlockKind::feed:
            return move(block);
        case BlockKind::pause:
            if (block.pause == PauseKind::tool_change) {
                return change_tool(tool);
            }
            return leave_out(block, "stops for a person");
        case BlockKind::dwell:
            made_.dwell_time += block.duration;
            return leave_out(block, "dwells");
        case BlockKind::coolant_on:
            return leave_out(block, "coolant");
        case BlockKind::spindle_on:
            return turn_spindle(block);
        case BlockKind::coolant_off:
        case BlockKind::spindle_off:
        case BlockKind::comment:
        case BlockKind::end:
            return;
        }
    }

    CutProgram take() {
        close_stroke();
        std::ranges::for_each(strokes_, [this](const Stroke& stroke) { see_from_above(stroke); });
        made_.end = at_.head<2>();
        for (const auto& [what, first] : left_out_) {
            made_.notices.push_back(
                {.place = {.file = file_, .line = first.line},
                 .message = fmt::format("a path has no {}: left out{}",
                                        what,
                                        first.count > 1 ? fmt::format(" {} times", first.count) : ""),
                 .hint = {}});
        }
        return std::move(made_);
    }

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

    /// By the rapids across whose height is known. Nothing is in the air that would be all there is.
    void find_safe_height(const Program& program, const std::optional<double>& given) {
        std::optional<double> travel;
        double lowest_feed = std::numeric_limits<double>::infinity();
        bool told = false;
        Vec3 from = program.start;
        for (const Block& block : program.blocks) {
            if (!block.moves()) {
                continue;
            }
            const Vec3 to = block.target;
            const double low = std::min(from.z(), to.z());
            const bool across = moves_across(from, to);
            if (block.kind == BlockKind::feed) {
                lowest_feed = std::min(lowest_feed, low);
            } else if (across && told) {
                travel = std::max(travel.value_or(low), low);
            }
            told = told || block.named.contains(2);
            from = to;
        }
        made_.safe_height = given ? given : travel && *travel > lowest_feed ? travel : std::nullopt;
    }

    [[nodiscard]] bool in_the_air(double z) const {
        return made_.safe_height && z >= *made_.safe_height - same_place;
    }

    /// Where the tool stood before the program nobody knows: the path begins where it names all three axes,
    /// or cuts.
    void move(const Block& block) {
        const Vec3 to = block.target;
        if (made_.path.empty()) {
            if (block.kind == BlockKind::rapid) {
                return approach(block);
            }
            begin(block);
        }
        if (!((to - at_).norm() > 0.0)) {
            return;
        }
        if (block.kind == BlockKind::rapid) {
            close_stroke();
            append(to, 0.0, plot::CutMove::rapid);
        } else {
            feed(to, block);
        }
        at_ = to;
    }

    void approach(const Block& block) {
        const Vec3 to = block.target;
        if (!((to - at_).norm() > 0.0)) {
            return; // G0 alone in the head of a program
        }
        at_ = to;
        for (int axis = 0; axis < 3; ++axis) {
            if (block.named.contains(axis)) {
                told_.insert(axis);
            }
        }
        if (told_ == AxisSet::all(3)) {
            append(at_, 0.0, plot::CutMove::rapid);
        }
    }

    /// With the first feed; from above where no rapid told the height.
    void begin(const Block& first_feed) {
        if (told_.contains(2)) {
            return append(at_, 0.0, plot::CutMove::rapid);
        }
        constexpr double usual = 5.0;
        append({at_.x(), at_.y(), std::max(made_.safe_height.value_or(usual), at_.z())},
               0.0,
               plot::CutMove::rapid);
        append(at_, speed_of(first_feed), plot::CutMove::plunge);
    }

    void feed(const Vec3& to, const Block& block) {
        const double speed = speed_of(block);
        made_.feed_time += block.duration;
        const bool down = to.z() < at_.z();
        if (!moves_across(at_, to)) {
            close_stroke();
            append(to, speed, down ? plot::CutMove::plunge : plot::CutMove::retract);
            if (down) {
                stroke_ = Stroke{{to}, tool_, block.source_line, speed, speed};
            }
            return;
        }
        if (in_the_air(std::min(at_.z(), to.z()))) {
            close_stroke();
            return append(to, speed, plot::CutMove::rapid);
        }
        append(to, speed, plot::CutMove::cut);
        if (!stroke_) {
            stroke_ = Stroke{{at_}, tool_, block.source_line, speed, speed};
        } else if (stroke_->points.size() == 1) {
            stroke_->line = block.source_line;
            stroke_->cutting = speed;
        }
        stroke_->points.push_back(to);
    }

    /// A way down that nothing follows is a dot; of several at a place the deepest.
    void close_stroke() {
        if (!stroke_) {
            return;
        }
        Stroke stroke = std::move(*stroke_);
        stroke_.reset();
        if (stroke.points.size() > 1 || strokes_.empty()) {
            if (stroke.points.size() > 1 || !in_the_air(stroke.points.front().z())) {
                strokes_.push_back(std::move(stroke));
            }
            return;
        }
        const Vec3& at = stroke.points.front();
        Stroke& before = strokes_.back();
        const bool again = before.points.size() == 1 && before.tool == stroke.tool &&
                           !moves_across(before.points.front(), at);
        if (again) {
            before = before.points.front().z() > at.z() ? std::move(stroke) : before;
        } else if (!in_the_air(at.z())) {
            strokes_.push_back(std::move(stroke));
        }
    }

    void change_tool(int tool) {
        close_stroke();
        tool_ = tool > 0 ? tool : tool_;
        if (!made_.path.empty() && made_.path.back().tool != tool_) {
            append(at_, 0.0, plot::CutMove::tool_change);
        }
    }

    void turn_spindle(const Block& block) {
        if (!(block.spindle_rpm > 0.0 || block.spindle_rpm < 0.0)) {
            return;
        }
        if (!(made_.spindle_rpm > 0.0)) {
            made_.spindle_rpm = std::abs(block.spindle_rpm);
        }
        if (std::abs(block.spindle_rpm) > made_.spindle_rpm ||
            std::abs(block.spindle_rpm) < made_.spindle_rpm) {
            leave_out(block, "second speed of the spindle");
        }
        if (block.spindle_rpm < 0.0) {
            leave_out(block, "spindle that turns backwards");
        }
    }

    void leave_out(const Block& block, const char* what) {
        LeftOut& found = left_out_[what];
        found.line = found.count++ == 0 ? block.source_line : found.line;
    }

    void append(const Vec3& to, double speed, plot::CutMove move) {
        made_.path.push_back({.at = to, .speed = speed, .move = move, .tool = tool_});
    }

    /// The pen of a tool and a height, in millionths of a millimetre; without one of all that has none.
    int pen_of(const Stroke& stroke, const std::optional<double>& z) {
        constexpr double steps = 1e6;
        const auto key = std::pair(stroke.tool, z ? std::optional(std::llround(*z * steps)) : std::nullopt);
        const auto [found, is_new] = pens_.try_emplace(key, static_cast<int>(pens_.size()) + 1);
        if (is_new) {
            made_.levels.push_back({found->second, stroke.tool, z, stroke.cutting, stroke.plunging});
        }
        return found->second;
    }

    void see_from_above(const Stroke& stroke) {
        const auto [low, high] =
            std::ranges::minmax(stroke.points, {}, [](const Vec3& point) { return point.z(); });
        std::optional<double> z = low.z();
        if (high.z() - low.z() > same_height) {
            z.reset();
            if (!made_.uneven) {
                made_.uneven = Diagnostic{
                    .place = {.file = file_, .line = stroke.line},
                    .message = fmt::format("this cut goes from z {:.3f} to {:.3f} mm", high.z(), low.z()),
                    .hint = {}};
            }
        }
        plot::Stroke drawn;
        drawn.pen = pen_of(stroke, z);
        for (const Vec3& point : stroke.points) {
            drawn.points.emplace_back(point.head<2>());
        }
        made_.strokes.push_back(std::move(drawn));
    }

    std::filesystem::path file_;
    CutProgram made_;
    Vec3 at_;
    AxisSet told_; ///< axes that some rapid has named
    int tool_ = 1;
    std::optional<Stroke> stroke_; ///< that is being cut; of one point as long as the tool went down alone
    std::vector<Stroke> strokes_;
    std::map<std::pair<int, std::optional<long long>>, int> pens_;
    std::map<std::string, LeftOut> left_out_;
};

/// A word of G-code is a letter and a number, of a parameter # and one or its name; a program's number may
/// have a colon before it. Commands of HPGL have two letters.
bool begins_with_word(std::string_view line) {
    constexpr std::string_view letters = "NGMTFSOXYZ#:";
    if (line.empty() || letters.find(static_cast<char>(std::toupper(static_cast<unsigned char>(line[0])))) ==
                            std::string_view::npos) {
        return false;
    }
    const auto number = line.find_first_not_of(" \t", 1);
    return number != std::string_view::npos &&
           std::string_view("0123456789.+-#[<").find(line[number]) != std::string_view::npos;
}

ReaderSettings reader_settings(const CutProgramSettings& settings) {
    ReaderSettings reading;
    reading.tools = settings.tools.value_or(ToolTable());
    reading.any_tool = !settings.tools;
    reading.block_delete = settings.block_delete;
    return reading;
}

CutProgram made_of(const MachineProgram& read,
                   const ProgramAndTools& tools,
                   const std::filesystem::path& file,
                   const CutProgramSettings& settings) {
    throw_first(read.faults);
    throw_first(read.lost);
    CutProgramBuilder cut(read.program, file, settings.safe_height);
    for (std::size_t n = 0; n < read.program.blocks.size(); ++n) {
        cut.add(read.program.blocks[n], tools.tool_of(n));
    }
    CutProgram made = cut.take();
    made.notices.insert(made.notices.begin(), read.simplified.begin(), read.simplified.end());
    if (made.strokes.empty()) {
        throw Error(made.safe_height
                        ? fmt::format("there is nothing to cut in it below z {:.3f} mm", *made.safe_height)
                        : "there is nothing to cut in it",
                    file);
    }
    return made;
}

/// `begin` makes the interpreter for a sink.
template <class Begin>
CutProgram
read_by(const Begin& begin, const std::filesystem::path& file, const CutProgramSettings& settings) {
    const kinematics::MachineModel machine = path_machine();
    ProgramAndTools sink(machine, file, settings);
    Interpreter interpreter = begin(sink);
    while (interpreter.step()) {
        expect_known_diameter(interpreter, file);
    }
    throw_first(interpreter.errors());
    CutProgram made = made_of(sink.take(), sink, file, settings);
    made.lines = interpreter.line_count();
    return made;
}

} // namespace

CutProgram read_cut_program(std::string_view text,
                            const std::filesystem::path& file,
                            const CutProgramSettings& settings) {
    return read_by([&](CanonSink& sink) { return Interpreter(text, file, reader_settings(settings), sink); },
                   file,
                   settings);
}

CutProgram read_cut_program_file(const std::filesystem::path& file, const CutProgramSettings& settings) {
    return read_by(
        [&](CanonSink& sink) { return Interpreter(file, reader_settings(settings), sink); }, file, settings);
}

bool is_gcode(std::string_view text) {
    while (!text.empty()) {
        const auto end = std::min(text.find_first_of("\r\n"), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const auto first = line.find_first_not_of(" \t/");
        line.remove_prefix(std::min(first, line.size()));
        if (!line.empty() && line != "%" && line.front() != ';' && line.front() != '(') {
            return begins_with_word(line);
        }
    }
    return false;
}

} // namespace millwright::gcode
