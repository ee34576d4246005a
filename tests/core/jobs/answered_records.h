// The records of a table that answers each of them.
#pragma once

#include "core/drivers/stream/record_format.h"

namespace millwright::test {

inline drivers::RecordFormat answered_records(bool relative = false) {
    drivers::RecordFormat format;
    format.relative = relative;
    format.answer = "ok";
    return format;
}

} // namespace millwright::test
