// The XYZ table of the KMITL thesis on an HPGL decoder and constant-velocity control: points that were
// computed before, one a sampling period. Lengths mm, times s.
#pragma once

#include "core/base/error.h"
#include "core/geometry/vectors.h"
#include "core/kinematics/machine_model.h"
#include "core/machine/clock.h"
#include "core/machine/drivers/answer_lines.h"
#include "core/machine/drivers/stream/record_format.h"
#include "core/machine/jitter.h"
#include "core/machine/links/link.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <vector>

namespace millwright::machine {

struct PlayerOptions {
    double period = 0.01; ///< between two points, 0.0005 to 10
    double speed = 1.0;   ///< times real time, 0.01 to 100
    RecordFormat format = {.pattern = "{X},{Y},{Z}"};
    int decimals = 4;
};

enum class PlayState {
    ready,
    playing,
    done,          ///< every point was sent
    stopped,       ///< by a person
    emergency_stop ///< or the link was lost, or the table complained; the sentence says which
};

struct PlayStatus {
    PlayState state = PlayState::ready;
    std::int64_t sent = 0;        ///< points
    std::int64_t points = 0;      ///< of these, that the table has: those that it answered, where it answers
    Vec3 position = Vec3::Zero(); ///< the last of them; before that the first that will be sent
    double time = 0.0;            ///< of the stream: points that the table has, times the period
    Jitter jitter;
    std::string sentence; ///< why it ended early
};

/// What the machine itself does in a period: for the eyes alone it goes no faster, however fast they are
/// shown.
[[nodiscard]] double machine_period(const PlayerOptions& options, bool linked);

/// The points that a machine must not be sent: outside of its limits, or faster than its axes go from one to
/// the next, as a player writes them. A sentence each, with the line in `file`; the first of each kind and
/// axis. Throws Error if the machine has no X, Y, Z.
[[nodiscard]] std::vector<Diagnostic> check_points(const std::vector<Vec3>& points,
                                                   double period,
                                                   const kinematics::MachineModel& model,
                                                   const std::filesystem::path& file);

/// Times are counted from the first point, so that delays do not add up. A late point is sent at once, and
/// the next one in its own time. Where the format names an answer no point is sent before the table has
/// answered the one before; it stops where that takes longer than the format's patience.
class PointPlayer {
public:
    /// Without a link it plays for the eyes alone. `clock` must outlive it. Throws Error for options out of
    /// range and records that the machine does not have, or if there are no points.
    PointPlayer(std::unique_ptr<Link> link,
                Clock& clock,
                std::shared_ptr<const std::vector<Vec3>> points,
                const kinematics::MachineModel& model,
                const PlayerOptions& options = {});
    PointPlayer(const PointPlayer&) = delete;
    PointPlayer& operator=(const PointPlayer&) = delete;
    ~PointPlayer();

    using Listener = std::function<void(const PlayStatus&)>;

    /// Plays to the end, or to an emergency stop, which `stop` is too; blocks. The listener is called from
    /// here, now and then. Throws Error if there is nothing at the other end, or if it was played before.
    PlayStatus play(const std::stop_token& stop, const Listener& listener = {});
    /// From any thread: no point is sent any more when this returns.
    void stop();
    void emergency_stop(); ///< the same, and says so
    [[nodiscard]] PlayStatus status() const;

private:
    void wait_until(double time, const std::stop_token& stop);
    void hear_out(double due, const std::stop_token& stop);
    void wait_for_answer(const std::stop_token& stop);
    void take_answer();
    [[nodiscard]] std::string heard(const std::string& line);
    [[nodiscard]] bool send(std::size_t n, double due);
    void end(PlayState state, std::string sentence);
    [[nodiscard]] std::string complaint();

    std::unique_ptr<Link> link_;
    Clock& clock_;
    std::shared_ptr<const std::vector<Vec3>> points_;
    PlayerOptions options_;
    RecordText text_;
    RecordPath path_;
    std::array<std::size_t, 3> index_{}; ///< of X, Y, Z among the machine's axes
    std::vector<double> axes_;           ///< of the machine, at the last point
    AnswerLines inbox_;
    bool awaits_answer_ = false; ///< to the last point
    double sent_at_ = 0.0;       ///< of the clock, the last point
    mutable std::mutex mutex_;   ///< guards what follows, and each sending
    bool begun_ = false;
    PlayStatus status_;
    JitterMeter meter_;
};

} // namespace millwright::machine
