// What reading and writing by Open CASCADE have in common: its own failures as ours, its messages silent, one
// caller at a time, because its settings are global.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"

#include <Message_ProgressIndicator.hxx>
#include <Standard_Failure.hxx>
#include <fmt/format.h>

#include <filesystem>
#include <mutex>
#include <streambuf>
#include <string>

namespace millwright::exchange {

/// Held while the library is at work.
class OcctTurn {
public:
    OcctTurn();

private:
    std::unique_lock<std::mutex> turn_;
};

/// Passes the library's reports on, and that the user said stop.
class OcctProgress final : public Message_ProgressIndicator {
public:
    explicit OcctProgress(Progress progress) : progress_(std::move(progress)) {}

protected:
    Standard_Boolean UserBreak() override { return progress_.cancelled() ? Standard_True : Standard_False; }
    void Show(const Message_ProgressScope&, Standard_Boolean) override { progress_.report(GetPosition()); }

private:
    Progress progress_;
};

/// Calls `work`; what the library throws becomes an Error about `file`.
template <typename Work> auto with_occt(const std::filesystem::path& file, Work work) {
    const OcctTurn turn;
    try {
        return work();
    } catch (const Standard_Failure& failure) {
        const char* const reason = failure.GetMessageString();
        throw Error(
            fmt::format("Open CASCADE failed: {}",
                        reason != nullptr && *reason != '\0' ? reason : failure.DynamicType()->Name()),
            file);
    }
}

// A text that is read as a stream, and tells how far.

/// `text` must outlive it. `afterwards`: what is being done once all of it is given.
class ProgressStream final : public std::streambuf {
public:
    ProgressStream(const std::string& text, Progress progress, std::string afterwards);

protected:
    int_type underflow() override;

private:
    const std::string& text_;
    Progress progress_;
    std::string afterwards_;
    std::size_t given_ = 0;
};

} // namespace millwright::exchange
