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

} // namespace

std::size_t TypedBuffer::count_to_send(const std::vector<std::string>& lines) const {
    if (acts_at_once(lines)) {
        return lines.size();
    }
    bool open = !kept_.empty();
    std::size_t opened_at = 0;
    for (std::size_t n = 0; n < lines.size(); ++n) {
        if (opens_buffer(lines[n])) {
            open = true;
            opened_at = n;
        } else if (closes_buffer(lines[n])) {
            open = false;
        }
    }
    return open ? opened_at : lines.size();
}

std::vector<std::string> TypedBuffer::completed(const std::vector<std::string>& lines) const {
    if (kept_.empty() || acts_at_once(lines)) {
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

void TypedBuffer::keep(const std::vector<std::string>& lines) {
    kept_.insert(kept_.end(), lines.begin(), lines.end());
}

} // namespace millwright::pmac::internal
