#include "core/machine/emulators/table/table_emulator.h"

namespace millwright::machine {

TableEmulator::TableEmulator(std::unique_ptr<Link> link,
                             const RecordFormat& format,
                             const kinematics::MachineModel& model,
                             TableOptions options)
    : link_(std::move(link)), format_(format), text_(format, model, options.decimals), options_(options),
      position_(static_cast<std::size_t>(model.axis_count())) {
    link_->open();
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

TableEmulator::~TableEmulator() {
    thread_ = {};
    link_->close();
}

std::int64_t TableEmulator::records() const {
    const std::scoped_lock lock(mutex_);
    return records_;
}

std::int64_t TableEmulator::bad_lines() const {
    const std::scoped_lock lock(mutex_);
    return bad_lines_;
}

std::vector<double> TableEmulator::position() const {
    const std::scoped_lock lock(mutex_);
    return position_;
}

std::vector<std::vector<double>> TableEmulator::positions() const {
    const std::scoped_lock lock(mutex_);
    return positions_;
}

void TableEmulator::serve(const std::stop_token& stop) {
    std::string inbox;
    while (!stop.stop_requested() && !link_->lost()) {
        constexpr double glance = 0.02;
        link_->wait(glance);
        inbox += link_->read();
        for (auto end = inbox.find_first_of("\r\n"); end != std::string::npos;
             end = inbox.find_first_of("\r\n")) {
            take(inbox.substr(0, end));
            inbox.erase(0, end + 1);
        }
        constexpr std::size_t longest = 10'000;
        if (inbox.size() > longest) {
            inbox.clear(); // nobody's records are that long
        }
    }
}

void TableEmulator::take(const std::string& line) {
    if (line.empty()) {
        return;
    }
    std::string answer;
    {
        const std::scoped_lock lock(mutex_);
        ++seen_;
        const std::optional<Record> record = text_.read(line);
        if (!record || seen_ == options_.refuses) {
            bad_lines_ += record ? 0 : 1;
            answer = "error";
        } else {
            answer = obey(*record);
        }
        if (options_.silent_from > 0 && seen_ >= options_.silent_from) {
            return;
        }
    }
    if (!format_.answer.empty()) {
        link_->write(answer + "\n");
    }
}

/// With the lock held.
std::string TableEmulator::obey(const Record& record) {
    for (std::size_t n = 0; n < position_.size(); ++n) {
        position_[n] = format_.relative ? position_[n] + record.axes[n] : record.axes[n];
    }
    ++records_;
    if (options_.keep) {
        positions_.push_back(position_);
    }
    return format_.answer;
}

} // namespace millwright::machine
