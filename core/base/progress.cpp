#include "core/base/progress.h"

#include "core/base/error.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace millwright {

struct Progress::Shared {
    Listener listener;
    std::stop_token stop;
    std::mutex mutex;
    Report last;
};

Progress::Progress() : Progress(nullptr, {}) {}

Progress::Progress(Listener listener, std::stop_token stop) : shared_(std::make_shared<Shared>()) {
    shared_->listener = std::move(listener);
    shared_->stop = std::move(stop);
}

Progress Progress::part(double from, double to) const {
    Progress inner = *this;
    inner.from_ = from_ + (to_ - from_) * from;
    inner.to_ = from_ + (to_ - from_) * to;
    return inner;
}

void Progress::report(double fraction, std::string_view text) const {
    if (!shared_->listener) {
        return;
    }
    const double whole = from_ + (to_ - from_) * std::clamp(fraction, 0.0, 1.0);
    const std::scoped_lock lock(shared_->mutex);
    shared_->last.fraction = std::max(shared_->last.fraction, whole);
    if (!text.empty()) {
        shared_->last.text = text;
    }
    shared_->listener(shared_->last);
}

bool Progress::cancelled() const {
    return shared_->stop.stop_requested();
}

void Progress::check() const {
    if (cancelled()) {
        throw Cancelled{};
    }
}

} // namespace millwright
