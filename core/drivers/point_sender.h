// Positions on their way to a machine that takes one after the other: how they are written, and what comes
// back for each. What is sent when is the driver's. Lengths mm, angles degrees, times s.
#pragma once

#include "core/drivers/answer_lines.h"
#include "core/drivers/stream/record_format.h"
#include "core/kinematics/machine_model.h"
#include "core/program/program.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::drivers {

struct PointFormat {
    std::optional<RecordFormat> record = {}; ///< nothing: a line of coordinates each, after a heading
    double period = 1.0;                     ///< between two; the speed of a record is that of its way in it
    int decimals = 4;                        ///< of everything, 0 to 9
};

class PointSender {
public:
    /// Throws Error for decimals out of range, and for a record that the machine does not have.
    PointSender(PointFormat format, const kinematics::MachineModel& model);

    /// Whether each position is answered before the next is sent.
    [[nodiscard]] bool asks() const { return format_.record && !format_.record->answer.empty(); }
    [[nodiscard]] bool writes_records() const { return text_.has_value(); }
    /// Throws Error if `program` moves an axis of `model` that no record tells.
    void expect_all_told(const program::Program& program, const kinematics::MachineModel& model) const;

    /// What is sent before the first position; empty for records.
    [[nodiscard]] const std::string& heading() const { return heading_; }
    /// The machine stands here, and owes no answer.
    void begin(const kinematics::AxisPositions& position);
    /// What takes it to `position`, with its ending. It owes an answer from now on, if it gives any.
    [[nodiscard]] std::string to(const kinematics::AxisPositions& position);
    /// The same as one move that the machine plans: its speed in mm/s, its acceleration in mm/s^2.
    [[nodiscard]] std::string
    to(const kinematics::AxisPositions& position, double speed, double acceleration);
    /// `position` as a line of coordinates.
    [[nodiscard]] std::string line(const kinematics::AxisPositions& position) const;

    enum class Answer { right, wrong, unasked };
    struct Heard {
        Answer kind;
        std::string line;
    };
    [[nodiscard]] bool owed() const { return owed_; }
    /// The next line of what came, `bytes` at last.
    [[nodiscard]] std::optional<Heard> hear(std::string_view bytes = {});
    /// Forgets what came and is no whole line yet.
    void forget_bytes() { inbox_.clear(); }

private:
    [[nodiscard]] std::vector<double> values_of(const kinematics::AxisPositions& position) const;
    [[nodiscard]] std::string written(const Record& record);

    PointFormat format_;
    std::string heading_;
    std::optional<RecordText> text_;
    RecordPath path_;
    std::vector<bool> linear_; ///< of each axis
    AnswerLines inbox_;
    bool owed_ = false; ///< an answer to the last position
};

} // namespace millwright::drivers
