#include "core/drivers/console.h"

#include "core/base/error.h"

#include <algorithm>
#include <utility>

namespace millwright::drivers {

Console::Console(std::size_t capacity) : capacity_(capacity) {
    expects(capacity > 0, "a console keeps at least one line");
}

void Console::add(double time, bool sent, ConsoleKind kind, std::string text) {
    const std::scoped_lock lock(mutex_);
    if (!keep_reports_ && (kind == ConsoleKind::query || kind == ConsoleKind::report)) {
        return;
    }
    lines_.push_back({end_++, time, sent, kind, std::move(text)});
    if (lines_.size() > capacity_) {
        lines_.pop_front();
    }
}

void Console::keep_reports(bool keep) {
    const std::scoped_lock lock(mutex_);
    keep_reports_ = keep;
}

std::int64_t Console::read(std::int64_t from, std::vector<ConsoleLine>& lines, int most) const {
    const std::scoped_lock lock(mutex_);
    const std::int64_t first_kept = end_ - std::ssize(lines_);
    const std::int64_t first = std::clamp(from, first_kept, end_);
    const std::int64_t last = std::min<std::int64_t>(end_, first + std::max(0, most));
    const auto begin = lines_.begin() + (first - first_kept);
    lines.insert(lines.end(), begin, begin + (last - first));
    return last;
}

std::int64_t Console::end() const {
    const std::scoped_lock lock(mutex_);
    return end_;
}

} // namespace millwright::drivers
