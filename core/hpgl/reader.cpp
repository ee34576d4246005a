#include "core/hpgl/reader.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/hpgl/internal/commands.h"
#include "core/hpgl/internal/line_end_evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace millwright::hpgl {
namespace internal {
namespace {

/// Runs a file through the plotter, command by command.
class Reading {
public:
    /// `settings` must outlive it. `evidence` may be null.
    Reading(std::string_view bytes,
            const std::filesystem::path& file,
            const HpglSettings& settings,
            LineEndEvidence* evidence = nullptr)
        : size_(static_cast<std::int64_t>(bytes.size())), problems_(file, settings),
          lexer_(bytes, arguments_of, problems_), run_(settings, problems_, lexer_, plot_),
          evidence_(evidence) {}

    Plot read() {
        while (const auto command = lexer_.next()) {
            execute(*command);
        }
        if (run_.pen.in_polygon()) {
            problems_.add(size_, "the file ends in the middle of a polygon", "end the polygon with PM2");
        }
        run_.pen.finish(plot_, size_);
        for (const plot::Stroke& stroke : plot_.strokes) {
            plot_.pens.try_emplace(stroke.pen, run_.usual);
        }
        plot_.diagnostics = problems_.take();
        plot_.more_diagnostics = problems_.more();
        return std::move(plot_);
    }

private:
    void execute(const Command& command) {
        run_.pen.byte = command.byte;
        const CommandRow* row = command.name.empty() ? nullptr : find_command(command.name);
        if (row == nullptr) {
            if (!command.name.empty()) {
                problems_.add(command.byte, fmt::format("{} is not an HPGL command", command.name));
            }
            lose();
            return;
        }
        ++plot_.commands;
        if (row->follow == nullptr) {
            leave_out(*row, command.byte);
            return;
        }
        const bool followed = follow(*row, command);
        if (!followed) {
            keep_safe(row->name);
        }
        if (row->places) {
            run_.misplace(row->name, !followed);
        }
        if (!followed && (row->moves || row->places)) {
            lose();
        }
    }

    /// What is known of a command that could not be followed, so that nothing behind it is drawn otherwise.
    void keep_safe(std::string_view name) {
        if (name == "SP") {
            run_.pen.put_away(); // what follows was meant for an unknown pen
        } else if (name == "PU") {
            run_.pen.lift(); // wherever it was to go
        } else if (name == "PR" || name == "PA") {
            run_.modes.relative = name == "PR"; // the numbers behind it are meant so
        }
    }

    bool follow(const CommandRow& row, const Command& command) {
        if (row.arguments != Arguments::numbers && row.arguments != Arguments::character) {
            numbers_.clear();
        } else if (!take_numbers(row, command)) {
            if (row.name == "PM" && !run_.pen.in_polygon()) {
                run_.pen.open_polygon(); // its corners may follow, and are no moves
            }
            return false;
        }
        const Pen::Mark before = run_.pen.mark();
        if (row.moves && !command.terminated && !numbers_.empty()) {
            if (!follow_cut_off(row, command)) {
                return false;
            }
        } else {
            row.follow(run_, {.command = command, .numbers = numbers_});
        }
        if (auto why = run_.pen.take_refusal()) {
            if (row.moves) {
                run_.pen.take_back(before);
            }
            problems_.add(command.byte, std::move(*why));
            return false;
        }
        return true;
    }

    /// The last number of the file may be a part of one. What stands before its point is whole, and the point
    /// is if it closes the stroke. False: nothing is drawn.
    bool follow_cut_off(const CommandRow& row, const Command& command) {
        const bool pairs = row.count.least == 0 && row.count.step == 2;
        const bool some = pairs && numbers_.size() > 2;
        bool closes = false;
        if (some) {
            const std::array<double, 2> last{numbers_[numbers_.size() - 2], numbers_.back()};
            numbers_.resize(numbers_.size() - 2);
            row.follow(run_, {.command = command, .numbers = numbers_});
            const Vec2 point(last[0], last[1]);
            const bool relative = run_.modes.relative;
            closes = run_.pen.would_close(relative ? run_.pen.at() + run_.units.plotter_step(point)
                                                   : run_.units.plotter(point));
            if (closes) {
                row.follow(run_, {.command = command, .numbers = last});
            }
        }
        problems_.add(command.byte,
                      fmt::format("the file ends in the middle of {}", command.name),
                      closes ? "the last point closes the stroke and is used"
                      : some ? "the last point may be incomplete and is ignored"
                             : "the last number may be incomplete, so nothing is drawn from it");
        return some;
    }

    bool take_numbers(const CommandRow& row, const Command& command) {
        Command numbers = command;
        if (row.arguments == Arguments::character && !numbers.arguments.empty()) {
            numbers.arguments.remove_prefix(1); // the character, and the comma behind it
            numbers.arguments.remove_prefix(numbers.arguments.starts_with(',') ? 1 : 0);
        }
        if (command.stray) {
            problems_.add(*command.stray,
                          fmt::format("{}: there is a letter in the middle of a number", command.name));
            return false;
        }
        const LineEnds ends = run_.settings.line_ends;
        const auto most = 2 * static_cast<std::size_t>(run_.settings.most_points) + 2;
        auto fault = read_numbers(numbers, ends == LineEnds::join, most, numbers_);
        if (fault && numbers_.size() == most) {
            throw Error(problems_.at(
                fault->byte, "the plot has more points than allowed", "check the file: it may be damaged"));
        }
        if (evidence_ != nullptr && numbers.arguments.find_first_of("\r\n") != std::string_view::npos) {
            evidence_->look_at(numbers, row.count);
        }
        if (fault) {
            problems_.add(fault->byte, fmt::format("{}: {}", command.name, fault->message));
            // Old programs end their lists with a comma; what stands before it is whole.
            if (!(fault->behind_all && command.terminated && row.count.allows(numbers_.size()))) {
                return false;
            }
        }
        if (!row.count.allows(numbers_.size())) {
            problems_.add(
                command.byte,
                fmt::format("{} must not have {}", command.name, counted(numbers_.size(), "number")));
            return false;
        }
        return true;
    }

    void leave_out(const CommandRow& row, std::int64_t byte) {
        const auto known = std::ranges::find(plot_.left_out, row.name, &LeftOut::name);
        if (known != plot_.left_out.end()) {
            ++known->count;
            return;
        }
        plot_.left_out.push_back(
            {.name = std::string(row.name), .why = std::string(row.why), .byte = byte, .count = 1});
    }

    void lose() {
        run_.pen.lose();
        run_.polygon_damaged = run_.polygon_damaged || run_.pen.in_polygon();
    }

    std::int64_t size_;
    Plot plot_;
    Problems problems_;
    Lexer lexer_;
    Run run_;
    LineEndEvidence* evidence_;
    std::vector<double> numbers_;
};

/// Settings that say what line ends mean, and in `notice` what that is, if the file leaves a choice.
HpglSettings with_line_ends(std::string_view bytes,
                            const std::filesystem::path& file,
                            HpglSettings settings,
                            std::optional<Diagnostic>& notice) {
    if (settings.line_ends != LineEnds::automatic) {
        return settings;
    }
    settings.line_ends = LineEnds::separate;
    if (!has_line_end_in_digits(bytes)) {
        return settings;
    }
    LineEndEvidence evidence(bytes);
    HpglSettings looking = settings;
    looking.strictness = Strictness::tolerant;
    static_cast<void>(Reading(bytes, file, looking, &evidence).read());
    if (evidence.count() == 0) {
        return settings;
    }
    const auto meaning = evidence.meaning();
    const Place place{.file = file, .byte = evidence.first_byte()};
    const std::string choose = "set Line ends under Source, or use --line-ends separate or join";
    if (!meaning) {
        throw Error({.place = place,
                     .message = fmt::format("it is not clear from the file whether line ends between two "
                                            "digits separate numbers or wrap them ({}, this is the first)",
                                            evidence.count()),
                     .hint = choose});
    }
    settings.line_ends = *meaning;
    if (*meaning == LineEnds::join || evidence.both_fit()) {
        notice = {.place = place,
                  .message = fmt::format("line ends between two digits {} ({}, this is the first)",
                                         *meaning == LineEnds::join ? "are read as wraps within numbers"
                                                                    : "are read as separators",
                                         evidence.count()),
                  .hint = "if not, " + choose};
    }
    return settings;
}

} // namespace
} // namespace internal

Plot read_hpgl(std::string_view bytes, const std::filesystem::path& file, const HpglSettings& settings) {
    if (auto fault = wide_text_fault(bytes, file)) {
        fault->place = {.file = file, .byte = 0};
        throw Error(std::move(*fault));
    }
    std::optional<Diagnostic> notice;
    const HpglSettings chosen = internal::with_line_ends(bytes, file, settings, notice);
    Plot plot = internal::Reading(bytes, file, chosen).read();
    plot.line_ends = std::move(notice);
    return plot;
}

std::vector<Diagnostic> notices(const Plot& plot, const std::filesystem::path& file) {
    std::vector<Diagnostic> all = plot.diagnostics;
    if (plot.line_ends) {
        all.insert(all.begin(), *plot.line_ends);
    }
    if (plot.more_diagnostics > 0) {
        all.push_back({.place = {.file = file},
                       .message = fmt::format("and {} more", plot.more_diagnostics),
                       .hint = {}});
    }
    for (const LeftOut& left_out : plot.left_out) {
        all.push_back(
            {.place = {.file = file, .byte = left_out.byte},
             .message = fmt::format("{} {} ignored: {}", left_out.count, left_out.name, left_out.why),
             .hint = {}});
    }
    return all;
}

Plot read_hpgl_file(const std::filesystem::path& file, const HpglSettings& settings) {
    return read_hpgl(read_file(file, largest_plot), file, settings);
}

} // namespace millwright::hpgl
