// The conversation with a table that takes one record per move: the next one goes when the last was answered,
// or, where nothing is answered, when the move must be over. Lengths mm, times s.
#pragma once

#include "core/drivers/controller_session.h"
#include "core/drivers/host_stall.h"
#include "core/drivers/internal/send_window.h"
#include "core/drivers/point_sender.h"
#include "core/drivers/records/internal/answer_pace.h"
#include "core/drivers/records/records_driver.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace millwright::drivers::records {

class RecordSession final : public ControllerSession {
public:
    RecordSession(std::shared_ptr<const kinematics::MachineModel> model,
                  kinematics::AxisPositions position,
                  const RecordsOptions& options);

    /// Throws Error unless idle or stopped, or if the program is not for this machine.
    void start(const Work& work, double now);
    void set_optional_stop(bool on) { optional_stop_ = on; }
    void set_single_block(bool on) { single_block_ = on; }
    [[nodiscard]] bool awaits_answers() const { return sender_.asks(); }
    /// Records that were sent so far.
    [[nodiscard]] int records() const { return records_; }

    void opened(double now) override;
    void lost(const std::string& why) override;
    void closed() override;
    void receive(std::string_view bytes, double now) override;
    void tick(double now) override;
    [[nodiscard]] double patience(double now) const override;
    [[nodiscard]] internal::SendWindow* send_window() override { return &send_window_; }

    [[nodiscard]] DriverStatus status() const override { return status_; }
    [[nodiscard]] bool greeted() const override { return true; }
    [[nodiscard]] bool link_lost() const override { return status_.link_lost; }
    [[nodiscard]] std::optional<Diagnostic> stranger() const override { return std::nullopt; }

    void hold(double now) override;
    void resume(double now) override;
    void stop(double now) override;
    void emergency_stop(double now) override;
    void reset(double now) override;
    void trust_position() override { stands_at(status_.position); }
    void doubt_position(std::string why, bool) override { status_.position_doubt = std::move(why); }
    void stands_at(const kinematics::AxisPositions& position) override;
    void home(double now) override;
    void jog(const Jog& jog, double now) override;
    void stop_jog(double /*now*/) override {}
    void set_overrides(const Overrides& wanted) override;

private:
    /// What the machine is at.
    struct UnderWay {
        kinematics::AxisPositions target;
        double over = 0.0;   ///< when it should be over
        bool record = false; ///< else a dwell, which is not answered
        double sent = 0.0;   ///< of a record: when
        double way = 0.0;    ///< of a record: how long its way takes at its speed
    };

    void answered(const std::string& line, double now);
    [[nodiscard]] bool listens(double now) const { return now < listens_until_; }
    void look_at_clock(double now);
    void land(double now);
    void begin_block(double now);
    void send(const program::Block& block, double now);
    [[nodiscard]] bool may_begin_block(double now);
    void executed();
    void claim_executed();
    void rest(DriverState state, std::string why = {});
    void alarm(std::string why);

    std::shared_ptr<const kinematics::MachineModel> model_;
    RecordFormat format_;
    int decimals_;
    PointSender sender_;
    std::shared_ptr<const program::Program> program_;
    std::shared_ptr<const program::Listing> listing_;
    std::shared_ptr<const motion::Trajectory> trajectory_; ///< for its times alone; may be null
    int next_ = 0;                                         ///< block of the program
    internal::SendWindow send_window_;
    HostStall host_stall_;
    bool optional_stop_ = false;
    std::optional<UnderWay> under_way_;
    /// Until when the table may go on with the record that was on its way when an alarm came; its late
    /// answer, which ends it, is none to a later record.
    std::optional<double> left_until_;
    /// Until when it is heard whether an answer comes twice, before anything else begins.
    double listens_until_ = 0.0;
    AnswerPace pace_;
    bool rests_ = false; ///< held, and what was under way is over
    bool single_block_ = false;
    int records_ = 0;
    DriverStatus status_;
};

} // namespace millwright::drivers::records
