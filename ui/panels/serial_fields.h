// Rate, parity and stop bits of a serial port, and the line ends of records, beside the field of the address.
#pragma once

#include "core/links/serial_link.h"
#include "ui/widgets/ui.h"

#include <optional>
#include <string>

namespace millwright::panels {

/// Nothing where `address` leads to no serial port, or says a rate that there is not.
[[nodiscard]] std::optional<links::SerialAddress> serial_port_of(const std::string& address);

/// The address as it was changed; nothing where it was not, or leads to no serial port. Data bits are kept.
[[nodiscard]] std::optional<std::string> serial_fields(widgets::Ui& ui, const std::string& address);

/// How a record ends: the bytes that were chosen in place of `ending`.
[[nodiscard]] std::optional<std::string> ending_field(widgets::Ui& ui, const std::string& ending);

} // namespace millwright::panels
