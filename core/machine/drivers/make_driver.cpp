#include "core/machine/drivers/make_driver.h"

#include "core/base/error.h"
#include "core/machine/drivers/cordic/cordic_driver.h"
#include "core/machine/drivers/grbl/grbl_driver.h"
#include "core/machine/drivers/linuxcnc/linuxcnc_driver.h"
#include "core/machine/drivers/pmac/arm_axes.h"
#include "core/machine/drivers/pmac/pmac_driver.h"
#include "core/machine/drivers/records/records_driver.h"
#include "core/machine/drivers/stream/stream_driver.h"
#include "core/machine/drivers/virtual_machine/virtual_machine.h"
#include "core/machine/links/link.h"

#include <algorithm>
#include <array>
#include <utility>

namespace millwright::machine {

namespace {

constexpr std::array<std::string_view, 7> names{
    "virtual", "grbl", "linuxcnc", "stream", "cordic", "records", "pmac"};

void require_model(const MovedAxes& axes) {
    if (!axes.model) {
        throw Error("there is no machine yet whose axes could be moved");
    }
}

std::unique_ptr<Driver> make_stream(const DriverChoice& choice, const MovedAxes& axes, const Clock& clock) {
    const bool to_file = choice.address.starts_with("file:");
    return std::make_unique<StreamDriver>(
        make_link(choice.address),
        clock,
        axes.model,
        axes.position,
        StreamOptions{
            .period = choice.period, .paced = !to_file, .record = choice.record, .known = axes.known});
}

/// A busy computer may be late with an answer. Meanwhile no sign of life is sent, and the card stops its
/// motors by itself, so that nothing depends on how long that is waited for.
std::unique_ptr<Driver> make_pmac(const DriverChoice& choice, const MovedAxes& axes, const Clock& clock) {
    if (!axes.arm) {
        throw Error("there is no arm whose joints the card would move");
    }
    PmacSettings settings = within_limits(arm_settings_of(choice.axes), *axes.arm);
    settings.patience = 3.0; // s
    return std::make_unique<PmacDriver>(make_link(choice.address), clock, std::move(settings));
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
                    "virtual, grbl, linuxcnc, stream, cordic, records or pmac");
    }
    return static_cast<DriverKind>(found - names.begin());
}

std::unique_ptr<Driver> make_driver(const DriverChoice& choice, const MovedAxes& axes, Clock& clock) {
    switch (choice.kind) {
    case DriverKind::grbl:
        return std::make_unique<GrblDriver>(
            make_link(choice.address), clock, GrblOptions{.one_by_one = choice.one_by_one});
    case DriverKind::linuxcnc: {
        LinuxCncOptions wanted;
        wanted.axes = choice.axes;
        return std::make_unique<LinuxCncDriver>(make_link(choice.address), clock, wanted);
    }
    case DriverKind::pmac:
        return make_pmac(choice, axes, clock);
    case DriverKind::stream:
        require_model(axes);
        return make_stream(choice, axes, clock);
    case DriverKind::records:
        require_model(axes);
        return std::make_unique<RecordsDriver>(
            make_link(choice.address),
            clock,
            axes.model,
            axes.position,
            RecordsOptions{.format = choice.record.value_or(RecordFormat()), .known = axes.known});
    case DriverKind::cordic:
        require_model(axes);
        return std::make_unique<CordicDriver>(axes.position, VirtualSpeed{axes.speed}, clock, axes.model);
    case DriverKind::virtual_machine:
        break;
    }
    require_model(axes);
    return std::make_unique<VirtualMachine>(axes.position, VirtualSpeed{axes.speed}, clock, axes.model);
}

} // namespace millwright::machine
