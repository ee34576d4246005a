#include "core/machine/drivers_by_name.h"

#include "core/base/error.h"
#include "core/machine/internal/driver_rows.h"

#include <algorithm>
#include <array>

namespace millwright::machine {

namespace {

/// "a, b or c".
std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t n = 0; n < names.size(); ++n) {
        text += (n == 0 ? "" : n + 1 == names.size() ? " or " : ", ") + names[n];
    }
    return text;
}

} // namespace

void expect_model(const MovedAxes& axes) {
    if (!axes.model) {
        throw Error("no machine is loaded whose axes could be moved");
    }
}

std::span<const DriverRow> driver_rows() {
    static const std::array rows{
        virtual_row, grbl_row, linuxcnc_row, stream_row, cordic_row, records_row, pmac_row};
    return rows;
}

const DriverRow& driver_row(std::string_view name) {
    const std::span<const DriverRow> rows = driver_rows();
    const auto found = std::ranges::find(rows, name, &DriverRow::name);
    if (found == rows.end()) {
        throw Error("there is no driver '" + std::string(name) + "'", {}, "use " + listed(driver_names()));
    }
    return *found;
}

std::vector<std::string> driver_names(bool (*fits)(const DriverRow&)) {
    std::vector<std::string> names;
    for (const DriverRow& row : driver_rows()) {
        if (fits == nullptr || fits(row)) {
            names.emplace_back(row.name);
        }
    }
    return names;
}

std::unique_ptr<drivers::Driver>
make_driver(const DriverChoice& choice, const MovedAxes& axes, Clock& clock) {
    return driver_row(choice.driver).make(choice, axes, clock);
}

} // namespace millwright::machine
