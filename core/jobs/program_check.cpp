#include "core/jobs/program_check.h"

#include "core/base/units.h"
#include "core/drivers/mdi_lines.h"
#include "core/gcode/interpreter.h"
#include "core/jobs/internal/program_check_sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::jobs {

namespace {

using gcode::AxisValues;
using internal::ProgramCheckSink;

constexpr double seconds_per_minute = 60.0;
constexpr double rounding = 1e-6; // mm or rad: of positions that went through texts and units

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

void take_start(ProgramCheck& found, const ProgramCheckSettings& settings) {
    for (Eigen::Index n = 0; n < settings.start.size() && n < std::ssize(settings.axes); ++n) {
        found.start[index_of(settings.axes[static_cast<std::size_t>(n)].letter)] = settings.start[n];
    }
}

/// From the lowest place of an axis to its highest, as long as it is known where the axis stands before.
void check_length(const drivers::MachineLimits::Axis& axis,
                  ProgramCheck::Range range,
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
                  const ProgramCheckSink& sink,
                  ProgramCheck& found) {
    gcode::ModalState before = reader.state();
    ProgramCheck::Range z = found.ranges[index_of('Z')];
    bool knows_height = sink.knows_height();
    for (bool more = true; more;) {
        more = reader.step();
        const int line = reader.place().line;
        const bool again = !found.watched.empty() && found.watched.back().line == line;
        if (!again && std::ranges::binary_search(lines, line)) {
            found.watched.push_back({line, before, z, knows_height});
        }
        before = reader.state();
        z = found.ranges[index_of('Z')];
        knows_height = sink.knows_height();
    }
}

gcode::ReaderSettings reading_of(const std::filesystem::path& file, const ProgramCheckSettings& settings) {
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

void read_into(ProgramCheck& found,
               std::string_view text,
               const std::filesystem::path& file,
               gcode::ReaderSettings reading,
               bool keep_path,
               const std::vector<int>& watched = {}) {
    ProgramCheckSink sink(found, reading.start, keep_path);
    gcode::Interpreter reader(text, file, std::move(reading), sink);
    if (watched.empty()) {
        reader.run();
    } else {
        run_watching(reader, watched, sink, found);
    }
    found.errors = reader.errors();
    found.unread_lines.clear();
    for (const Diagnostic& error : found.errors) {
        if (error.place.file == file && error.place.line > 0) {
            found.unread_lines.push_back(error.place.line);
        }
    }
    std::ranges::sort(found.unread_lines);
    found.unread_lines.erase(std::unique(found.unread_lines.begin(), found.unread_lines.end()),
                             found.unread_lines.end());
    const int last = reader.place().file == 0 ? reader.place().line : 0;
    const bool ended_by_it = !found.unread_lines.empty() && found.unread_lines.back() == last;
    found.unread_from = ended_by_it ? last : 0;
}

bool moves(const ProgramCheck::Range& range) {
    return range.moved_line > 0;
}

/// Of axes that move in `found` and are not the controller's.
std::string foreign_axes(const ProgramCheck& found, const std::string& there) {
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

Diagnostic missing_axes_fault(const ProgramCheck& of,
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
void add_missing_axes(ProgramCheck& found,
                      std::string_view text,
                      const std::filesystem::path& file,
                      const ProgramCheckSettings& settings) {
    if (settings.axes.empty()) {
        return;
    }
    const std::string there = letters_of(settings.axes);
    if (settings.dialect == gcode::Dialect::grbl && !found.errors.empty()) {
        ProgramCheck of_all;
        take_start(of_all, settings);
        gcode::ReaderSettings reading = reading_of(file, settings);
        reading.grbl_axes.assign(gcode::axis_letters.begin(), gcode::axis_letters.end());
        read_into(of_all, text, file, std::move(reading), settings.keep_path, settings.watched);
        if (foreign_axes(of_all, there).empty()) {
            return;
        }
        found = std::move(of_all); // its ranges are those of the whole program
    }
    found.missing_axes = foreign_axes(found, there);
    if (!found.missing_axes.empty()) {
        found.errors.insert(found.errors.begin(),
                            missing_axes_fault(found, found.missing_axes, there, file, settings.dialect));
    }
}

/// "line 5", "lines 5, 7 and 9"
std::string lines_text(const std::vector<int>& lines) {
    constexpr std::size_t named_at_most = 5;
    if (lines.size() > named_at_most) {
        return fmt::format("{} lines, the first is line {}", lines.size(), lines.front());
    }
    std::string text = lines.size() == 1 ? "line" : "lines";
    for (std::size_t n = 0; n < lines.size(); ++n) {
        text += n == 0 ? " " : n + 1 == lines.size() ? " and " : ", ";
        text += std::to_string(lines[n]);
    }
    return text;
}

} // namespace

std::string unread_text(const ProgramCheck& program_check) {
    std::vector<int> lines = program_check.unread_lines;
    std::string rest;
    if (program_check.unread_from > 0) {
        std::erase(lines, program_check.unread_from);
        rest = fmt::format("everything from line {} on", program_check.unread_from);
    }
    return lines.empty() ? rest : lines_text(lines) + (rest.empty() ? "" : " and " + rest);
}

ProgramCheck check_program(std::string_view text,
                           const std::filesystem::path& file,
                           const ProgramCheckSettings& settings) {
    ProgramCheck found;
    take_start(found, settings);
    read_into(found, text, file, reading_of(file, settings), settings.keep_path, settings.watched);
    add_missing_axes(found, text, file, settings);
    return found;
}

std::vector<Diagnostic> faults_of(const ProgramCheck& program_check,
                                  const drivers::MachineLimits& limits,
                                  const std::filesystem::path& file) {
    std::vector<Diagnostic> faults = program_check.errors;
    for (const drivers::MachineLimits::Axis& axis : limits.axes) {
        const std::size_t index = index_of(axis.letter);
        const ProgramCheck::Range& range = program_check.ranges[index];
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
            check_length(axis, range, program_check.start[index], file, faults);
        }
    }
    return faults;
}

std::vector<Diagnostic> warnings_of(const ProgramCheck& program_check,
                                    const drivers::MachineLimits& limits,
                                    const std::filesystem::path& file) {
    std::vector<Diagnostic> warnings;
    const auto warn = [&](int line, std::string sentence, std::string hint = {}) {
        warnings.push_back({{file, line, 0, -1}, std::move(sentence), std::move(hint)});
    };
    if (!program_check.tools.empty()) {
        std::string list;
        for (const int tool : program_check.tools) {
            list += fmt::format("{}T{}", list.empty() ? "" : ", ", tool);
        }
        warn(0, "the program uses tools " + list, "have them ready");
    }
    if (program_check.first_cut_line > 0 && !program_check.spindle_before_cut) {
        warn(program_check.first_cut_line, "the first cut comes before the spindle is started");
    }
    double fastest = 0.0;
    for (const drivers::MachineLimits::Axis& axis : limits.axes) {
        fastest = std::hypot(fastest, axis.speed.value_or(std::numeric_limits<double>::infinity()));
    }
    if (!limits.axes.empty() && program_check.greatest_feed > fastest) {
        warn(program_check.greatest_feed_line,
             fmt::format(
                 "the feed of {:.0f} mm/min exceeds the machine's maximum in any direction, {:.0f} mm/min",
                 program_check.greatest_feed * seconds_per_minute,
                 fastest * seconds_per_minute),
             "the machine will be slower");
    }
    if (limits.spindle_rpm && program_check.greatest_spindle_rpm > *limits.spindle_rpm) {
        warn(0,
             fmt::format("the program requests {:.0f} rpm, but the spindle reaches only {:.0f} rpm",
                         program_check.greatest_spindle_rpm,
                         *limits.spindle_rpm));
    }
    return warnings;
}

std::optional<Diagnostic> feeds_not_reached(const Job& job) {
    expects(job.program != nullptr && job.machine != nullptr, "a job with a program has a machine");
    constexpr double rounding = 1.0 + 1e-6;
    std::optional<Diagnostic> first;
    int count = 0;
    const kinematics::AxisPositions* from = &job.program->start;
    for (int n = 0; n < job.program->block_count(); ++n) {
        const program::Block& block = job.program->blocks[static_cast<std::size_t>(n)];
        for (int axis = 0; axis < job.machine->axis_count() && block.kind == program::BlockKind::feed;
             ++axis) {
            const kinematics::MachineAxis& limits = job.machine->axis(axis);
            const double way = std::abs(block.target[axis] - (*from)[axis]);
            if (!(way > limits.max_velocity * block.duration * rounding)) {
                continue;
            }
            if (++count == 1) {
                first = {{job.project, job.listing->line_of_block[static_cast<std::size_t>(n)], 0, -1},
                         fmt::format("{:.0f} mm/min exceeds the maximum speed of axis {}",
                                     60.0 * block.feed,
                                     limits.letter),
                         "the machine will be slower"};
            }
            break;
        }
        from = &block.target;
    }
    if (count > 1) {
        first->message += fmt::format(", and so do {} later feeds", count - 1);
    }
    return first;
}

} // namespace millwright::jobs
