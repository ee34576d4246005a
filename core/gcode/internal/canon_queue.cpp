#include "core/gcode/internal/canon_queue.h"

#include "core/gcode/internal/refusal.h"

#include <fmt/format.h>

namespace millwright::gcode::internal {

namespace {

/// Moves of a line beyond these count together, over the whole program.
constexpr int few_moves = 100;
constexpr int most_further_moves = 100'000'000;

} // namespace

void CanonQueue::count_move() {
    if (++moves_ <= few_moves) {
        return;
    }
    if (moves_ > most_moves_) {
        refuse_line();
    }
    if (++further_moves_ > most_further_moves) {
        refuse_program();
    }
}

void CanonQueue::expect_room_for(double count) const {
    if (count > most_moves_ - moves_) {
        refuse_line();
    }
    if (count - few_moves > most_further_moves - further_moves_) {
        refuse_program();
    }
}

void CanonQueue::refuse_line() const {
    refuse(1, fmt::format("a line may generate at most {} moves", most_moves_));
}

void CanonQueue::refuse_program() {
    refuse(1, fmt::format("a program may generate at most {} canned-cycle moves", most_further_moves));
}

void CanonQueue::send(const Move& move) {
    count_move();
    sink_->move(move, now_);
}

void CanonQueue::send(const Curve& curve) {
    count_move();
    sink_->curve(curve, now_);
}

void CanonQueue::send(Command command) {
    if (command.source.line == 0) {
        command.source = now_.place;
    }
    sink_->command(command, now_);
}

void CanonQueue::send(CommandKind kind, int index, double value) {
    send(command_of(kind, index, value));
}

void CanonQueue::post(Command command) {
    if (waiting_.empty()) {
        send(std::move(command));
        return;
    }
    Waiting waiting;
    waiting.is_move = false;
    waiting.text = std::string(command.text);
    command.source = now_.place;
    command.text = {};
    waiting.command = std::move(command);
    waiting_.push_back(std::move(waiting));
}

void CanonQueue::post(CommandKind kind, int index, double value) {
    post(command_of(kind, index, value));
}

Command command_of(CommandKind kind, const AxisValues& axes, int index) {
    Command command = command_of(kind, index);
    command.axes = axes;
    return command;
}

Command command_of(CommandKind kind, std::string_view text) {
    Command command = command_of(kind);
    command.text = text;
    return command;
}

} // namespace millwright::gcode::internal
