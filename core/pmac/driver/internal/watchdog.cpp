#include "core/pmac/driver/internal/watchdog.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::pmac::internal {

namespace {

std::string enabled(const PmacSettings& settings) {
    std::string condition;
    for (const PmacAxis& axis : settings.axes) {
        condition += fmt::format("{}M{}=1", condition.empty() ? "" : " AND ", 1000 + axis.motor);
    }
    return condition;
}

} // namespace

std::vector<std::string> watchdog_lines(const PmacSettings& settings, double servo_time) {
    constexpr double shortest = 232'107.0, longest = 8'388'607.0; // what jumpers give, and 23 bits hold
    if (!(servo_time >= shortest && servo_time <= longest)) {
        throw Error(fmt::format("the card reports I10 = {:.0f}, which is not a valid servo time of a PMAC",
                                servo_time),
                    {},
                    "set I10 to the length of a servo cycle, which depends on the card's jumpers: 3713707 "
                    "with factory jumpers");
    }
    constexpr double units_per_ms = 8'388'608.0;
    const double cycle = servo_time / units_per_ms / 1000.0; // s
    std::vector<std::string> lines{"P1001=0", "CLOSE", "DISABLE PLC 0..31", "I5=2", "M1000->X:$0,0,24"};
    for (const PmacAxis& axis : settings.axes) { // amplifier enabled, in the motors' status words
        constexpr int first = 0x814, step = 0xC0;
        lines.push_back(fmt::format("M{}->Y:${:X},14", 1000 + axis.motor, first + step * (axis.motor - 1)));
    }
    for (const std::string& line :
         {std::string("OPEN PLC 31"),
          std::string("CLEAR"),
          // what a report shows of it: it runs, and its clock does; negative while it is disarmed
          std::string("IF(M1000!=P1004)"),
          std::string("P1004=M1000"),
          std::string("P1003=ABS(P1003)+1"),
          std::string("IF(P1003>9999)"),
          std::string("P1003=1"),
          std::string("ENDIF"),
          std::string("IF(P1001!=1)"),
          std::string("P1003=0-P1003"),
          std::string("ENDIF"),
          std::string("ENDIF"),
          std::string("IF(P1001=1)"),
          std::string("P1005=M1000-P1002"),
          std::string("IF(P1005<0)"),
          std::string("P1005=P1005+16777216"),
          std::string("ENDIF"),
          fmt::format("IF(P1005>{:.0f} AND P1006=0)", std::floor(settings.abort_after / cycle)),
          std::string("P1006=1"),
          fmt::format("P1000={:.0f}", heard_nothing),
          // an abort closes the loops of killed motors: never then
          fmt::format("IF({})", enabled(settings)),
          fmt::format("CMD\"&{}A\"", settings.system),
          std::string("ELSE"),
          std::string("CMD^K"),
          std::string("ENDIF"),
          std::string("ENDIF"),
          fmt::format("IF(P1005>{:.0f})", std::floor(settings.kill_after / cycle)),
          std::string("CMD^K"),
          std::string("P1001=0"),
          std::string("ENDIF"),
          std::string("ENDIF"),
          std::string("CLOSE"),
          std::string("ENABLE PLC 31")}) {
        lines.push_back(line);
    }
    return lines;
}

} // namespace millwright::pmac::internal
