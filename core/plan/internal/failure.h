// What a piece of work in the background failed at, for people.
#pragma once

#include "core/base/error.h"

#include <fmt/format.h>

#include <exception>
#include <optional>

namespace millwright::plan {

/// What is reported to a person about a failure that is ours, not theirs.
[[nodiscard]] inline Diagnostic internal_failure(const std::exception& failure) {
    return {{}, fmt::format("internal error: {}", failure.what()), "report it together with the file"};
}

/// Runs `work`; gives what went wrong, if anything did. Cancelled goes through.
template <class Work> std::optional<Diagnostic> failure_of(Work work) {
    try {
        work();
    } catch (const Error& error) {
        return error.diagnostic();
    } catch (const std::exception& failure) {
        return internal_failure(failure);
    }
    return std::nullopt;
}

} // namespace millwright::plan
