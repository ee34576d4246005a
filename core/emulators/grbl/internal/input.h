// The receive buffer of an emulated Grbl and the lines that come out of it.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace millwright::emulators::internal {

// The serial line into an emulated Grbl: when a byte has arrived, and which bytes are lost while the
// processor has its interrupts off. s.

class SerialLine {
public:
    /// When a byte that is sent at `now` has arrived: bytes follow each other at 115,200 baud.
    [[nodiscard]] double arrival(double now);
    /// Interrupts are off from `begin`, for each of `pauses` in turn, and on for a moment between two pauses.
    void interrupts_off(double begin, const std::vector<double>& pauses);
    /// False: the byte that arrives then is lost, because the UART holds two bytes that have not been
    /// fetched. To be asked once per byte, in the order of arrival.
    [[nodiscard]] bool takes(double arrival);

private:
    struct Pause {
        double end = 0.0;
        int held = 0; ///< bytes in the UART
    };

    double last_arrival_ = 0.0;
    double begin_ = 0.0; ///< of the pauses
    std::vector<Pause> pauses_;
};

struct InputLine {
    std::string text;      ///< without blanks and comments, in capitals
    bool too_long = false; ///< then the text is cut off
    double arrived = 0.0;  ///< when its end had arrived, s
};

class Input {
public:
    /// `slashes`: they are a part of $ lines; elsewhere they are read over.
    Input(int capacity, std::size_t longest_line, bool slashes)
        : capacity_(capacity), longest_line_(longest_line), slashes_(slashes) {}

    [[nodiscard]] int capacity() const { return capacity_; }
    [[nodiscard]] int free_bytes() const { return capacity_ - static_cast<int>(bytes_.size()); }
    /// The line that comes in now begins with $.
    [[nodiscard]] bool in_system_line() const;
    [[nodiscard]] bool empty() const { return bytes_.empty(); }
    /// `arrived`: when, s. False if there is no room: the byte is lost.
    bool push(char byte, double arrived);
    /// Takes out the bytes for which `lost` of their time of arrival holds; returns how many.
    int lose(const std::function<bool(double arrived)>& lost);
    /// Reads until the end of a line, or of what there is.
    [[nodiscard]] std::optional<InputLine> take_line();
    void clear();

private:
    enum class Comment { none, parentheses, to_end };
    struct Byte {
        char value = ' ';
        double arrived = 0.0;
    };
    void add(char byte);

    int capacity_;
    std::size_t longest_line_;
    bool slashes_;
    std::deque<Byte> bytes_;
    InputLine line_;
    Comment comment_ = Comment::none;
};

} // namespace millwright::emulators::internal
