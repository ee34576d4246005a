#include "core/machine/make_driver.h"

#include "core/base/error.h"
#include "core/cordic_machine/cordic_driver.h"
#include "core/drivers/grbl/grbl_driver.h"
#include "core/drivers/linuxcnc/linuxcnc_driver.h"
#include "core/drivers/records/records_driver.h"
#include "core/drivers/stream/stream_driver.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/links/link.h"
#include "core/pmac/driver/arm_axes.h"
#include "core/pmac/driver/pmac_driver.h"

#include <algorithm>
#include <array>
#include <utility>

namespace millwright::machine {

namespace {

constexpr std::array<std::string_view, 7> names{
    "virtual", "grbl", "linuxcnc", "stream", "cordic", "records", "pmac"};

void require_model(const MovedAxes& axes) {
    if (!axes.model) {
        throw Error("no machine is loaded whose axes could be moved");
    }
}

std::unique_ptr<drivers::Driver>
make_stream(const DriverChoice& choice, const MovedAxes& axes, const Clock& clock) {
    const bool to_file = choice.address.starts_with("file:");
    return std::make_unique<drivers::StreamDriver>(
        links::make_link(choice.address),
        clock,
        axes.model,
        axes.position,
        drivers::StreamOptions{
            .period = choice.period, .paced = !to_file, .record = choice.record, .known = axes.known});
}

/// A busy computer may be late with an answer. Meanwhile no sign of life is sent, and the card stops its
/// motors by itself, so that nothing depends on how long that is waited for.
std::unique_ptr<drivers::Driver>
make_pmac(const DriverChoice& choice, const MovedAxes& axes, const Clock& clock) {
    if (!axes.arm) {
        throw Error("no arm is loaded whose joints the card could move");
    }
    pmac::PmacSettings settings = pmac::within_limits(pmac::arm_settings_of(choice.axes), *axes.arm);
    settings.patience = 3.0; // s
    return std::make_unique<pmac::PmacDriver>(links::make_link(choice.address), clock, std::move(settings));
}

} // namespace

std::string_view to_text(DriverKind kind) {
    return names[static_cast<std::size_t>(kind)];
}

DriverKind driver_kind(std::string_view name) {
    const auto* const found = std::ranges::find(names, name);
    if (found == names.end()) {
        throw Error("there is no driver '" + std::string(name) + "'",
                    {},
                    "use virtual, grbl, linuxcnc, stream, cordic, records or pmac");
    }
    return static_cast<DriverKind>(found - names.begin());
}

std::unique_ptr<drivers::Driver>
make_driver(const DriverChoice& choice, const MovedAxes& axes, Clock& clock) {
    switch (choice.kind) {
    case DriverKind::grbl:
        return std::make_unique<drivers::GrblDriver>(
            links::make_link(choice.address), clock, drivers::GrblOptions{.one_by_one = choice.one_by_one});
    case DriverKind::linuxcnc: {
        drivers::LinuxCncOptions wanted;
        wanted.axes = choice.axes;
        return std::make_unique<drivers::LinuxCncDriver>(links::make_link(choice.address), clock, wanted);
    }
    case DriverKind::pmac:
        return make_pmac(choice, axes, clock);
    case DriverKind::stream:
        require_model(axes);
        return make_stream(choice, axes, clock);
    case DriverKind::records:
        require_model(axes);
        return std::make_unique<drivers::RecordsDriver>(
            links::make_link(choice.address),
            clock,
            axes.model,
            axes.position,
            drivers::RecordsOptions{.format = choice.record.value_or(drivers::RecordFormat()),
                                    .known = axes.known});
    case DriverKind::cordic:
        require_model(axes);
        return std::make_unique<cordic_machine::CordicDriver>(
            axes.position, drivers::VirtualSpeed{axes.speed}, clock, axes.model);
    case DriverKind::virtual_machine:
        break;
    }
    require_model(axes);
    return std::make_unique<drivers::VirtualMachine>(
        axes.position, drivers::VirtualSpeed{axes.speed}, clock, axes.model);
}

} // namespace millwright::machine
