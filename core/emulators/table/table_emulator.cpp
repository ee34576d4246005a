#include "core/emulators/table/table_emulator.h"

#include "core/base/error.h"

#include <cmath>
#include <utility>

namespace millwright::emulators {

TableEmulator::TableEmulator(const drivers::RecordFormat& format,
                             const kinematics::MachineModel& model,
                             const TableOptions& options)
    : format_(format), text_(format, model, options.decimals), options_(options),
      position_(static_cast<std::size_t>(model.axis_count())) {}

void TableEmulator::receive(std::string_view bytes) {
    inbox_ += bytes;
    std::size_t begin = 0;
    for (auto end = inbox_.find_first_of("\r\n"); end != std::string::npos;
         end = inbox_.find_first_of("\r\n", begin)) {
        take(inbox_.substr(begin, end - begin));
        begin = end + 1;
    }
    inbox_.erase(0, begin);
    constexpr std::size_t longest = 10'000;
    if (inbox_.size() > longest) {
        inbox_.clear(); // no record is that long
    }
}

void TableEmulator::take(const std::string& line) {
    if (line.empty()) {
        return;
    }
    ++seen_;
    const std::optional<drivers::Record> record = text_.read(line);
    if (!record || alarm_ || seen_ == options_.refuses) {
        bad_lines_ += record ? 0 : 1;
        answer("error", seen_);
        return;
    }
    due_.push_back({*record, seen_});
    if (due_.size() == 1) {
        way_left_ = time_of(*record);
    }
    advance(0.0);
}

/// Without getting up to the speed and down again.
double TableEmulator::time_of(const drivers::Record& record) const {
    if (!options_.takes_time || !(record.speed > 0.0)) {
        return 0.0;
    }
    double square = 0.0;
    for (std::size_t n = 0; n < position_.size(); ++n) {
        const double way = format_.relative ? record.axes[n] : record.axes[n] - position_[n];
        square += way * way;
    }
    return std::sqrt(square) / record.speed;
}

void TableEmulator::advance(double seconds) {
    expects(seconds >= 0.0, "time does not run backwards");
    way_left_ -= seconds;
    while (!due_.empty() && way_left_ <= 0.0) {
        obey();
        way_left_ += due_.empty() ? 0.0 : time_of(due_.front().record);
    }
}

/// The record that is due; it was on its way for as long as it takes.
void TableEmulator::obey() {
    const Due due = std::move(due_.front());
    due_.pop_front();
    for (std::size_t n = 0; n < position_.size(); ++n) {
        position_[n] = format_.relative ? position_[n] + due.record.axes[n] : due.record.axes[n];
    }
    ++records_;
    if (options_.keep) {
        positions_.push_back(position_);
    }
    answer(format_.answer, due.number);
    if (due.number == options_.doubles) {
        answer(format_.answer, due.number);
    }
}

void TableEmulator::answer(const std::string& text, std::int64_t record) {
    const bool silent = options_.silent_from > 0 && record >= options_.silent_from;
    if (!format_.answer.empty() && !silent) {
        outbox_ += text + "\n";
    }
}

std::string TableEmulator::take_output() {
    return std::exchange(outbox_, {});
}

void TableEmulator::raise_alarm() {
    due_.clear();
    alarm_ = true;
}

void TableEmulator::power_cycle() {
    due_.clear();
    inbox_.clear();
    outbox_.clear();
    alarm_ = false;
}

} // namespace millwright::emulators
