// Points that are played to an XYZ table, one a period, in a thread of its own.
#pragma once

#include "core/base/error.h"
#include "core/geometry/vectors.h"
#include "core/kinematics/machine_model.h"
#include "core/machine/point_player.h"
#include "core/plot/cut_path.h"
#include "core/plot/decode.h"
#include "core/plot/strokes.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace millwright::actions {

struct TableChoice {
    std::string port = {}; ///< empty: for the eyes alone
    plot::DecodeSettings decoding = {
        .velocity = 8.0, .period = 0.02, .pen_up_z = 5.0, .mode = plot::DecodeMode::path};
    double speed = 1.0; ///< times real time
    machine::RecordFormat record = machine::PlayerOptions().format;

    friend bool operator==(const TableChoice&, const TableChoice&) = default;
};

/// How it stands, for one frame.
struct TableView {
    bool there = false;     ///< something was played, or is
    std::int64_t total = 0; ///< points
    machine::PlayStatus status;
    std::optional<Diagnostic> failure; ///< it could not begin
};

class TablePlayer {
public:
    explicit TablePlayer(std::function<void()> wake) : wake_(std::move(wake)) {}
    TablePlayer(const TablePlayer&) = delete;
    TablePlayer& operator=(const TablePlayer&) = delete;
    ~TablePlayer() = default; // the thread stops the player: nothing is sent any more

    /// In whole paths at constant velocity; limits of the machine are checked before. What is wrong is told
    /// by view(). A table that something was played to before is led up and to the beginning from where that
    /// ended; else it is taken to stand there. Throws Error while one is playing.
    void play(const TableChoice& choice,
              const plot::Strokes& strokes,
              const std::shared_ptr<const kinematics::MachineModel>& model);
    /// The same of a path with its own heights, which is begun at that of its first point. Throws Error too
    /// where it changes tools, for points do not stop.
    void play(const TableChoice& choice,
              const plot::CutPath& path,
              const std::shared_ptr<const kinematics::MachineModel>& model);
    /// At once.
    void stop();
    void emergency_stop();
    [[nodiscard]] TableView view() const;
    [[nodiscard]] bool playing() const { return view().status.state == machine::PlayState::playing; }
    /// Blocks until nothing is played (tests).
    void wait();

private:
    /// Where a table is that was sent points.
    struct Place {
        std::string port;
        Vec3 at = Vec3::Zero(); ///< mm
    };

    /// Of the table, from where it stands, if that is known; `fastest` as in decode_within().
    using Points = std::function<std::vector<Vec3>(
        const plot::DecodeSettings& decoding, double fastest, const std::optional<Vec3>& stands)>;

    void play_points(const TableChoice& choice, const Points& points, const kinematics::MachineModel& model);
    [[nodiscard]] std::optional<Vec3> place_of(const std::string& port);

    std::function<void()> wake_;
    machine::SteadyClock clock_;
    mutable std::mutex mutex_; ///< guards what follows
    std::shared_ptr<machine::PointPlayer> player_;
    std::string port_;            ///< of the player
    std::optional<Place> stands_; ///< after the player before it
    std::int64_t total_ = 0;
    std::optional<Diagnostic> failure_;
    std::jthread thread_;
};

} // namespace millwright::actions
