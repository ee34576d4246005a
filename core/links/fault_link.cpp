#include "core/links/fault_link.h"

#include "core/base/error.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <set>
#include <thread>
#include <utility>

namespace millwright::links {

namespace {

template <class Number> Number number_in(std::string_view word, std::string_view text, Number most) {
    Number value{};
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = read.ec == std::errc{} && read.ptr == text.data() + text.size();
    if (!whole || !(value >= Number{} && value <= most)) {
        throw Error("the fault '" + std::string(word) + "' has an invalid value", {}, {});
    }
    return value;
}

void set_direction(FaultSpec& spec, std::string_view word, std::string_view end) {
    if (end != "host" && end != "controller" && end != "both") {
        throw Error("the fault '" + std::string(word) + "' has an invalid direction",
                    {},
                    "use host, controller or both");
    }
    spec.toward_host = end != "controller";
    spec.toward_controller = end != "host";
}

void set_word(FaultSpec& spec, std::string_view word) {
    const std::size_t equals = std::min(word.find('='), word.size());
    const std::string_view name = word.substr(0, equals);
    const std::string_view value = word.substr(std::min(equals + 1, word.size()));
    constexpr std::int64_t most_bytes = 1'000'000'000'000;
    constexpr double most_delay = 3600.0;
    const auto probability = [&] { return number_in(word, value, 1.0); };
    const auto bytes = [&] { return number_in(word, value, most_bytes); };
    if (name == "drop") {
        spec.drop = probability();
    } else if (name == "garble") {
        spec.garble = probability();
    } else if (name == "duplicate") {
        spec.duplicate = probability();
    } else if (name == "lost-ok") {
        spec.lost_ok = probability();
    } else if (name == "delay") {
        spec.delay = number_in(word, value, most_delay);
    } else if (name == "disconnect") {
        spec.disconnect = bytes();
    } else if (name == "stall") {
        spec.stall = bytes();
    } else if (name == "reset") {
        spec.reset = bytes();
    } else if (name == "alarm") {
        spec.alarm = bytes();
    } else if (name == "estop") {
        spec.emergency_stop = bytes();
    } else if (name == "toward") {
        set_direction(spec, word, value);
    } else if (name == "seed") {
        spec.seed = number_in(word, value, ~std::uint64_t{});
    } else {
        throw Error("unknown fault '" + std::string(name) + "'",
                    {},
                    "use drop, garble, duplicate, lost-ok, delay, disconnect, stall, reset, alarm, estop, "
                    "toward or seed");
    }
}

} // namespace

FaultSpec read_fault_spec(std::string_view text) {
    FaultSpec spec;
    std::set<std::string_view> seen;
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        const std::string_view word = text.substr(0, comma);
        text.remove_prefix(std::min(comma + 1, text.size()));
        if (!seen.insert(word.substr(0, word.find('='))).second) {
            throw Error("the fault '" + std::string(word) + "' is given twice");
        }
        set_word(spec, word);
    }
    return spec;
}

FaultyWire::FaultyWire(const FaultSpec& spec, WireEnd toward)
    : spec_(spec), on_(toward == WireEnd::host ? spec.toward_host : spec.toward_controller),
      random_(2 * spec.seed + (toward == WireEnd::host ? 1 : 0)) {}

double FaultyWire::uniform() {
    constexpr double unit = 0x1p-53;
    return static_cast<double>(random_() >> 11U) * unit;
}

bool FaultyWire::happens(double probability) {
    return on_ && probability > 0.0 && uniform() < probability;
}

bool FaultyWire::disconnected() const {
    return on_ && spec_.disconnect && sent_ >= *spec_.disconnect;
}

namespace {

/// How many bytes the acknowledgement takes with which `bytes` begin; 0: they do not.
std::size_t ack_length(std::string_view bytes) {
    for (const std::string_view ack : {"ok\r\n", "ok\n", "ok\r"}) {
        if (bytes.starts_with(ack)) {
            return ack.size();
        }
    }
    return 0;
}

} // namespace

/// A lost acknowledgement leaves no trace at all, not even the end of its line.
std::string FaultyWire::without_lost_acks(std::string_view bytes) {
    std::string kept;
    while (!bytes.empty()) {
        const bool begins = kept.empty() || kept.back() == '\n' || kept.back() == '\r';
        const std::size_t ack = begins ? ack_length(bytes) : 0;
        const bool lost = ack > 0 && happens(spec_.lost_ok);
        const std::size_t count = lost ? ack : 1;
        if (lost) {
            ++faults_;
        } else {
            kept += bytes.front();
        }
        bytes.remove_prefix(count);
    }
    return kept;
}

void FaultyWire::pass(char byte, std::string& through) {
    if (happens(spec_.drop)) {
        ++faults_;
        return;
    }
    if (happens(spec_.garble)) {
        ++faults_;
        byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << (random_() % 8U)));
    }
    through += byte;
    if (happens(spec_.duplicate)) {
        ++faults_;
        through += byte;
    }
}

void FaultyWire::send(std::string_view bytes, double now) {
    std::string through;
    for (const char byte : spec_.lost_ok > 0.0 ? without_lost_acks(bytes) : std::string(bytes)) {
        const bool dead = on_ && ((spec_.disconnect && sent_ >= *spec_.disconnect) ||
                                  (spec_.stall && sent_ >= *spec_.stall));
        ++sent_;
        if (!dead) {
            pass(byte, through);
        }
    }
    if (through.empty()) {
        return;
    }
    const double late = on_ && spec_.delay > 0.0 ? spec_.delay * uniform() : 0.0;
    const double earliest = under_way_.empty() ? now : std::max(now, under_way_.back().time);
    under_way_.push_back({std::max(now + late, earliest), std::move(through)}); // in order, as on any wire
}

std::string FaultyWire::arrived(double now) {
    std::string bytes;
    while (!under_way_.empty() && under_way_.front().time <= now) {
        bytes += under_way_.front().bytes;
        under_way_.pop_front();
    }
    return bytes;
}

std::optional<double> FaultyWire::next_arrival() const {
    return under_way_.empty() ? std::nullopt : std::optional(under_way_.front().time);
}

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
