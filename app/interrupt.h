// Ctrl+C, asking politely: the first SIGINT, SIGTERM or SIGQUIT, or a terminal that is closed, asks the work
// to stop; another one, half a second later or more, ends the program.
#pragma once

#include <stop_token>
#include <thread>

namespace millwright::app {

/// Made before any other thread, so that all of them leave these signals to this one. The signals act as
/// before once it is gone.
class Interrupt {
public:
    Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;
    ~Interrupt();

    [[nodiscard]] std::stop_token token() const { return asked_.get_token(); }

private:
    void listen() const;

    std::stop_source asked_;
    int signals_ = -1; ///< readable when a signal came
    int over_ = -1;    ///< readable when nobody listens any more
    std::jthread thread_;
};

} // namespace millwright::app
