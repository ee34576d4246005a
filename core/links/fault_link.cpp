#include "core/links/fault_link.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace millwright::links {

namespace {

WireEnd other(WireEnd end) {
    return end == WireEnd::host ? WireEnd::controller : WireEnd::host;
}

} // namespace

FaultLink::FaultLink(std::unique_ptr<Link> inner, const FaultSpec& spec, WireEnd end, const Clock& clock)
    : inner_(std::move(inner)), spec_(spec), end_(end), clock_(clock), out_(spec, other(end)),
      in_(spec, end) {}

void FaultLink::open() {
    inner_->open();
    const std::scoped_lock lock(mutex_);
    out_ = FaultyWire(spec_, other(end_));
    in_ = FaultyWire(spec_, end_);
}

void FaultLink::move_bytes() { // with mutex_ held
    const double now = clock_.now();
    in_.send(inner_->read(), now);
    inner_->write(out_.arrived(now));
    if (out_.disconnected() || in_.disconnected()) {
        inner_->close();
    }
}

void FaultLink::write(std::string_view bytes) {
    const std::scoped_lock lock(mutex_);
    out_.send(bytes, clock_.now());
    move_bytes();
}

std::string FaultLink::read() {
    const std::scoped_lock lock(mutex_);
    move_bytes();
    return in_.arrived(clock_.now());
}

void FaultLink::wait(double seconds) {
    double patience = seconds;
    bool broken = false;
    {
        const std::scoped_lock lock(mutex_);
        move_bytes();
        broken = out_.disconnected() || in_.disconnected();
        for (const auto& next : {in_.next_arrival(), out_.next_arrival()}) {
            patience = next ? std::min(patience, *next - clock_.now()) : patience;
        }
    }
    if (broken) { // what is on its way arrives no more
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    } else if (patience > 0.0) {
        inner_->wait(patience);
    }
}

std::optional<std::string> FaultLink::lost() const {
    const std::scoped_lock lock(mutex_);
    if (out_.disconnected() || in_.disconnected()) {
        return "a simulated disconnect";
    }
    return inner_->lost();
}

void FaultLink::close() noexcept {
    inner_->close();
}

std::int64_t FaultLink::passed() const {
    const std::scoped_lock lock(mutex_);
    return out_.sent() + in_.sent();
}

} // namespace millwright::links
