// The processor at work in a machine with logic beside it: a motion controller moves the axes along the
// records at their programmed speeds, the logic is scanned at a fixed period and may hold, start and stop the
// motion. The processor is clocked only while the controller has room for another record, so that all three
// keep step. Times s.
#pragma once

#include "core/cordic/processor.h"
#include "core/cordic_control/plc.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace millwright::cordic {

struct SupervisedSettings {
    double clock_hz = 8e6;
    double scan_seconds = 1e-3; ///< period of the logic
    int records_ahead = 4;      ///< that the motion controller takes before it has executed them
    double most_seconds = 3600.0;
    std::array<double, 3> start{}; ///< where the axes are, mm
    std::vector<InputChange> inputs;
    std::span<const CodeLine> lines; ///< of the program, for the place in diagnostics
    std::filesystem::path file;      ///< what it is called there
};

/// How a run ended.
enum class SupervisedEnd : std::uint8_t {
    finished,    ///< all records are executed, the processor has halted
    stopped,     ///< by the logic's STOP
    fault,       ///< the processor stands for another reason; what it had handed over is executed
    out_of_time, ///< SupervisedSettings::most_seconds
};

[[nodiscard]] std::string_view to_text(SupervisedEnd end);

/// Of an output or of HOLD, START, FIN, STOP.
struct OutputChange {
    double seconds = 0.0;
    PlcBit bit = 0;
    bool value = false;
};

struct SupervisedRun {
    SupervisedEnd end = SupervisedEnd::finished;
    double seconds = 0.0;
    double moved_seconds = 0.0;   ///< along records, and in dwells
    double held_seconds = 0.0;    ///< by HOLD
    double waited_seconds = 0.0;  ///< for START or FIN
    double starved_seconds = 0.0; ///< for the processor, behind its first record
    std::int64_t scans = 0;
    std::int64_t executed = 0; ///< set-points that the axes reached
    std::array<double, 3> position{};
    std::vector<OutputChange> outputs;
};

/// Runs `processor` from where it is. Throws Error for settings that are not positive and finite, and for a
/// command that the logic has no bit for.
[[nodiscard]] SupervisedRun
run_supervised(Processor& processor, Plc& plc, const SupervisedSettings& settings);

} // namespace millwright::cordic
