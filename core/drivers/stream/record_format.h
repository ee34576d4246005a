// Records of a machine that takes its targets in a format of its own, as `t x y z a s` of the motion unit in
// the KMITL master's thesis of 2006 (forming software for wood and plastic). Lengths mm, angles degrees,
// times s.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/program/program.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::drivers {

struct RecordFormat {
    /// Text, with the letter of each axis in braces, {s} the speed of the linear axes together (mm/s), {a} by
    /// how much it changes (mm/s^2).
    std::string pattern = "t {X} {Y} {Z} {a} {s}";
    std::string ending = "\n"; ///< of a record
    bool relative = false;     ///< axes say how far, not where
    std::string answer = {};   ///< what comes back for each record before the next is sent; empty: nothing
    double patience = 5.0;     ///< an answer takes no longer, s, > 0

    friend bool operator==(const RecordFormat&, const RecordFormat&) = default;
};

/// What a record says, in its digits.
struct Record {
    std::vector<double> axes; ///< of the machine, in its order; those that the pattern leaves out are 0
    double acceleration = 0.0;
    double speed = 0.0;
};

/// Writes and reads records of one machine.
class RecordText {
public:
    /// Throws Error quoting what is wrong in the pattern: an axis that the machine lacks, a brace that is not
    /// closed, no axis at all, a line end; or for an invalid patience.
    RecordText(const RecordFormat& format, const kinematics::MachineModel& model, int decimals);

    /// Without its ending. Throws Defect unless finite.
    [[nodiscard]] std::string written(const Record& record) const;
    /// Nothing if the line is no such record.
    [[nodiscard]] std::optional<Record> read(std::string_view line) const;
    /// Throws Error if `program` moves an axis of `model` that no record tells: it would stay where it is.
    void expect_all_told(const program::Program& program, const kinematics::MachineModel& model) const;

private:
    /// A value, and the text in front of it.
    struct Field {
        std::string before;
        int axis = -1;
        char other = 0; ///< 'a' or 's'
    };

    std::vector<Field> fields_;
    std::string behind_;
    std::size_t axes_;
    int decimals_;
};

/// Where the machine was sent so far, in whole units of the last digit, so that relative records never drift.
class RecordPath {
public:
    RecordPath(bool relative, double period, int decimals)
        : relative_(relative), period_(period), unit_(unit_of(decimals)) {}

    /// The machine stands here: mm and degrees.
    void begin(const std::vector<double>& position);
    /// The record that takes it to `position` within a period; `linear` says which axes count for the speed.
    [[nodiscard]] Record to(const std::vector<double>& position, const std::vector<bool>& linear);

private:
    static double unit_of(int decimals);
    [[nodiscard]] std::vector<std::int64_t> in_units(const std::vector<double>& position) const;

    bool relative_;
    double period_;
    double unit_;
    std::vector<std::int64_t> at_;
    double speed_ = 0.0;
};

} // namespace millwright::drivers
