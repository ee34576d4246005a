// A machine that takes coordinates: where its axes shall be, one line per sampling period, and says nothing
// back. Programs, hold, resume, jogs and single lines are those of the virtual machine, whose positions are
// sent; so what is sent keeps the limits of the axes at every moment. Machines with words of their own get
// records of any pattern, and may answer each before the next is sent. Format:
// docs/reference/coordinate-stream.md.
#pragma once

#include "core/base/clock.h"
#include "core/drivers/driver.h"
#include "core/drivers/point_sender.h"
#include "core/drivers/stream/record_format.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/links/link.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace millwright::drivers {

struct StreamOptions {
    double period = 0.01; ///< s between samples, 0.0005 to 1
    int decimals = 4;     ///< of mm and degrees, 0 to 9
    bool paced = true;    ///< a sample per period; false: as fast as it goes, for files
    /// Given: records in place of the stream's own lines, and no first line. Nothing is sent before something
    /// moves.
    std::optional<RecordFormat> record = std::nullopt;
    bool known = true; ///< its position; else that is assumed until the first sample
};

/// The machine does not report its position: positions are those that were sent, and where records are
/// answered, those that were. Any other answer, or none in time, is an alarm, and nothing more is sent.
class StreamDriver final : public Driver {
public:
    /// Stands at `position`. `clock` must outlive it. Throws Error for options out of range.
    StreamDriver(std::unique_ptr<links::Link> link,
                 const Clock& clock,
                 std::shared_ptr<const kinematics::MachineModel> model,
                 kinematics::AxisPositions position,
                 StreamOptions options = {});
    StreamDriver(const StreamDriver&) = delete;
    StreamDriver& operator=(const StreamDriver&) = delete;
    ~StreamDriver() override;

    [[nodiscard]] std::string name() const override { return "stream"; }
    [[nodiscard]] std::string address() const override { return link_->name(); }
    [[nodiscard]] DriverStatus status() const override;
    [[nodiscard]] Capabilities capabilities() const override;
    /// Samples that were sent so far.
    [[nodiscard]] std::int64_t samples() const { return samples_; }

    /// Sends the heading, and nothing more: whoever follows samples does not move before a job, a jog or a
    /// command.
    /// Throws Error, too, where the link cannot carry the samples in their time.
    void connect() override;
    void start(Work work) override;
    void hold() override { machine_.hold(); }
    void resume() override { machine_.resume(); }
    void stop() override { machine_.stop(); }
    /// Sends nothing more: the machine stays at the last sample, however fast it was.
    void emergency_stop() override { machine_.emergency_stop(); }
    /// Makes a lost link again.
    void reset() override;
    void stands_at(const kinematics::AxisPositions& position) override;
    void close() noexcept override;
    void set_overrides(const Overrides& wanted) override { machine_.set_overrides(wanted); }
    void set_single_block(bool on) override { machine_.set_single_block(on); }
    void set_optional_stop(bool on) override { machine_.set_optional_stop(on); }
    void jog(const Jog& jog) override;
    void stop_jog() override { machine_.stop_jog(); }
    void home() override;
    int command(const std::string& lines) override;
    [[nodiscard]] std::vector<StoredOffset> stored_offsets() const override {
        return machine_.stored_offsets();
    }
    [[nodiscard]] Console* console() override { return machine_.console(); }

private:
    /// The time of the stream: a whole number of periods.
    class StreamClock final : public Clock {
    public:
        [[nodiscard]] double now() const override { return time_; }
        void wait(double seconds) override { time_ = time_ + seconds; }

    private:
        std::atomic<double> time_ = 0.0;
    };

    void begin();
    void follow();
    void run(const std::stop_token& stop);
    [[nodiscard]] bool send_sample(const std::stop_token& stop);
    void land();
    [[nodiscard]] static bool moves(const DriverStatus& status);
    [[nodiscard]] std::string lost() const;
    void lose(const std::string& why);
    [[nodiscard]] std::optional<std::string> exchange(const std::string& before,
                                                      const kinematics::AxisPositions& position,
                                                      const std::stop_token& stop);
    [[nodiscard]] std::optional<PointSender::Heard> hear() { return sender_.hear(link_->read()); }
    template <class Act> auto between_records(const Act& act);

    std::unique_ptr<links::Link> link_;
    const Clock& clock_;
    std::shared_ptr<const kinematics::MachineModel> model_;
    StreamOptions options_;
    StreamClock stream_clock_;
    VirtualMachine machine_;
    PointSender sender_;
    bool told_place_ = false;        ///< where the first motion begins was sent
    std::atomic<bool> known_ = true; ///< its position
    std::atomic<std::int64_t> samples_ = 0;
    mutable std::mutex mutex_; ///< guards what follows
    std::string last_line_;
    std::string lost_;    ///< why the link is gone; empty while it stands
    DriverStatus proven_; ///< before the record that is not answered yet
    bool in_flight_ = false;
    std::condition_variable landed_;
    std::jthread thread_;
};

} // namespace millwright::drivers
