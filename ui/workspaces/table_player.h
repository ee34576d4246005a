// A plot's path that is played to an XYZ table, one point per period, in a thread of its own: through a
// driver, the dispatcher and a job log like every other job.
#pragma once

#include "core/base/clock.h"
#include "core/base/error.h"
#include "core/drivers/points/points_driver.h"
#include "core/geometry/vectors.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/job.h"
#include "core/kinematics/machine_model.h"
#include "core/plan/plot_work.h"
#include "core/plot/cut_path.h"
#include "core/plot/decode.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace millwright::actions {

struct TableChoice {
    std::string port = {}; ///< empty: for the eyes alone
    plot::DecodeSettings decoding = {.velocity = 8.0, .period = 0.02, .mode = plot::DecodeMode::path};
    double speed = 1.0; ///< times real time
    drivers::RecordFormat record = {.pattern = "{X},{Y},{Z}"};

    friend bool operator==(const TableChoice&, const TableChoice&) = default;
};

/// What is played.
struct TableWork {
    std::shared_ptr<const plot::CutPath> path;
    std::filesystem::path file; ///< that it was made of
    std::shared_ptr<const kinematics::MachineModel> model;
    double spindle_rpm = 0.0; ///< of its program
    /// Of a point file: they are played in place of the path, one per period.
    std::shared_ptr<const plan::PlotPoints> points = {};

    /// Where it is played from if the place of the table is not known, mm.
    [[nodiscard]] Vec3 usual_start() const;
};

/// For one frame.
struct TableView {
    bool there = false;     ///< something was played, or is
    bool playing = false;   ///< it is being prepared, moves, or rests at a stop
    std::int64_t total = 0; ///< points; 0 while they are computed
    double duration = 0.0;  ///< s, as PlayStatus::time counts
    drivers::PlayStatus status;
    std::optional<Diagnostic> failure;       ///< it could not begin
    std::optional<jobs::JobOutcome> outcome; ///< of the last, once it ended
};

class TablePlayer {
public:
    /// Logs go to `log_folder`. `wake`: from any thread, when there is something new to see.
    TablePlayer(std::filesystem::path log_folder, std::function<void()> wake)
        : log_folder_(std::move(log_folder)), wake_(std::move(wake)) {}
    TablePlayer(const TablePlayer&) = delete;
    TablePlayer& operator=(const TablePlayer&) = delete;
    ~TablePlayer() = default; // the thread stops the table: nothing is sent any more

    /// At constant velocity; limits of the machine are checked before. view() has what is wrong. A table that
    /// something was played to before starts from where that ended; else it is assumed to be at
    /// the usual start of the work. It rests at each tool change until resume(). Throws Error while one is
    /// playing, and for an invalid port.
    void play(const TableChoice& choice, TableWork work);
    /// At once, and entered in the job's log.
    void hold();
    void resume();
    void stop();
    void emergency_stop();
    [[nodiscard]] TableView view() const;
    /// Of the last play; empty: it was for the eyes alone.
    [[nodiscard]] std::string port() const;
    /// Until the last point is sent, s of real time; 0 while nothing is played.
    [[nodiscard]] double time_left() const;
    [[nodiscard]] bool playing() const { return view().playing; }
    /// Where the next would start; nothing: not known, see play().
    [[nodiscard]] std::optional<Vec3> place(const std::string& port) const;
    /// Blocks until nothing is played (tests).
    void wait();

private:
    /// One job on its table.
    struct Play {
        TableChoice choice;
        std::shared_ptr<drivers::PointsDriver> driver;
        std::unique_ptr<jobs::Dispatcher> dispatcher;
    };

    /// Of a table that was sent points.
    struct Place {
        std::string port;
        Vec3 at = Vec3::Zero(); ///< mm
    };

    void run(const std::shared_ptr<Play>& play,
             const TableWork& work,
             const std::optional<Vec3>& start,
             const std::stop_token& stop);
    [[nodiscard]] std::shared_ptr<Play> current() const;
    [[nodiscard]] std::optional<Place> last_place() const;

    std::filesystem::path log_folder_;
    std::function<void()> wake_;
    SteadyClock clock_;
    mutable std::mutex mutex_; ///< guards what follows
    std::shared_ptr<Play> play_;
    std::optional<Place> place_before_; ///< where the plays before that one left a table
    bool playing_ = false;
    std::int64_t total_ = 0;
    double duration_ = 0.0;
    std::optional<Diagnostic> failure_;
    std::optional<jobs::JobOutcome> outcome_;
    std::jthread thread_; // last: it ends before what it uses
};

} // namespace millwright::actions
