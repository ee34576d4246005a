// Collects what is wrong in a file; strict reading ends at the first.
#pragma once

#include "core/hpgl/reader.h"

#include <string>

namespace millwright::hpgl::internal {

class Problems {
public:
    Problems(std::filesystem::path file, const HpglSettings& settings)
        : file_(std::move(file)), strict_(settings.strictness == Strictness::strict),
          most_(settings.most_diagnostics) {}

    /// Throws Error if reading strictly.
    void add(std::int64_t byte, std::string message, std::string hint = {}) {
        Diagnostic found = at(byte, std::move(message), std::move(hint));
        if (strict_) {
            throw Error(std::move(found));
        }
        if (std::ssize(found_) < most_) {
            found_.push_back(std::move(found));
        } else {
            ++more_;
        }
    }
    [[nodiscard]] Diagnostic at(std::int64_t byte, std::string message, std::string hint = {}) const {
        return {
            .place = {.file = file_, .byte = byte}, .message = std::move(message), .hint = std::move(hint)};
    }

    [[nodiscard]] std::vector<Diagnostic> take() { return std::move(found_); }
    [[nodiscard]] std::int64_t more() const { return more_; }

private:
    std::filesystem::path file_;
    bool strict_;
    int most_;
    std::vector<Diagnostic> found_;
    std::int64_t more_ = 0;
};

} // namespace millwright::hpgl::internal
