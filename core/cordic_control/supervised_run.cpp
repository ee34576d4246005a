#include "core/cordic_control/supervised_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

namespace millwright::cordic {
namespace {

constexpr double seconds_per_microsecond = 1e-6;

/// What a record asks the motion controller to do.
enum class Task : std::uint8_t { move, dwell, wait_for_start, wait_for_fin, spindle, coolant };

struct Record {
    double available = 0.0; ///< when the processor had handed it over
    Task task = Task::move;
    double seconds = 0.0; ///< of a motion or dwell
    std::array<double, 3> begin{}, end{};
    bool on = false; ///< of spindle and coolant
    PlcBit user = 0; ///< bit of a command of the machine's own
};

double speed_of(const SetPoint<double>& set, const HeightPoint& height) {
    return std::hypot(set.vx, set.vy, height.vz);
}

PlcBit user_bit(const Commanded& command, const SupervisedSettings& settings) {
    const auto bit = plc_bit(fmt::format("U{}", command.parameter));
    if (!bit) {
        const CodeLine at = line_at(settings.lines, command.instruction_at);
        throw Error(Diagnostic{{settings.file, at.line, at.column, -1},
                               fmt::format("M{} is not a user-defined command", command.parameter),
                               "use M100 to M199"});
    }
    return *bit;
}

/// The processor and the queue that it fills.
class Feeder {
public:
    Feeder(Processor& processor, const SupervisedSettings& settings)
        : processor_(processor), settings_(settings), at_(settings.start),
          published_(processor.published().size()), commanded_(processor.commanded().size()) {}

    /// Computes until `end`, or until there is no room.
    void work_until(double end) {
        while (time_ < end && has_room() && processor_.state().stop == Stop::none) {
            const auto budget = static_cast<std::int64_t>(std::ceil((end - time_) * settings_.clock_hz));
            time_ += static_cast<double>(run_to_record(budget)) / settings_.clock_hz;
            take_records();
        }
    }
    [[nodiscard]] bool empty() const { return records_.empty(); }
    [[nodiscard]] const Record& front() const { return records_.front(); }
    /// At `now`, which makes room.
    Record take(double now) {
        time_ = has_room() ? time_ : std::max(time_, now);
        Record record = records_.front();
        records_.pop_front();
        return record;
    }
    [[nodiscard]] bool ended() const { return empty() && processor_.state().stop != Stop::none; }

private:
    [[nodiscard]] bool has_room() const {
        return records_.size() < static_cast<std::size_t>(settings_.records_ahead);
    }
    [[nodiscard]] bool has_new() const {
        return processor_.published().size() != published_ || processor_.commanded().size() != commanded_;
    }
    std::int64_t run_to_record(std::int64_t most) {
        std::int64_t clocks = 0;
        while (clocks < most && processor_.state().stop == Stop::none && !has_new()) {
            processor_.clock();
            ++clocks;
        }
        return clocks;
    }
    void take_records() {
        for (; published_ < processor_.published().size(); ++published_) {
            records_.push_back(motion(processor_.published()[published_]));
        }
        for (; commanded_ < processor_.commanded().size(); ++commanded_) {
            add_command(processor_.commanded()[commanded_]);
        }
    }
    Record motion(const Published& published) {
        const SetPoint<double> set = processor_.set_point(published);
        const HeightPoint height = processor_.height_point(published);
        const std::array<double, 3> end{set.x, set.y, height.z};
        const double way = std::hypot(end[0] - at_[0], end[1] - at_[1], end[2] - at_[2]);
        const double speed = speed_of(set, height);
        return {.available = time_,
                .task = Task::move,
                .seconds = way > 0.0 && speed > 0.0 ? way / speed : 0.0,
                .begin = std::exchange(at_, end),
                .end = end};
    }
    void add_command(const Commanded& command) {
        Record record{.available = time_, .begin = at_, .end = at_};
        switch (command.opcode) {
        case Opcode::g04:
            record.task = Task::dwell;
            record.seconds = command.parameter * seconds_per_microsecond;
            break;
        case Opcode::m00:
        case Opcode::m01:
        case Opcode::m06:
            record.task = Task::wait_for_start;
            break;
        case Opcode::muser:
            record.task = Task::wait_for_fin;
            record.user = user_bit(command, settings_);
            break;
        case Opcode::m03:
        case Opcode::m04:
        case Opcode::m05:
            record.task = Task::spindle;
            record.on = command.opcode != Opcode::m05;
            break;
        case Opcode::m07:
        case Opcode::m08:
        case Opcode::m09:
            record.task = Task::coolant;
            record.on = command.opcode != Opcode::m09;
            break;
        default:
            return; // the end of the program
        }
        records_.push_back(record);
    }

    Processor& processor_;
    const SupervisedSettings& settings_;
    std::deque<Record> records_;
    double time_ = 0.0;
    std::array<double, 3> at_;
    std::size_t published_;
    std::size_t commanded_;
};

class Machine {
public:
    Machine(Processor& processor, Plc& plc, const SupervisedSettings& settings)
        : processor_(processor), plc_(plc), settings_(settings), feeder_(processor, settings) {
        run_.position = settings.start;
    }

    SupervisedRun run() {
        const auto most_scans =
            static_cast<std::int64_t>(std::ceil(settings_.most_seconds / settings_.scan_seconds));
        while (!ended_) {
            scan();
            if (plc_.get(plc_stop)) {
                end(SupervisedEnd::stopped);
            } else if (run_.scans > most_scans) {
                end(SupervisedEnd::out_of_time);
            } else {
                move_until(static_cast<double>(run_.scans) * settings_.scan_seconds);
            }
        }
        return std::move(run_);
    }

private:
    void end(SupervisedEnd how) {
        ended_ = true;
        run_.end = how;
        run_.seconds = now_;
        if (current_) {
            stand_on_the_way();
        }
        plc_.set(plc_ended, true);
        scan(); // so that the logic may switch off what is on
    }
    void stand_on_the_way() {
        const double done = whole_ > 0.0 ? 1.0 - current_->seconds / whole_ : 1.0;
        for (std::size_t axis = 0; axis < run_.position.size(); ++axis) {
            run_.position[axis] = std::lerp(current_->begin[axis], current_->end[axis], done);
        }
        current_.reset();
    }

    void scan() {
        for (; next_input_ < settings_.inputs.size() && settings_.inputs[next_input_].seconds <= now_;
             ++next_input_) {
            plc_.set(settings_.inputs[next_input_].bit, settings_.inputs[next_input_].value);
        }
        const bool acts = current_.has_value();
        plc_.set(plc_moving, acts && current_->task == Task::move && !plc_.get(plc_hold));
        plc_.set(plc_waiting, acts && current_->task == Task::wait_for_start);
        for (PlcBit bit = plc_first_user_command; bit < plc_moving; ++bit) {
            plc_.set(bit, acts && current_->task == Task::wait_for_fin && current_->user == bit);
        }
        std::array<bool, plc_bit_count> before{};
        for (PlcBit bit = 0; bit < plc_bit_count; ++bit) {
            before[static_cast<std::size_t>(bit)] = plc_.get(bit);
        }
        plc_.scan(std::llround(now_ / seconds_per_microsecond));
        ++run_.scans;
        for (PlcBit bit = 0; bit < plc_bit_count; ++bit) {
            const bool shown = plc_writes(bit) && plc_name(bit)[0] != 'M';
            if (shown && plc_.get(bit) != before[static_cast<std::size_t>(bit)]) {
                run_.outputs.push_back({now_, bit, plc_.get(bit)});
            }
        }
    }

    void move_until(double end_of_scan) {
        while (!ended_ && now_ < end_of_scan) {
            feeder_.work_until(end_of_scan);
            if (!current_ && !take_next(end_of_scan)) {
                return;
            }
            execute(end_of_scan);
        }
    }
    /// False if there is nothing to do in what is left of the scan.
    bool take_next(double end_of_scan) {
        if (feeder_.ended()) {
            end(processor_.state().stop == Stop::halted ? SupervisedEnd::finished : SupervisedEnd::fault);
            return false;
        }
        const double begin =
            feeder_.empty() ? end_of_scan : std::min(end_of_scan, std::max(now_, feeder_.front().available));
        run_.starved_seconds += taken_any_ ? begin - now_ : 0.0;
        now_ = begin;
        if (feeder_.empty() || now_ >= end_of_scan) {
            return false;
        }
        current_ = feeder_.take(now_);
        whole_ = current_->seconds;
        taken_any_ = true;
        return true;
    }
    void execute(double end_of_scan) {
        const double left = end_of_scan - now_;
        if (plc_.get(plc_hold)) {
            run_.held_seconds += left;
            now_ = end_of_scan;
            return;
        }
        switch (current_->task) {
        case Task::wait_for_start:
        case Task::wait_for_fin: {
            if (plc_.get(current_->task == Task::wait_for_start ? plc_start : plc_fin) && seen_) {
                return done();
            }
            seen_ = true; // by the logic at its next scan: an answer from before is none
            run_.waited_seconds += left;
            now_ = end_of_scan;
            return;
        }
        case Task::spindle:
            plc_.set(plc_spindle, current_->on);
            return done();
        case Task::coolant:
            plc_.set(plc_coolant, current_->on);
            return done();
        case Task::move:
        case Task::dwell: {
            const double step = std::min(left, current_->seconds);
            current_->seconds -= step;
            run_.moved_seconds += step;
            now_ = step < left ? now_ + step : end_of_scan;
            if (!(current_->seconds > 0.0)) {
                run_.executed += current_->task == Task::move ? 1 : 0;
                done();
            }
        }
        }
    }
    void done() {
        run_.position = current_->end;
        current_.reset();
        seen_ = false;
    }

    Processor& processor_;
    Plc& plc_;
    const SupervisedSettings& settings_;
    Feeder feeder_;
    SupervisedRun run_;
    std::optional<Record> current_;
    double whole_ = 0.0; ///< seconds of it
    std::size_t next_input_ = 0;
    double now_ = 0.0;
    bool seen_ = false; ///< a scan has seen what waits
    bool taken_any_ = false;
    bool ended_ = false;
};

} // namespace

std::string_view to_text(SupervisedEnd end) {
    switch (end) {
    case SupervisedEnd::finished:
        return "finished";
    case SupervisedEnd::stopped:
        return "stopped by the logic";
    case SupervisedEnd::fault:
        return "processor stopped by a fault";
    case SupervisedEnd::out_of_time:
        return "time limit reached";
    }
    return {};
}

SupervisedRun run_supervised(Processor& processor, Plc& plc, const SupervisedSettings& settings) {
    const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
    if (!positive(settings.clock_hz) || !positive(settings.scan_seconds) ||
        !positive(settings.most_seconds) || settings.records_ahead < 1) {
        throw Error("the clock, scan period, time limit and queue of a supervised run must be above 0");
    }
    return Machine(processor, plc, settings).run();
}

} // namespace millwright::cordic
