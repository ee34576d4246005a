#include "core/drivers/records/records_driver.h"

#include "core/drivers/console_tap.h"
#include "core/drivers/records/internal/record_session.h"

#include <utility>

namespace millwright::drivers {

using records::RecordSession;

namespace {

ConsoleKind kind_of(std::string_view line, bool sent) {
    if (sent) {
        return ConsoleKind::line;
    }
    return line == "error" ? ConsoleKind::fault : ConsoleKind::answer;
}

} // namespace

RecordsDriver::RecordsDriver(std::unique_ptr<links::Link> link,
                             const Clock& clock,
                             std::shared_ptr<const kinematics::MachineModel> model,
                             kinematics::AxisPositions position,
                             const RecordsOptions& options)
    : SessionDriver(std::move(link),
                    clock,
                    std::make_unique<RecordSession>(std::move(model), std::move(position), options),
                    {.kind_of = kind_of}) {}

RecordsDriver::~RecordsDriver() {
    close();
}

RecordSession& RecordsDriver::talk() const {
    return static_cast<RecordSession&>(session());
}

Capabilities RecordsDriver::capabilities() const {
    Capabilities able;
    able.overrides = Capabilities::OverrideRange::feed;
    able.program.single_block = able.program.optional_stop = able.program.piecewise = true;
    able.reports.position = able.reports.spindle = false;
    able.reports.execution = talk().awaits_answers();
    return able;
}

void RecordsDriver::start(Work work) {
    const Turn turn(*this);
    talk().start(work, turn.now());
}

void RecordsDriver::set_optional_stop(bool on) {
    const Turn turn(*this);
    talk().set_optional_stop(on);
}

void RecordsDriver::stands_at(const kinematics::AxisPositions& position) {
    const Turn turn(*this);
    talk().stands_at(position);
}

void RecordsDriver::set_single_block(bool on) {
    const Turn turn(*this);
    talk().set_single_block(on);
}

} // namespace millwright::drivers
