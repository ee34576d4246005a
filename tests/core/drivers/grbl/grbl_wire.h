// A Grbl session and an emulated Grbl with a wire between them.
#pragma once

#include "core/drivers/grbl/internal/grbl_session.h"
#include "core/emulators/grbl/grbl_emulator.h"
#include "tests/core/drivers/session_wire.h"
#include "tests/core/emulators/grbl/stored_settings.h"

#include <string>
#include <utility>

namespace millwright::test {

/// A listing whose blocks are the lines of `text`.
inline program::Listing listing_of(const std::string& text) {
    program::Listing listing;
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

/// The emulated Grbl comes first: it is there before the wire.
struct GrblHolder {
    emulators::GrblEmulator grbl;
};

class GrblWire : public GrblHolder, public SessionWire<drivers::grbl::GrblSession, emulators::GrblEmulator> {
public:
    explicit GrblWire(const links::FaultSpec& faults = {},
                      emulators::GrblEmulatorOptions options = {},
                      drivers::grbl::SessionSettings settings = {},
                      const std::string& setup = {})
        : GrblHolder{emulators::GrblEmulator(std::move(options))},
          SessionWire(grbl, drivers::grbl::GrblSession(settings), 0.005) {
        greet();
        store_settings(grbl, setup);
        run_until([] { return false; }, setup.empty() ? 0.0 : 0.5);
        begin_faults(faults);
    }

    void start(const std::string& program) {
        session.start(drivers::grbl::program_lines(listing_of(program), "test.ngc"), now);
    }
};

} // namespace millwright::test
