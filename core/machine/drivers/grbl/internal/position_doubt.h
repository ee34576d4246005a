// Whether the position that a controller reports can still be that of its machine. Grbl counts the steps it
// sends: cut off in motion or switched off, it goes on counting from wherever it is, and says nothing.
#pragma once

#include <string>
#include <string_view>

namespace millwright::machine::grbl {

class PositionDoubt {
public:
    /// `why`: a part of a sentence, as "the controller was reset". The last reason is the one that is told.
    void arise(std::string why);
    /// A person has given these axes a zero where the tool stands. All three end the doubt.
    void zeroed(std::string_view axes);
    /// The machine was homed, or a person says that it stands where the controller says.
    void end() { *this = {}; }

    /// Empty: nothing speaks against the position.
    [[nodiscard]] const std::string& why() const { return why_; }

private:
    std::string why_, zeroed_;
};

/// Letters of the axes that get their zero by this line, which is without blanks and in capitals: the axes
/// of a G92 or G10 L20.
[[nodiscard]] std::string axes_zeroed_by(std::string_view line);

} // namespace millwright::machine::grbl
