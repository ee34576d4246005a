#include "core/pmac/driver/pmac_driver.h"

#include "core/base/error.h"
#include "core/drivers/console_tap.h"
#include "core/pmac/driver/internal/command_kind.h"
#include "core/pmac/driver/internal/pmac_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace millwright::pmac {

using internal::PmacSession;

namespace {

/// On-line commands and words of buffers.
constexpr std::array<std::string_view, 44> command_words{
    "ABS",      "BLOCKSTART", "BLOCKSTOP", "CIRCLE1",     "CIRCLE2",  "CLEAR",     "CLOSE",      "CMD",
    "DELAY",    "DELETE",     "DISABLE",   "DISABLE PLC", "DWELL",    "ENABLE",    "ENABLE PLC", "ENDIF",
    "ENDWHILE", "ELSE",       "FRAX",      "GOSUB",       "GOTO",     "HM",        "HMZ",        "HOME",
    "HOMEZ",    "INC",        "LINEAR",    "LIST",        "LIST PLC", "LIST PROG", "NORMAL",     "OPEN",
    "OPEN PLC", "OPEN PROG",  "PSET",      "RAPID",       "RETURN",   "SEND",      "SIZE",       "STOP",
    "TYPE",     "UNDEFINE",   "VERSION",   "WHILE"};

PmacSettings checked_settings(PmacSettings settings) {
    std::set<char> letters;
    std::set<int> motors;
    for (const PmacAxis& axis : settings.axes) {
        const bool sound = std::string_view("XYZABCUVW").find(axis.letter) != std::string_view::npos &&
                           axis.motor >= 1 && axis.motor <= 8 && std::isfinite(axis.counts_per_degree) &&
                           axis.counts_per_degree > 0.0 && axis.jog_deg_per_s > 0.0;
        if (!sound || !letters.insert(axis.letter).second || !motors.insert(axis.motor).second) {
            throw Error(std::string("a PMAC does not support this axis ") + axis.letter,
                        {},
                        "use letters from XYZABCUVW and motors 1 to 8, each once, with a positive scale");
        }
    }
    if (settings.axes.empty() || settings.system < 1 || settings.system > 8) {
        throw Error("a PMAC can move one to eight axes in the coordinate systems 1 to 8");
    }
    return settings;
}

std::vector<std::string> nonempty_lines(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string line(text.substr(0, end));
        line.erase(line.find_last_not_of(" \t\r") + 1);
        if (!line.empty()) {
            lines.push_back(std::move(line));
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

} // namespace

PmacDriver::PmacDriver(std::unique_ptr<links::Link> link, const Clock& clock, PmacSettings settings)
    : drivers::SessionDriver(std::move(link),
                             clock,
                             std::make_unique<PmacSession>(checked_settings(settings)),
                             drivers::ConsoleWords()),
      settings_(std::move(settings)) {}

PmacDriver::~PmacDriver() {
    close();
}

PmacSession& PmacDriver::talk() const {
    return static_cast<PmacSession&>(session());
}

drivers::Capabilities PmacDriver::capabilities() const {
    drivers::Capabilities able;
    able.words = command_words;
    able.takes = drivers::Capabilities::Takes::text;
    able.overrides = drivers::Capabilities::OverrideRange::feed;
    able.manual.jog = able.manual.power = able.manual.home = able.manual.command = true;
    for (const PmacAxis& axis : settings_.axes) {
        able.axes.push_back({axis.letter, kinematics::AxisKind::rotary});
    }
    return able;
}

drivers::MachineLimits PmacDriver::limits() const {
    const std::scoped_lock lock(session_mutex());
    const bool connected = talk().greeted() && talk().status().state != drivers::DriverState::disconnected;
    return connected ? drivers::MachineLimits{talk().limits(), {}} : drivers::MachineLimits{};
}

void PmacDriver::start(drivers::Work work) {
    expects(work.listing != nullptr, "a PMAC is given a program's text");
    const std::vector<std::string> lines = nonempty_lines(work.listing->text);
    const Turn turn(*this);
    talk().start(lines, turn.now());
}

int PmacDriver::command(const std::string& lines) {
    const Turn turn(*this);
    return talk().command(nonempty_lines(lines), false);
}

std::vector<std::string> PmacDriver::kept_lines() const {
    const std::scoped_lock lock(session_mutex());
    return talk().kept_lines();
}

bool PmacDriver::needs_rest(const std::string& lines) {
    const std::vector<std::string> all = nonempty_lines(lines);
    return !std::all_of(all.begin(), all.end(), internal::only_asks) &&
           !std::all_of(all.begin(), all.end(), [](const std::string& line) {
               return internal::only_stops(line) || internal::only_kills(line) ||
                      internal::only_disables_plcs(line) || line.starts_with('^');
           });
}

int PmacDriver::load(const std::vector<std::string>& lines) {
    const Turn turn(*this);
    return talk().load(lines);
}

void PmacDriver::enable() {
    const Turn turn(*this);
    talk().enable(turn.now());
}

void PmacDriver::let_lines_give_power() {
    const Turn turn(*this);
    talk().let_lines_give_power();
}

void PmacDriver::set_parting(Parting parting) {
    const std::scoped_lock lock(session_mutex());
    talk().set_parting(parting);
}

bool PmacDriver::position_known() const {
    const std::scoped_lock lock(session_mutex());
    return talk().position_known();
}

bool PmacDriver::enabled() const {
    const std::scoped_lock lock(session_mutex());
    return talk().enabled();
}

std::string PmacDriver::farewell() const {
    const std::scoped_lock lock(session_mutex());
    return talk().farewell();
}

bool PmacDriver::any_power() const {
    const std::scoped_lock lock(session_mutex());
    return talk().any_power();
}

std::optional<std::vector<std::string>> PmacDriver::protections_off() const {
    const std::scoped_lock lock(session_mutex());
    return talk().protections_off();
}

} // namespace millwright::pmac
