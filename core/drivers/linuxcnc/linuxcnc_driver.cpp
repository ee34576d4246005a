#include "core/drivers/linuxcnc/linuxcnc_driver.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/drivers/linuxcnc/internal/console_words.h"
#include "core/drivers/linuxcnc/internal/shell_session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>
#include <utility>

namespace millwright::drivers {

using linuxcnc::ShellSession;

namespace {

std::unique_ptr<ShellSession> make_session(const LinuxCncOptions& options) {
    const bool known =
        options.axes.starts_with("XYZ") && std::string("XYZABC").starts_with(options.axes.substr(0, 3)) &&
        options.axes.find_first_not_of("XYZABC") == std::string::npos && options.axes.size() <= 6;
    if (!known) {
        throw Error("LinuxCNC's axes must be XYZ, followed by none or any of ABC, not " + options.axes);
    }
    return std::make_unique<ShellSession>(
        linuxcnc::ShellSettings{.password = options.password,
                                .enable_password = options.enable_password,
                                .axes = options.axes,
                                .jog_acceleration = options.jog_acceleration});
}

} // namespace

LinuxCncDriver::LinuxCncDriver(std::unique_ptr<links::Link> link, const Clock& clock, LinuxCncOptions options)
    : SessionDriver(std::move(link), clock, make_session(options), linuxcnc::console_words()),
      options_(std::move(options)) {
    if (options_.program_folder.empty()) {
        options_.program_folder = std::filesystem::temp_directory_path();
    }
}

LinuxCncDriver::~LinuxCncDriver() {
    close();
    remove_program();
}

ShellSession& LinuxCncDriver::talk() const {
    return static_cast<ShellSession&>(session());
}

void LinuxCncDriver::remove_program() {
    std::error_code ignored;
    if (!program_file_.empty()) {
        std::filesystem::remove(program_file_, ignored);
    }
}

Capabilities LinuxCncDriver::capabilities() const {
    using kinematics::AxisKind;
    Capabilities able;
    able.takes = Capabilities::Takes::text;
    able.overrides = Capabilities::OverrideRange::feed;
    able.manual.jog = able.manual.home = able.manual.command = true;
    able.reports.spindle = false; // linuxcncrsh ends when it is asked for its spindle
    able.manual.jog_axes = "XYZ";
    able.dialect = gcode::Dialect::linuxcnc;
    for (const char letter : options_.axes) {
        able.axes.push_back({letter, letter >= 'X' ? AxisKind::linear : AxisKind::rotary});
    }
    return able;
}

void LinuxCncDriver::start(Work work) {
    expects(work.listing != nullptr, "LinuxCNC is given a program's text");
    const linuxcnc::ProgramFile file = linuxcnc::program_file(*work.listing, {}, ++programs_);
    remove_program();
    program_file_ = std::filesystem::absolute(options_.program_folder) /
                    fmt::format("millwright-{}-{}.ngc", ::getpid(), programs_);
    write_file(program_file_, file.text);
    const Turn turn(*this);
    talk().start(*work.listing, file, program_file_.string(), turn.now());
}

int LinuxCncDriver::command(const std::string& lines) {
    const Turn turn(*this);
    return talk().command(lines, turn.now());
}

} // namespace millwright::drivers
