// One PMAC on the command line: a connection, and questions to it that Ctrl+C ends.
#pragma once

#include "app/command_line/watched_work.h"
#include "core/base/clock.h"
#include "core/pmac/driver/pmac_driver.h"
#include "core/pmac_service/card_talk.h"

#include <memory>
#include <string>

namespace millwright::app {

// What the command line reports to a person of a PMAC's protections and of the power of its motors.

/// Which protections the card has off, once it has reported that.
void warn_of_protections(const pmac::PmacDriver& driver, Clock& clock);

/// Drops the link, and tells what became of the motors' power. False if the card did not confirm it: that is
/// told, too.
bool part_from(pmac::PmacDriver& driver);

/// Connected, with the joint limits of `arm` (a name or a file) and with axis 5 where the card has a motor 5,
/// as a person wants it: nothing moves for long without us, so a slow line may be slow. Throws Error if no
/// PMAC answers.
[[nodiscard]] std::unique_ptr<pmac::PmacDriver>
connected_pmac(const std::string& port, const std::string& arm, SteadyClock& clock);

class PmacConnection {
public:
    /// As connected_pmac().
    PmacConnection(const std::string& port, const std::string& arm);
    PmacConnection(const PmacConnection&) = delete;
    PmacConnection& operator=(const PmacConnection&) = delete;
    /// What it gave power to has none afterwards, and that is reported.
    ~PmacConnection();

    /// For commands that set up motors. Ctrl+C throws Cancelled out of it once, so that what was begun can be
    /// put in order. It must not outlive this.
    [[nodiscard]] pmac::CardTalk card();
    /// Closes the loops of the arm's motors: only because a person looked and said so. Throws Error for an
    /// alarm or a motor that gets none.
    void give_power();
    /// Commands may close loops of motors without power: what they set up has none before.
    void let_lines_give_power();

private:
    std::string ask(const std::string& line);
    void check();
    void wait_for_rest();

    Interrupt interrupt_{Suspending::refused};
    SteadyClock clock_;
    std::unique_ptr<pmac::PmacDriver> driver_;
    bool cancelled_ = false;
};

} // namespace millwright::app
