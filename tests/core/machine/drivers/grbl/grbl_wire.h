// A Grbl session and an emulated Grbl with a wire between them on which faults happen, all in one thread and
// in time that passes as fast as it is computed.
#pragma once

#include "core/machine/drivers/grbl/internal/session.h"
#include "core/machine/emulators/grbl/grbl_emulator.h"
#include "core/machine/links/faults.h"

#include <algorithm>
#include <string>
#include <vector>

namespace millwright::test {

/// A listing whose blocks are the lines of `text`.
inline gcode::Listing listing_of(const std::string& text) {
    gcode::Listing listing;
    listing.text = text;
    listing.line_starts = {0};
    for (std::size_t n = 0; n < text.size(); ++n) {
        if (text[n] == '\n') {
            listing.line_of_block.push_back(listing.line_count() + 1);
            listing.line_starts.push_back(n + 1);
        }
    }
    return listing;
}

class GrblWire {
public:
    explicit GrblWire(const machine::FaultSpec& faults = {},
                      machine::GrblEmulatorOptions options = {},
                      machine::grbl::SessionSettings settings = {},
                      const std::string& setup = {})
        : grbl(std::move(options)), session(settings), to_host_({}, machine::WireEnd::host),
          to_grbl_({}, machine::WireEnd::controller) {
        session.opened(now);
        run_until([this] { return session.greeted(); }, 10.0);
        grbl.receive(setup);
        run_until([] { return false; }, setup.empty() ? 0.0 : 0.5);
        to_host_ = machine::FaultyWire(faults, machine::WireEnd::host); // the greeting goes well
        to_grbl_ = machine::FaultyWire(faults, machine::WireEnd::controller);
        faults_ = faults;
    }

    machine::GrblEmulator grbl;
    machine::grbl::Session session;
    double now = 1000.0;
    std::string sent; ///< by the session, since it was last cleared

    void start(const std::string& program) {
        session.start(machine::grbl::program_lines(listing_of(program), "test.ngc"), now);
    }

    /// One small step of time for both ends.
    void step(double seconds = 0.005) {
        now += seconds;
        grbl.advance(seconds);
        to_host_.send(grbl.take_output(), now);
        if (deaf_) {
            (void)to_host_.arrived(now);
        } else if (!broken()) {
            session.receive(to_host_.arrived(now), now);
        } else {
            session.lost("it broke");
        }
        happen();
        session.tick(now);
        const std::string bytes = session.take_output();
        sent += bytes;
        if (!broken() && !deaf_) {
            to_grbl_.send(bytes, now);
            grbl.receive(to_grbl_.arrived(now));
        }
    }

    template <class Done> bool run_until(const Done& done, double seconds) {
        for (const double end = now + seconds; now < end;) {
            if (done()) {
                return true;
            }
            step();
        }
        return done();
    }

    [[nodiscard]] machine::DriverState state() const { return session.status().state; }
    bool run_to_end(double seconds = 600.0) {
        return run_until(
            [this] {
                return state() == machine::DriverState::idle || state() == machine::DriverState::stopped ||
                       state() == machine::DriverState::alarm;
            },
            seconds);
    }

    /// Pulls the plug, which the session is told, or lets all bytes vanish without a word.
    void cut() { cut_ = true; }
    void go_deaf() { deaf_ = true; }
    [[nodiscard]] bool broken() const { return cut_ || to_host_.disconnected() || to_grbl_.disconnected(); }

private:
    /// Faults of the controller itself.
    void happen() {
        const std::int64_t passed = to_host_.sent() + to_grbl_.sent();
        if (faults_.reset && passed >= *faults_.reset) {
            faults_.reset.reset();
            grbl.power_cycle();
        }
        if (faults_.alarm && passed >= *faults_.alarm) {
            faults_.alarm.reset();
            grbl.raise_alarm();
        }
    }

    machine::FaultSpec faults_;
    machine::FaultyWire to_host_, to_grbl_;
    bool cut_ = false, deaf_ = false;
};

} // namespace millwright::test
