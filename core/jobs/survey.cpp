#include "core/jobs/survey.h"

#include "core/base/units.h"
#include "core/drivers/hand_lines.h"
#include "core/gcode/canon_frame.h"
#include "core/gcode/interpreter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace millwright::jobs {

namespace {

using gcode::AxisValues;
using gcode::Command;
using gcode::CommandKind;
using gcode::Move;
using gcode::MoveKind;

constexpr double seconds_per_minute = 60.0;
constexpr double still = 1e-9;    // mm or rad: less is no motion
constexpr double rounding = 1e-6; // mm or rad: of positions that went through texts and units

class Surveyor final : public gcode::CanonSink {
public:
    Surveyor(Survey& found, const AxisValues& start, bool keep_path)
        : found_(found), at_(start), keep_path_(keep_path) {}

    void move(const Move& move, const gcode::SourceLine&) override {
        const AxisValues begin = frame_.from_machine(at_);
        const bool cuts = move.kind != MoveKind::traverse && move.kind != MoveKind::probe;
        if (cuts) {
            cut(move.source.line);
        }
        found_.probes = found_.probes || move.kind == MoveKind::probe;
        if (move.kind == MoveKind::arc) {
            take_arc(begin, move);
        }
        go(move.target, move.source.line, cuts);
    }

    void curve(const gcode::Curve& curve, const gcode::SourceLine&) override {
        cut(curve.source.line);
        AxisValues point = frame_.from_machine(at_);
        for (const gcode::ControlPoint& corner : curve.points) { // the curve lies within their hull
            point[gcode::Axis::x] = corner.x;
            point[gcode::Axis::y] = corner.y;
            go(point, curve.source.line, true);
        }
    }

    void command(const Command& command, const gcode::SourceLine&) override {
        frame_.command(command);
        switch (command.kind) {
        case CommandKind::set_feed_rate:
            take_feed(command);
            break;
        case CommandKind::set_spindle_speed:
            found_.greatest_spindle_rpm = std::max(found_.greatest_spindle_rpm, command.value);
            break;
        case CommandKind::start_spindle_clockwise:
        case CommandKind::start_spindle_counterclockwise:
            turning_ = true;
            break;
        case CommandKind::stop_spindle_turning:
            turning_ = false;
            break;
        case CommandKind::select_tool:
            if (std::ranges::find(found_.tools, command.index) == found_.tools.end()) {
                found_.tools.push_back(command.index);
            }
            break;
        default:
            break;
        }
    }

    /// Whether a move so far went rapidly to another Z, or up from a lower one of the moves.
    [[nodiscard]] bool knows_height() const { return knows_height_; }

private:
    Survey& found_;
    gcode::CanonFrame frame_;
    AxisValues at_; ///< machine, mm and degrees
    bool turning_ = false;
    bool keep_path_ = false;
    bool knows_height_ = false;

    void cut(int line) {
        if (found_.first_cut_line == 0) {
            found_.first_cut_line = line;
            found_.spindle_before_cut = turning_;
        }
        widen(found_.cuts, line);
    }

    void take_feed(const Command& command) {
        const double feed = command.value * frame_.unit() / seconds_per_minute;
        if (feed > found_.greatest_feed) {
            found_.greatest_feed = feed;
            found_.greatest_feed_line = command.source.line;
        }
    }

    void go(const AxisValues& target, int line, bool cuts) {
        const double z_before = at_[gcode::Axis::z];
        at_ = frame_.to_machine(target);
        const double z = at_[gcode::Axis::z];
        const bool other_z = std::abs(z - z_before) > still;
        const Survey::Range& range = found_.ranges[static_cast<std::size_t>(gcode::Axis::z)];
        knows_height_ = knows_height_ || (other_z && !cuts) || (!range.empty() && z > range.min + still);
        if (keep_path_) {
            using gcode::Axis;
            found_.path.push_back({line, Vec3(at_[Axis::x], at_[Axis::y], at_[Axis::z])});
        }
        widen(found_.ranges, line);
        if (cuts) {
            widen(found_.cuts, line);
        }
    }

    /// By where the machine is.
    void widen(std::array<Survey::Range, gcode::axis_count>& ranges, int line) const {
        for (std::size_t n = 0; n < gcode::axis_count; ++n) {
            const double value = gcode::is_rotary(n) ? from_degrees(at_[n]) : at_[n];
            Survey::Range& range = ranges[n];
            if (range.moved_line == 0 && std::abs(value) > still) {
                range.moved_line = line;
            }
            if (value < range.min) {
                range.min = value;
                range.min_line = line;
            }
            if (value > range.max) {
                range.max = value;
                range.max_line = line;
            }
        }
    }

    /// The points where an arc comes farthest along the axes of its plane.
    void take_arc(const AxisValues& begin, const Move& move) {
        using gcode::Axis;
        using gcode::Plane;
        const auto [first, second] = move.plane == Plane::xz   ? std::pair{Axis::z, Axis::x}
                                     : move.plane == Plane::yz ? std::pair{Axis::y, Axis::z}
                                                               : std::pair{Axis::x, Axis::y};
        const double x = begin[first] - move.centre_1;
        const double y = begin[second] - move.centre_2;
        const double radius = std::hypot(x, y);
        const double from = std::atan2(y, x);
        constexpr double quarter = 0.5 * std::numbers::pi;
        constexpr double step = quarter / 16.0; // the quarters themselves, and near enough where XY is turned
        const double low = std::min(from, from + move.sweep);
        const double high = std::min(std::max(from, from + move.sweep), low + 4.0 * quarter);
        AxisValues point = begin;
        for (double angle = std::ceil(low / step) * step; angle <= high; angle += step) {
            point[first] = move.centre_1 + radius * std::cos(angle);
            point[second] = move.centre_2 + radius * std::sin(angle);
            go(point, move.source.line, true);
        }
    }
};

std::string in_people_units(char letter, double value) {
    const bool rotary = letter >= 'A' && letter <= 'C';
    return fmt::format("{:.3f} {}", rotary ? to_degrees(value) : value, rotary ? "deg" : "mm");
}

std::size_t index_of(char letter) {
    return static_cast<std::size_t>(std::ranges::find(gcode::axis_letters, letter) -
                                    gcode::axis_letters.begin());
}

AxisValues values_by_letter(const kinematics::AxisPositions& axes,
                            const std::vector<program::ProgramAxis>& letters) {
    AxisValues values;
    for (Eigen::Index n = 0; n < axes.size() && n < std::ssize(letters); ++n) {
        const program::ProgramAxis& axis = letters[static_cast<std::size_t>(n)];
        values[index_of(axis.letter)] =
            axis.kind == kinematics::AxisKind::rotary ? to_degrees(axes[n]) : axes[n];
    }
    return values;
}

/// XYZ where the machine's axes are not known.
std::string letters_of(const std::vector<program::ProgramAxis>& axes) {
    std::string letters;
    for (const program::ProgramAxis& axis : axes) {
        letters += axis.letter;
    }
    return letters.empty() ? gcode::ReaderSettings().grbl_axes : letters;
}

void take_start(Survey& found, const SurveySettings& settings) {
    for (Eigen::Index n = 0; n < settings.start.size() && n < std::ssize(settings.axes); ++n) {
        found.start[index_of(settings.axes[static_cast<std::size_t>(n)].letter)] = settings.start[n];
    }
}

/// From the lowest place of an axis to its highest, as long as it is known where the axis stands before.
void check_length(const drivers::MachineLimits::Axis& axis,
                  Survey::Range range,
                  std::optional<double> start,
                  const std::filesystem::path& file,
                  std::vector<Diagnostic>& faults) {
    if (start && *start < range.min) {
        range.min = *start;
        range.min_line = 0;
    }
    if (start && *start > range.max) {
        range.max = *start;
        range.max_line = 0;
    }
    const double way = range.max - range.min;
    if (way <= *axis.travel + rounding) {
        return;
    }
    const bool up = range.max_line >= range.min_line; // the later end is the one that is too far
    faults.push_back({{file, up ? range.max_line : range.min_line, 0, -1},
                      fmt::format("axis {} would move from {} to {} in machine coordinates, a distance of "
                                  "{}, but its travel is only {}",
                                  axis.letter,
                                  in_people_units(axis.letter, up ? range.min : range.max),
                                  in_people_units(axis.letter, up ? range.max : range.min),
                                  in_people_units(axis.letter, way),
                                  in_people_units(axis.letter, *axis.travel)),
                      "check the unit, the program, and the travel configured in the controller"});
}

/// LinuxCNC's number of the first of the nine parameters of a stored offset; 0 for others.
int first_parameter(std::string_view name) {
    constexpr int first_system = 5221;
    constexpr int stride = 20;
    for (int system = 1; system <= 9; ++system) {
        if (name == drivers::work_system_name(system)) {
            return first_system + stride * (system - 1);
        }
    }
    return name == "G28" ? 5161 : name == "G30" ? 5181 : name == "G92" ? 5211 : 0;
}

/// Line by line, with a look at what is in force before some of them.
void run_watching(gcode::Interpreter& reader,
                  const std::vector<int>& lines,
                  const Surveyor& surveyor,
                  Survey& found) {
    gcode::ModalState before = reader.state();
    Survey::Range z = found.ranges[index_of('Z')];
    bool knows_height = surveyor.knows_height();
    for (bool more = true; more;) {
        more = reader.step();
        const int line = reader.place().line;
        const bool again = !found.watched.empty() && found.watched.back().line == line;
        if (!again && std::ranges::binary_search(lines, line)) {
            found.watched.push_back({line, before, z, knows_height});
        }
        before = reader.state();
        z = found.ranges[index_of('Z')];
        knows_height = surveyor.knows_height();
    }
}

gcode::ReaderSettings reading_of(const std::filesystem::path& file, const SurveySettings& settings) {
    gcode::ReaderSettings reading;
    reading.dialect = settings.dialect;
    reading.any_tool = true;
    reading.start = values_by_letter(settings.start, settings.axes);
    reading.modes = settings.modes;
    reading.mist = settings.mist;
    reading.grbl_name = settings.firmware;
    reading.grbl_axes = letters_of(settings.axes);
    constexpr int most_errors = 100;
    reading.most_errors = most_errors;
    const std::filesystem::path folder = file.parent_path();
    reading.subroutine_folders.push_back(folder.empty() ? "." : folder);
    for (const drivers::StoredOffset& offset : settings.offsets) {
        const AxisValues values = values_by_letter(offset.value, settings.axes);
        const int first = first_parameter(offset.name);
        for (std::size_t n = 0; first > 0 && n < gcode::axis_count; ++n) {
            reading.parameters.emplace_back(first + static_cast<int>(n), values[n]);
        }
        if (offset.name == "TLO") {
            reading.tool_length = values[gcode::Axis::z];
        }
        if (offset.name == "G92") {
            constexpr int g92_active = 5210;
            reading.parameters.emplace_back(g92_active, 1.0);
        }
    }
    return reading;
}

void read_into(Survey& found,
               std::string_view text,
               const std::filesystem::path& file,
               gcode::ReaderSettings reading,
               bool keep_path,
               const std::vector<int>& watched = {}) {
    Surveyor surveyor(found, reading.start, keep_path);
    gcode::Interpreter reader(text, file, std::move(reading), surveyor);
    if (watched.empty()) {
        reader.run();
    } else {
        run_watching(reader, watched, surveyor, found);
    }
    found.errors = reader.errors();
}

bool moves(const Survey::Range& range) {
    return range.moved_line > 0;
}

/// Of axes that move in `found` and are not the controller's.
std::string foreign_axes(const Survey& found, const std::string& there) {
    std::string foreign;
    for (std::size_t n = 0; n < gcode::axis_count; ++n) {
        const char letter = gcode::axis_letters[n];
        const bool is_foreign = moves(found.ranges[n]) && there.find(letter) == std::string::npos;
        foreign.append(is_foreign ? 1 : 0, letter);
    }
    return foreign;
}

/// "A, B and C".
std::string listed(std::string_view letters) {
    std::string text;
    for (std::size_t n = 0; n < letters.size(); ++n) {
        text += n == 0 ? "" : n + 1 == letters.size() ? " and " : ", ";
        text += letters[n];
    }
    return text;
}

Diagnostic missing_axes_fault(const Survey& of,
                              const std::string& missing,
                              const std::string& there,
                              const std::filesystem::path& file,
                              gcode::Dialect dialect) {
    int line = 0;
    for (const char letter : missing) {
        const int moved = of.ranges[index_of(letter)].moved_line;
        line = line == 0 ? moved : std::min(line, moved);
    }
    return {{file, line, 0, -1},
            fmt::format("the program moves {}, but the machine has only {}", listed(missing), listed(there)),
            dialect == gcode::Dialect::linuxcnc
                ? "generate the program for these axes, or specify all axes of LinuxCNC when connecting"
                : "generate the program for these axes, or connect a machine that has all of them"};
}

/// Said of the whole program, before what is wrong with a line: by Grbl's rules the first word of such an
/// axis is refused, and what is behind it is not read. So it is read with all axes again.
void add_missing_axes(Survey& found,
                      std::string_view text,
                      const std::filesystem::path& file,
                      const SurveySettings& settings) {
    if (settings.axes.empty()) {
        return;
    }
    const std::string there = letters_of(settings.axes);
    Survey of_all;
    const bool again = settings.dialect == gcode::Dialect::grbl && !found.errors.empty();
    if (again) {
        gcode::ReaderSettings reading = reading_of(file, settings);
        reading.grbl_axes.assign(gcode::axis_letters.begin(), gcode::axis_letters.end());
        read_into(of_all, text, file, std::move(reading), false);
    }
    const Survey& of = again ? of_all : found;
    found.missing_axes = foreign_axes(of, there);
    if (!found.missing_axes.empty()) {
        found.errors.insert(found.errors.begin(),
                            missing_axes_fault(of, found.missing_axes, there, file, settings.dialect));
    }
}

} // namespace

Survey survey(std::string_view text, const std::filesystem::path& file, const SurveySettings& settings) {
    Survey found;
    take_start(found, settings);
    read_into(found, text, file, reading_of(file, settings), settings.keep_path, settings.watched);
    add_missing_axes(found, text, file, settings);
    return found;
}

std::vector<Diagnostic>
faults_of(const Survey& survey, const drivers::MachineLimits& limits, const std::filesystem::path& file) {
    std::vector<Diagnostic> faults = survey.errors;
    for (const drivers::MachineLimits::Axis& axis : limits.axes) {
        const std::size_t index = index_of(axis.letter);
        const Survey::Range& range = survey.ranges[index];
        const auto outside = [&](double value, int line) {
            faults.push_back(
                {{file, line, 0, -1},
                 fmt::format("axis {} would move to {} in machine coordinates, outside {} ... {}",
                             axis.letter,
                             in_people_units(axis.letter, value),
                             in_people_units(axis.letter, axis.min.value_or(-0.0)),
                             in_people_units(axis.letter, axis.max.value_or(0.0))),
                 "check the work offset and the program"});
        };
        if (!range.empty() && axis.min && range.min < *axis.min - rounding) {
            outside(range.min, range.min_line);
        }
        if (!range.empty() && axis.max && range.max > *axis.max + rounding) {
            outside(range.max, range.max_line);
        }
        if (!range.empty() && axis.travel && !axis.min && !axis.max) {
            check_length(axis, range, survey.start[index], file, faults);
        }
    }
    return faults;
}

std::vector<Diagnostic>
warnings_of(const Survey& survey, const drivers::MachineLimits& limits, const std::filesystem::path& file) {
    std::vector<Diagnostic> warnings;
    const auto warn = [&](int line, std::string sentence, std::string hint = {}) {
        warnings.push_back({{file, line, 0, -1}, std::move(sentence), std::move(hint)});
    };
    if (!survey.tools.empty()) {
        std::string list;
        for (const int tool : survey.tools) {
            list += fmt::format("{}T{}", list.empty() ? "" : ", ", tool);
        }
        warn(0, "the program uses tools " + list, "have them ready");
    }
    if (survey.first_cut_line > 0 && !survey.spindle_before_cut) {
        warn(survey.first_cut_line, "the first cut comes before the spindle is started");
    }
    double fastest = 0.0;
    for (const drivers::MachineLimits::Axis& axis : limits.axes) {
        fastest = std::hypot(fastest, axis.speed.value_or(std::numeric_limits<double>::infinity()));
    }
    if (!limits.axes.empty() && survey.greatest_feed > fastest) {
        warn(survey.greatest_feed_line,
             fmt::format(
                 "the feed of {:.0f} mm/min exceeds the machine's maximum in any direction, {:.0f} mm/min",
                 survey.greatest_feed * seconds_per_minute,
                 fastest * seconds_per_minute),
             "the machine will be slower");
    }
    if (limits.spindle_rpm && survey.greatest_spindle_rpm > *limits.spindle_rpm) {
        warn(0,
             fmt::format("the program requests {:.0f} rpm, but the spindle reaches only {:.0f} rpm",
                         survey.greatest_spindle_rpm,
                         *limits.spindle_rpm));
    }
    return warnings;
}

} // namespace millwright::jobs
