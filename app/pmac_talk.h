// One PMAC on the command line: a connection, and questions to it that Ctrl+C ends.
#pragma once

#include "app/interrupt.h"
#include "core/machine/clock.h"
#include "core/machine/drivers/pmac/pmac_driver.h"
#include "core/machine/service/card_talk.h"

#include <string>

namespace millwright::app {

class PmacTalk {
public:
    /// Throws Error if nobody answers as a PMAC.
    explicit PmacTalk(const std::string& port);

    /// For commands that set up motors. Ctrl+C throws Cancelled out of it once, so that what was begun can be
    /// put in order. It must not outlive this.
    [[nodiscard]] machine::CardTalk card();

private:
    std::string ask(const std::string& line);
    void check();

    Interrupt interrupt_;
    machine::SteadyClock clock_;
    machine::PmacDriver driver_;
    bool cancelled_ = false;
};

/// As a person wants it: nothing moves for long without us, so a slow line may be slow.
[[nodiscard]] machine::PmacSettings patient_settings();

} // namespace millwright::app
