// What a refusal says.
#pragma once

#include "core/base/error.h"

#include <functional>
#include <string>

namespace millwright::test {

/// The diagnostic of the Error that `what` throws; "none" if it throws none.
inline std::string reason(const std::function<void()>& what) {
    try {
        what();
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "none";
}

} // namespace millwright::test
