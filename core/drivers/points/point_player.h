// The XYZ table of the KMITL thesis on an HPGL decoder and constant-velocity control: points that were
// computed before, one per sampling period. Lengths mm, times s.
#pragma once

#include "core/base/clock.h"
#include "core/drivers/jitter.h"
#include "core/drivers/point_sender.h"
#include "core/drivers/point_track.h"
#include "core/drivers/stream/record_format.h"
#include "core/geometry/vectors.h"
#include "core/kinematics/machine_model.h"
#include "core/links/link.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>

namespace millwright::drivers {

struct PlayerOptions {
    double speed = 1.0; ///< times the period of the track, 0.01 to 100
    RecordFormat format = {};
};

enum class PlayState {
    ready,
    playing,
    holding,       ///< at a stop of the track, which the sentence names, or because a person asked for it
    done,          ///< every point was sent
    stopped,       ///< by a person
    emergency_stop ///< or the link was lost, or the table complained; the sentence says which
};

struct PlayStatus {
    PlayState state = PlayState::ready;
    std::int64_t sent = 0;        ///< points
    std::int64_t points = 0;      ///< of these, that the table has: those that it answered, where it answers
    std::int64_t stops = 0;       ///< of the track, that were passed
    bool unsure = false;          ///< it ended, and the table may or may not have the last one
    Vec3 position = Vec3::Zero(); ///< the last of them; before that the first that will be sent
    double time = 0.0;            ///< points that the table has, times the period
    Jitter jitter;
    std::string sentence; ///< why it ended early, or rests
};

/// Times are counted from the first point, so that delays do not add up. A late point is sent at once, and
/// the next one in its own time. Where the format names an answer no point is sent before the table has
/// answered the one before; it stops where that takes longer than the format's patience.
class PointPlayer {
public:
    /// Without a link (null) it plays for the eyes alone. `link` and `clock` must outlive it. Throws Error
    /// for options out of range and records that the machine does not have, or if there are no points.
    PointPlayer(links::Link* link,
                Clock& clock,
                std::shared_ptr<const PointTrack> track,
                const kinematics::MachineModel& model,
                const PlayerOptions& options = {});
    PointPlayer(const PointPlayer&) = delete;
    PointPlayer& operator=(const PointPlayer&) = delete;
    ~PointPlayer() = default;

    using Listener = std::function<void(const PlayStatus&)>;

    /// Over an open link. Plays to the end, or to an emergency stop, which `stop` is too; blocks. The
    /// listener is called from here, now and then. Throws Error if it was played before.
    PlayStatus play(const std::stop_token& stop, const Listener& listener = {});
    /// From any thread: no point is sent any more when this returns, before resume().
    void hold();
    void resume();
    /// From any thread: no point is sent any more when this returns.
    void stop();
    void emergency_stop(); ///< the same, and says so
    [[nodiscard]] PlayStatus status() const;
    [[nodiscard]] const PointTrack& track() const { return *track_; }

private:
    enum class Sending { sent, held, over };

    [[nodiscard]] bool goes_on() const;
    [[nodiscard]] const kinematics::AxisPositions& axes_at(std::size_t n);
    [[nodiscard]] std::size_t longest_record();
    void wait_until(double time, const std::stop_token& stop);
    void wait_out(double due, const std::stop_token& stop);
    void wait_for_answer(const std::stop_token& stop);
    void rest(const std::stop_token& stop, const Listener& listener);
    void rest_at_stops(std::size_t n, const std::stop_token& stop, const Listener& listener);
    void take_answer();
    [[nodiscard]] std::string complaint_of(const PointSender::Heard& heard) const;
    [[nodiscard]] Sending send(std::size_t n, double due);
    void end(PlayState state, std::string sentence);
    [[nodiscard]] std::string complaint();
    void heed(const std::stop_token& stop);
    [[nodiscard]] double interval() const { return track_->period / options_.speed; }

    links::Link* link_;
    Clock& clock_;
    std::shared_ptr<const PointTrack> track_;
    PlayerOptions options_;
    std::array<std::size_t, 3> index_{}; ///< of X, Y, Z among the machine's axes
    kinematics::AxisPositions axes_;     ///< of the machine, at the last point
    double sent_at_ = 0.0;               ///< of the clock, the last point
    double begin_ = 0.0;                 ///< of the clock, the first point, later by every rest
    double reported_at_ = 0.0;           ///< of the clock, to the listener
    mutable std::mutex mutex_;           ///< guards what follows, and each sending
    PointSender sender_;
    bool begun_ = false;
    PlayStatus status_;
    JitterMeter meter_;
};

} // namespace millwright::drivers
