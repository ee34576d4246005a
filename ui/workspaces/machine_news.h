// What the connected machine reports once, whoever looks at the time: it goes into the log, and what a person
// has to know before anything moves is shown.
#pragma once

#include "core/pmac/driver/pmac_file.h"
#include "ui/workspaces/machine_connection.h"
#include "ui/workspaces/view_state.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::actions {

class MachineNews {
public:
    /// Once per frame. `driver`: null unless one is connected.
    void follow(const ConnectionView& machine,
                const std::shared_ptr<drivers::Driver>& driver,
                ViewState& view_state);
    /// A file of settings went to the card, whose answer has the number `answer`.
    void sent(int answer, pmac::PmacFile file);
    /// Of the connected card, a sentence for each; as last reported.
    [[nodiscard]] const std::vector<std::string>& protections_off() const { return protections_off_; }

private:
    void log_messages(const ConnectionView& machine, ViewState& view_state);
    void tell_protections(const std::shared_ptr<drivers::Driver>& driver, ViewState& view_state);
    void tell_answer(const ConnectionView& machine, ViewState& view_state);

    struct SentFile {
        int answer = 0;
        pmac::PmacFile file;
    };

    std::string message_, failure_; ///< that were logged last
    std::weak_ptr<drivers::Driver> driver_;
    bool told_ = false;    ///< its protections
    bool powered_ = false; ///< its motors, when it was last looked at
    std::vector<std::string> protections_off_;
    std::optional<SentFile> sent_;
};

} // namespace millwright::actions
