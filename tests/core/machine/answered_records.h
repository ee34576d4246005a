// The records of a table that answers each of them.
#pragma once

#include "core/machine/drivers/stream/record_format.h"

namespace millwright::test {

inline machine::RecordFormat answered_records(bool relative = false) {
    machine::RecordFormat format;
    format.relative = relative;
    format.answer = "ok";
    return format;
}

} // namespace millwright::test
