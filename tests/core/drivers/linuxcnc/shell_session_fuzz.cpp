// Any bytes from linuxcncrsh: the session stays in one of its states with finite numbers, and sends nothing
// that could begin motion once it is in alarm.
#include "core/drivers/linuxcnc/internal/shell_session.h"

#include "core/base/error.h"
#include "core/jobs/job.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    namespace drivers = millwright::drivers;
    namespace jobs = millwright::jobs;
    using millwright::expects;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    drivers::linuxcnc::ShellSession session;
    double now = 0.0;
    session.opened(now);
    const jobs::Job job = jobs::text_job("G0 X1\nG0 X2\nM2\n", "fuzz.ngc");
    const drivers::linuxcnc::ProgramFile file = drivers::linuxcnc::program_file(*job.listing, {}, 1);
    bool started = false;
    constexpr std::size_t piece = 64;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        now += 0.05;
        (void)session.take_output();
        session.receive(bytes.substr(at, piece), now);
        const bool alarm = session.status().state == drivers::DriverState::alarm;
        session.tick(now);
        const std::string sent = session.take_output();
        expects(!alarm ||
                    (sent.find("run") == std::string::npos && sent.find("jog_incr") == std::string::npos &&
                     sent.find("mdi") == std::string::npos),
                "an alarm sends no motion");
        const drivers::DriverStatus status = session.status();
        expects(status.position.size() == 0 || status.position.allFinite(), "positions are finite");
        expects(status.executed_blocks >= 0 && status.executed_blocks <= 3,
                "no more is claimed than there is");
        if (!started && status.state == drivers::DriverState::idle) {
            started = true;
            session.start(*job.listing, file, "/tmp/fuzz.ngc", now);
        }
    }
    return 0;
}
