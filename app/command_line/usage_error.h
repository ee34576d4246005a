// What was asked for cannot be meant: an option is missing, or does not go with the others. Exit code 2.
#pragma once

#include "core/base/error.h"

namespace millwright::app {

class UsageError final : public Error {
public:
    using Error::Error;
};

} // namespace millwright::app
