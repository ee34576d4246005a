// Any bytes from a controller: the session stays in one of its states with finite numbers, claims no more
// than it sent, and sends nothing that could begin motion once it is in alarm.
#include "core/base/error.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <cstddef>
#include <cstdint>

namespace {

using millwright::expects;
namespace drivers = millwright::drivers;

millwright::program::Listing program() {
    millwright::program::Listing listing;
    listing.text = "G1X1F100\nX2\nX3\nM30\n";
    listing.line_of_block = {1, 2, 3, 4};
    listing.line_starts = {0, 9, 12, 15, 19};
    return listing;
}

void check(const drivers::grbl::GrblSession& session) {
    const drivers::DriverStatus status = session.status();
    expects(status.position.size() == 0 || status.position.allFinite(), "positions are finite");
    expects(status.executed_blocks >= 0 && status.executed_blocks <= 4, "no more is claimed than there is");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    drivers::grbl::GrblSession session;
    double now = 0.0;
    session.opened(now);
    bool started = false;
    constexpr std::size_t piece = 16;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        now += 0.05;
        session.receive(bytes.substr(at, piece), now);
        const bool alarm = session.status().state == drivers::DriverState::alarm;
        session.tick(now);
        const std::string sent = session.take_output();
        expects(!alarm || sent.find_first_not_of("?!\x18") == std::string::npos, "an alarm sends no motion");
        if (!started && session.status().state == drivers::DriverState::idle) {
            started = true;
            session.start(drivers::grbl::program_lines(program(), "fuzz.ngc"), now);
        }
        check(session);
    }
    return 0;
}
