// Canonical commands as text, in the words and the order in which LinuxCNC's rs274 prints them, so that both
// can be compared line by line:
//     5 N..... STRAIGHT_FEED(1.0000, 2.0000, 0.0000, 0.0000, 0.0000, 0.0000)
// a running number, the N number of the program's line, the command with X Y Z A B C. U, V and W are appended
// from the first program on that moves one of them (rs274 has none).
#pragma once

#include "core/gcode/canon.h"

#include <functional>
#include <string>

namespace millwright::gcode {

class CanonPrinter final : public CanonSink {
public:
    /// Gets pieces of text of some kilobytes each, made of whole lines.
    using Write = std::function<void(std::string_view text)>;

    explicit CanonPrinter(Write write);
    CanonPrinter(const CanonPrinter&) = delete;
    CanonPrinter& operator=(const CanonPrinter&) = delete;
    ~CanonPrinter() override = default;

    void move(const Move& move, const SourceLine& now) override;
    void curve(const Curve& curve, const SourceLine& now) override;
    void command(const Command& command, const SourceLine& now) override;

    /// Hands over what is left.
    void flush();

private:
    void begin_line(const SourceLine& now);
    void end_line();
    void axes(const AxisValues& values);
    void argument(double value);

    Write write_;
    std::string text_;
    long number_ = 0;
    bool uvw_ = false;
};

} // namespace millwright::gcode
