// Any bytes from a PMAC: the session stays in one of its states with finite numbers, and sends nothing but a
// kill, questions and the end of a buffer once it is in alarm.
#include "core/base/error.h"
#include "core/pmac/driver/internal/pmac_session.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    pmac::internal::PmacSession session(pmac::arm_settings());
    double now = 0.0;
    session.opened(now);
    bool asked = false;
    constexpr std::size_t piece = 16;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        now += 0.03;
        session.tick(now);
        (void)session.take_output();
        session.receive(bytes.substr(at, piece), now);
        session.tick(now);
        const bool alarm = session.status().state == drivers::DriverState::alarm;
        session.tick(now);
        const std::string sent = session.take_output();
        expects(!alarm || (sent.find("J") == std::string::npos && sent.find("R") == std::string::npos &&
                           sent.find("HM") == std::string::npos && sent.find("A") == std::string::npos),
                "an alarm sends no motion");
        const drivers::DriverStatus status = session.status();
        expects(status.position.size() == 0 || status.position.allFinite(), "positions are finite");
        if (!asked && status.state == drivers::DriverState::idle) {
            asked = true;
            session.enable(now);
        }
    }
    return 0;
}
