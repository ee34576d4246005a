#include "ui/widgets/places.h"

#include "core/base/error.h"

#include <utility>

namespace millwright::widgets {

std::string Places::path(std::string_view id) const {
    std::string whole = scopes_.empty() ? std::string() : scopes_.back() + "/";
    whole += id;
    return whole;
}

const Seen* Places::find(std::string_view path) const {
    const auto at = seen_.find(path);
    return at == seen_.end() ? nullptr : &at->second;
}

void Places::clear() {
    expects(scopes_.empty(), "every scope of a frame is left before the next frame");
    seen_.clear();
}

void Places::enter(std::string_view id) {
    expects(!id.empty(), "a scope has an id");
    scopes_.push_back(path(id));
}

void Places::leave() noexcept {
    scopes_.pop_back();
}

void Places::record(std::string path, Seen seen) {
    expects(!path.empty() && path.back() != '/', "a widget has an id");
    const auto [at, is_new] = seen_.try_emplace(std::move(path), std::move(seen));
    expects(is_new, "the path of a widget is used once per frame: " + at->first);
}

} // namespace millwright::widgets
