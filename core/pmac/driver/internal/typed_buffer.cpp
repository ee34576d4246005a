#include "core/pmac/driver/internal/typed_buffer.h"

#include "core/pmac/driver/internal/command_kind.h"

#include <algorithm>

namespace millwright::pmac::internal {

namespace {

bool acts_at_once(const std::vector<std::string>& lines) {
    return std::ranges::all_of(lines, [](const std::string& line) {
        return only_asks(line) || only_stops(line) || only_kills(line);
    });
}

bool leave_open(const std::vector<std::string>& lines, bool open) {
    for (const std::string& line : lines) {
        open = opens_buffer(line) || (open && !closes_buffer(line));
    }
    return open;
}

} // namespace

bool TypedBuffer::keeps(const std::vector<std::string>& lines) {
    const bool begins = kept_.empty() && !opens_buffer(lines.front()); // with what acts at once
    if (begins || acts_at_once(lines) || !leave_open(lines, !kept_.empty())) {
        return false;
    }
    if (opens_buffer(lines.front())) {
        kept_.clear();
    }
    kept_.insert(kept_.end(), lines.begin(), lines.end());
    return true;
}

std::vector<std::string> TypedBuffer::completed(const std::vector<std::string>& lines) const {
    if (kept_.empty() || acts_at_once(lines) || opens_buffer(lines.front())) {
        return lines;
    }
    std::vector<std::string> all = kept_;
    all.insert(all.end(), lines.begin(), lines.end());
    return all;
}

void TypedBuffer::sent(const std::vector<std::string>& lines) {
    if (!acts_at_once(lines)) {
        kept_.clear();
    }
}

} // namespace millwright::pmac::internal
