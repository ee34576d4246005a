// A table that is sent one point per sampling period (the KMITL thesis on an HPGL decoder and
// constant-velocity control), or one that is only drawn. Lengths mm, times s.
#pragma once

#include "core/drivers/driver.h"
#include "core/drivers/points/point_player.h"
#include "core/links/link.h"

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace millwright::drivers {

/// Plays the track of a job (Work::points) and nothing else. Hold and stop take effect at once: no further
/// point is sent, and the table stays at the last one. It rests at the stops of the track. Blocks count as
/// executed when the table has a point behind them, or their last one where they end at it: where records are
/// answered, when that one was answered; without answers, when it was sent.
/// Spindle and coolant are switched by hand.
class PointsDriver final : public Driver {
public:
    /// Starts at `position`; the table does not report where it is. Without a link (null) nothing is sent.
    /// `clock` must outlive it. Throws Error if the machine has no X, Y, Z, and for a record that it cannot
    /// have.
    PointsDriver(std::unique_ptr<links::Link> link,
                 Clock& clock,
                 std::shared_ptr<const kinematics::MachineModel> model,
                 const Vec3& position,
                 PlayerOptions options = {});
    PointsDriver(const PointsDriver&) = delete;
    PointsDriver& operator=(const PointsDriver&) = delete;
    ~PointsDriver() override;

    [[nodiscard]] std::string name() const override { return "points"; }
    [[nodiscard]] std::string address() const override { return link_ ? link_->name() : std::string(); }
    [[nodiscard]] DriverStatus status() const override;
    [[nodiscard]] Capabilities capabilities() const override;
    /// Of the track that is or was played last: also after close().
    [[nodiscard]] PlayStatus played() const;

    void connect() override;
    /// Throws Error for work without points, records that leave out an axis which they change, more of them
    /// than the link carries where none is answered, and where the table is not at the first point.
    void start(Work work) override;
    void hold() override;
    void resume() override;
    void stop() override;
    void emergency_stop() override;
    /// Makes a lost link again.
    void reset() override;
    void close() noexcept override;

private:
    [[nodiscard]] kinematics::AxisPositions axes_of(const Vec3& point) const;
    [[nodiscard]] std::shared_ptr<PointPlayer> player() const;

    std::unique_ptr<links::Link> link_;
    Clock& clock_;
    std::shared_ptr<const kinematics::MachineModel> model_;
    PlayerOptions options_;
    std::array<std::size_t, 3> index_; ///< of X, Y, Z among the axes
    mutable std::mutex mutex_;         ///< guards what follows
    Vec3 position_;                    ///< before anything was played
    bool connected_ = false;
    bool locked_ = false; ///< an emergency stop, until reset()
    std::shared_ptr<PointPlayer> player_;
    int blocks_ = 0; ///< of the program that it plays
    std::jthread thread_;
};

} // namespace millwright::drivers
