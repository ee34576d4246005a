// The driver against the real LinuxCNC: its simulation without a window, started by this test. A computer
// runs one LinuxCNC at a time, so whoever tests here waits for the others. It runs in real time: every move
// that is caught on its way takes seconds, and nothing is asked before a state is reached.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/drivers/linuxcnc/linuxcnc_driver.h"
#include "core/jobs/dispatcher.h"
#include "core/links/tcp.h"
#include "tests/core/links/reading.h"
#include "tests/support/oracle.h"
#include "tests/support/scratch_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace millwright::drivers {
namespace {

using testing::HasSubstr;

std::string configuration(int port, const std::string& folder) {
    std::string text =
        fmt::format("[EMC]\nVERSION = 1.1\nMACHINE = test\nDEBUG = 0\n"
                    "[DISPLAY]\nDISPLAY = linuxcncrsh --port {}\nCYCLE_TIME = 0.1\nPROGRAM_PREFIX = {}\n",
                    port,
                    folder);
    text += "[TASK]\nTASK = milltask\nCYCLE_TIME = 0.001\n[RS274NGC]\nPARAMETER_FILE = sim.var\n"
            "[EMCMOT]\nEMCMOT = motmod\nCOMM_TIMEOUT = 4.0\nSERVO_PERIOD = 1000000\n"
            "[EMCIO]\nEMCIO = io\nCYCLE_TIME = 0.1\nTOOL_TABLE = sim.tbl\n[HAL]\nHALFILE = sim.hal\n"
            "[TRAJ]\nCOORDINATES = X Y Z\nLINEAR_UNITS = mm\nANGULAR_UNITS = degree\nDEFAULT_LINEAR_VELOCITY "
            "= 30\n"
            "MAX_LINEAR_VELOCITY = 50\nDEFAULT_LINEAR_ACCELERATION = 500\nMAX_LINEAR_ACCELERATION = 500\n"
            "[KINS]\nKINEMATICS = trivkins\nJOINTS = 3\n";
    for (int n = 0; n < 3; ++n) {
        const std::string limits =
            "MAX_VELOCITY = 50\nMAX_ACCELERATION = 500\nMIN_LIMIT = -250\nMAX_LIMIT = 250\n";
        text += fmt::format("[AXIS_{}]\n{}", "XYZ"[n], limits);
        text +=
            fmt::format("[JOINT_{}]\nTYPE = LINEAR\nHOME = 0\n{}FERROR = 5\nMIN_FERROR = 1\nHOME_OFFSET = 0\n"
                        "HOME_SEARCH_VEL = 0\nHOME_LATCH_VEL = 0\nHOME_SEQUENCE = 0\n",
                        n,
                        limits);
    }
    return text;
}

constexpr const char* wires =
    "loadrt [KINS]KINEMATICS\n"
    "loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS\n"
    "addf motion-command-handler servo-thread\naddf motion-controller servo-thread\n"
    "net j0 joint.0.motor-pos-cmd => joint.0.motor-pos-fb\n"
    "net j1 joint.1.motor-pos-cmd => joint.1.motor-pos-fb\n"
    "net j2 joint.2.motor-pos-cmd => joint.2.motor-pos-fb\n"
    "net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in\n"
    "net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared\n"
    "net change iocontrol.0.tool-change => iocontrol.0.tool-changed\n";

/// Held by one test on this computer, whoever runs it.
class ComputerLock {
public:
    ComputerLock()
        : handle_(::open("/tmp/millwright-linuxcnc-simulator.lock", O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
        if (handle_ < 0 || ::flock(handle_, LOCK_EX) != 0) {
            throw std::runtime_error("the lock of the simulator cannot be taken");
        }
    }
    ComputerLock(const ComputerLock&) = delete;
    ComputerLock& operator=(const ComputerLock&) = delete;
    ~ComputerLock() { ::close(handle_); }

private:
    int handle_;
};

/// Waits until something is done; false when even a slow computer would have done it.
template <class Done> bool within(std::chrono::seconds simulator_patience, const Done& done) {
    const auto end = std::chrono::steady_clock::now() + simulator_patience;
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
}

constexpr std::chrono::seconds simulator_patience{90};

/// LinuxCNC as a child process.
class Simulator {
public:
    explicit Simulator(const std::filesystem::path& folder) : folder_(folder) {
        {
            links::TcpServer any(0);
            any.open();
            port = any.port();
        }
        ::chmod(folder.c_str(), 0777); // as root its real-time part runs as the user "nobody"
        write_file(folder / "sim.ini", configuration(port, folder.string()));
        write_file(folder / "sim.hal", wires);
        write_file(folder / "sim.tbl", "T1 P1 D3 ;mill\n");
        write_file(folder / "sim.var", "");
        child_ = ::fork();
        if (child_ == 0) {
            run();
        }
        ::setpgid(child_, child_);
    }
    Simulator(const Simulator&) = delete;
    Simulator& operator=(const Simulator&) = delete;
    ~Simulator() {
        ::kill(-child_, SIGTERM); // its script takes everything down, once the user interface has ended
        if (!within(simulator_patience, [this] { return gone(); })) {
            ::kill(-child_, SIGKILL);
            ::waitpid(child_, nullptr, 0);
        }
    }

    std::uint16_t port = 0;

    /// Connects as soon as it listens. Empty: done. Else what it said.
    std::string connect(LinuxCncDriver& driver) {
        const auto connected = [&] {
            try {
                driver.connect();
                return true;
            } catch (const Error&) {
                return false;
            }
        };
        bool linked = false;
        (void)within(simulator_patience, [&] {
            linked = connected();
            return linked || gone();
        });
        return linked ? std::string() : "it says: " + read_file(folder_ / "out.txt");
    }

private:
    std::filesystem::path folder_;
    pid_t child_ = -1;
    bool gone_ = false;

    [[nodiscard]] bool gone() {
        gone_ = gone_ || ::waitpid(child_, nullptr, WNOHANG) != 0;
        return gone_;
    }

    [[noreturn]] void run() const {
        ::setpgid(0, 0);
        const int out = ::open((folder_ / "out.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        ::dup2(::open("/dev/null", O_RDONLY), 0); // it asks no questions
        ::dup2(out, 1);
        ::dup2(out, 2);
        ::unsetenv("DISPLAY"); // else a lock that a dead LinuxCNC left is asked about in an invisible window
        ::setenv("HOME", folder_.c_str(), 1);
        ::setenv("RTAPI_FIFO_PATH", (folder_ / "fifo").c_str(), 1);
        if (::getuid() == 0) {
            ::setenv("RTAPI_UID", "65534", 1);
        }
        ::execlp("linuxcnc", "linuxcnc", "-r", (folder_ / "sim.ini").c_str(), nullptr);
        ::_exit(127);
    }
};

struct LinuxCncSimulator : OracleTest {
    LinuxCncSimulator() : OracleTest("linuxcncrsh", "linuxcnc-uspace") {}

    test::ScratchFolder scratch;
    SteadyClock clock;
};

constexpr const char* square_at_two_feeds =
    "G21 G90 G94\nG0 X0 Y0\n(around)\nG1 X20 F240\nG1 Y20\n\nG1 X0 F1200\nG1 Y0\nM2\n";

/// Holds a running job on its way, looks whether the machine stands, and goes on.
class Pauser {
public:
    explicit Pauser(jobs::Dispatcher& dispatcher) : dispatcher_(dispatcher) {}

    void look(const DriverStatus& now) {
        constexpr int long_enough = 50; // looks, a second
        if (!held_ && now.position[0] > 5.0) {
            held_ = true;
            dispatcher_.set_overrides({.feed = 50, .rapid = 100, .spindle = 100});
            dispatcher_.hold();
        } else if (held_ && !resumed_ && now.state == DriverState::holding) {
            same_ = rest_.size() == now.position.size() && rest_ == now.position ? same_ + 1 : 0;
            rest_ = now.position;
            if (same_ > long_enough && now.overrides.feed == 50) {
                resumed_ = true;
                dispatcher_.resume();
            }
        }
    }
    /// It stood still between hold and resume, with the override in force.
    [[nodiscard]] bool resumed() const { return resumed_; }

private:
    jobs::Dispatcher& dispatcher_;
    kinematics::AxisPositions rest_;
    int same_ = 0;
    bool held_ = false, resumed_ = false;
};

TEST_F(LinuxCncSimulator, IsDrivenThroughProgramPauseOverrideStopCommandAndJog) {
    const ComputerLock alone;
    Simulator simulator(scratch.path());
    LinuxCncOptions options;
    options.program_folder = scratch.path();
    LinuxCncDriver driver(std::make_unique<links::TcpLink>("127.0.0.1", simulator.port), clock, options);
    const auto state = [&] { return driver.status().state; };
    const auto reaches = [&](DriverState wanted) {
        return within(simulator_patience, [&] { return state() == wanted; });
    };

    const std::string said = simulator.connect(driver);
    ASSERT_EQ(said, "") << "LinuxCNC does not start here";
    // It begins in the emergency stop, and leaves it when a person says so.
    EXPECT_EQ(state(), DriverState::alarm);
    EXPECT_THROW(driver.home(), Error);
    driver.reset();
    ASSERT_TRUE(reaches(DriverState::idle)) << driver.status().message;
    driver.home();
    ASSERT_TRUE(reaches(DriverState::idle)) << driver.status().message;

    // A program, with pause and override, and its log.
    jobs::Dispatcher dispatcher(driver, clock, scratch / "logs");
    Pauser pauser(dispatcher);
    const jobs::JobOutcome outcome =
        dispatcher.run(jobs::text_job(square_at_two_feeds, "square.ngc"),
                       {},
                       [&](const jobs::JobReport& report) { pauser.look(report.driver); });
    EXPECT_TRUE(pauser.resumed());
    EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
    EXPECT_EQ(outcome.executed_blocks, 8);
    const jobs::ReadLog log = jobs::read_job_log(outcome.log_file);
    EXPECT_EQ(log.end(), jobs::JobEnd::done);
    driver.set_overrides({});

    // Stopped on its way: no more is claimed than the position proves.
    driver.start({nullptr, nullptr, jobs::text_job(square_at_two_feeds, "square.ngc").listing, {}});
    ASSERT_TRUE(within(simulator_patience, [&] { return driver.status().position[1] > 5.0; }));
    driver.stop();
    ASSERT_TRUE(reaches(DriverState::stopped));
    EXPECT_LE(driver.status().executed_blocks, 4); // up to the line that it was on
    EXPECT_GE(driver.status().executed_blocks, 3);

    // Single lines, and what is wrong with them.
    (void)driver.command("G0 X3 Y4");
    ASSERT_TRUE(reaches(DriverState::idle));
    EXPECT_NEAR(driver.status().position[0], 3.0, 1e-3);
    EXPECT_EQ(driver.status().answer.state, CommandAnswer::State::done);
    (void)driver.command("G10 L20 P0 X1");
    ASSERT_TRUE(reaches(DriverState::idle));
    EXPECT_NEAR(driver.status().work_position()[0], 1.0, 1e-3);
    (void)driver.command("G1 Q");
    ASSERT_TRUE(reaches(DriverState::idle));
    EXPECT_EQ(driver.status().answer.state, CommandAnswer::State::refused);
    EXPECT_FALSE(driver.status().answer.text.empty());

    // Jogs: exactly as far as they say, and no farther than the hand.
    Jog jog{kinematics::AxisPositions::Zero(3), 10.0, 0.0};
    jog.way[1] = -2.5;
    driver.jog(jog);
    ASSERT_TRUE(reaches(DriverState::idle));
    EXPECT_NEAR(driver.status().position[1], 1.5, 1e-3);
    jog = {kinematics::AxisPositions::Zero(3), 10.0, 0.3};
    jog.way[0] = 100.0;
    driver.jog(jog);
    ASSERT_TRUE(reaches(DriverState::idle));
    EXPECT_GE(driver.status().position[0], 3.0 - 1e-3); // a slow hand is dead before the first slice
    EXPECT_LT(driver.status().position[0], 3.0 + 10.0);

    // A way that the machine does not have ends in an alarm with LinuxCNC's own words.
    driver.start({nullptr,
                  nullptr,
                  jobs::text_job("G21 G90 G94\nG1 X10 F1200\nG1 X900\nM2\n", "far.ngc").listing,
                  {}});
    ASSERT_TRUE(reaches(DriverState::alarm));
    EXPECT_THAT(driver.status().message, HasSubstr("exceed"));
    EXPECT_LE(driver.status().executed_blocks, 2);
    driver.reset();
    ASSERT_TRUE(reaches(DriverState::idle));
    driver.emergency_stop();
    EXPECT_EQ(state(), DriverState::alarm);
    driver.close();
}

} // namespace
} // namespace millwright::drivers
