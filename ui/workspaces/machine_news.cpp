#include "ui/workspaces/machine_news.h"

#include "core/base/sentences.h"
#include "core/pmac/driver/pmac_driver.h"
#include "core/pmac/driver/protections.h"
#include "core/pmac/driver/refused_lines.h"

#include <utility>

namespace millwright::actions {

void MachineNews::follow(const ConnectionView& machine,
                         const std::shared_ptr<drivers::Driver>& driver,
                         ViewState& view_state) {
    log_messages(machine, view_state);
    tell_protections(driver, view_state);
    tell_answer(machine, view_state);
}

void MachineNews::sent(int answer, pmac::PmacFile file) {
    sent_ = SentFile{answer, std::move(file)};
}

/// What banners say as long as it is so: alarms with their reason, a lost link, why nothing could be
/// connected.
void MachineNews::log_messages(const ConnectionView& machine, ViewState& view_state) {
    const auto log = [&](std::string& last, const std::string& now, const std::string& before) {
        if (now != std::exchange(last, now) && !now.empty()) {
            view_state.log.push_back(before + as_sentence(now));
        }
    };
    const bool alarm = machine.connected() && machine.status.state == drivers::DriverState::alarm;
    const std::string& message = machine.status.message;
    log(message_,
        alarm && message.empty() ? "the controller gave no reason"
        : machine.connected()    ? message
                                 : std::string(),
        alarm ? "Alarm: " : "");
    log(failure_, machine.failure ? machine.failure->message : std::string(), "");
}

/// When it is connected, and again when its motors get power.
void MachineNews::tell_protections(const std::shared_ptr<drivers::Driver>& driver, ViewState& view_state) {
    const auto* const card = dynamic_cast<const pmac::PmacDriver*>(driver.get());
    if (card == nullptr) {
        protections_off_.clear();
        driver_.reset();
        return;
    }
    if (driver_.lock() != driver) {
        driver_ = driver;
        told_ = false;
        powered_ = card->enabled();
    }
    const bool powered = card->enabled();
    told_ = told_ && !(powered && !std::exchange(powered_, powered));
    powered_ = powered;
    if (auto off = card->protections_off()) {
        protections_off_ = std::move(*off);
        if (!std::exchange(told_, true) && !protections_off_.empty()) {
            tell(view_state, widgets::Severity::warning, pmac::protections_notice(protections_off_));
        }
    }
}

void MachineNews::tell_answer(const ConnectionView& machine, ViewState& view_state) {
    const drivers::CommandAnswer& answer = machine.status.answer;
    if (!sent_ || !machine.connected() || answer.number != sent_->answer ||
        answer.state == drivers::CommandAnswer::State::pending) {
        return;
    }
    const SentFile sent = *std::exchange(sent_, std::nullopt);
    answer.text.empty()
        ? tell(view_state, widgets::Severity::info, "The card accepted all settings.")
        : tell(view_state,
               widgets::Severity::warning,
               "The card rejected settings: " + pmac::with_line_numbers(answer.text, sent.file, "line "));
}

} // namespace millwright::actions
