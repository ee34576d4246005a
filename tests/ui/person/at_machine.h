// What a person does at the Machine workspace before anything else.
#pragma once

#include "core/drivers/console.h"
#include "tests/ui/person/grbl_bench.h"
#include "tests/ui/person/person.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace millwright::test {

[[nodiscard]] inline bool machine_is(Person& person, drivers::DriverState state) {
    const auto machine = person.app().look().connection;
    return machine.connected() && machine.status.state == state;
}

/// To the machine that the view state names; a machine that begins locked is unlocked.
inline void connect(Person& person) {
    person.app().run("view.machine");
    person.frames(3);
    person.click("inspector/connection/machine_connect");
    ASSERT_TRUE(person.live_until([&] { return person.app().look().connection.connected(); }));
    if (machine_is(person, drivers::DriverState::alarm)) {
        person.app().run("machine.reset");
    }
    ASSERT_TRUE(person.live_until([&] { return machine_is(person, drivers::DriverState::idle); }));
}

inline void connect(Person& person, GrblBench& grbl) {
    person.app().view_state().manual.choice.driver = "grbl";
    person.app().view_state().manual.choice.address = grbl.port();
    connect(person);
}

/// Runs what is shown, or what waits in the queue, and says yes to the question before a machine moves.
inline void press_run(Person& person, const std::string& button = "inspector/job/machine_run") {
    const std::string start = "dialogs/start/start_go";
    ASSERT_TRUE(person.click_when_offered(button)) << button << ": " << person.refusal(button);
    ASSERT_TRUE(person.click_when_offered(start))
        << (person.sees(start) ? person.refusal(start) : "not asked");
    ASSERT_TRUE(person.live_until([&] { return !person.sees(start); })) << person.refusal(start);
}

/// What was sent and received, and what machine and job are doing: for the message of a failed test.
[[nodiscard]] inline std::string conversation(Person& person) {
    const auto now = person.app().look();
    std::string text = "state " + std::string(to_text(now.connection.status.state)) + ", " +
                       now.connection.status.message +
                       (now.job.outcome ? "; job: " + now.job.outcome->sentence : "; no outcome") +
                       (now.view_state.start ? "; the question is still open" : "");
    std::vector<drivers::ConsoleLine> lines;
    if (now.console) {
        (void)now.console->read(0, lines);
    }
    for (const drivers::ConsoleLine& line : lines) {
        text += (line.sent ? "\n> " : "\n< ") + line.text;
    }
    return text;
}

} // namespace millwright::test
