// A project on a table at the other end of a pseudo-terminal, both of them the real program.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

namespace millwright::test {
namespace {

using testing::HasSubstr;
using testing::Not;

void wait_for(const std::filesystem::path& link) {
    for (int n = 0; n < 30'000 && !std::filesystem::exists(link); ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

TEST(TableCommand, RefusedRecordEndsTheJobAndTheLogSaysHowFar) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    Program table(
        {"emulate", "table", "--pty", port, "--machine", "router-xyz", "--answer", "ok", "--refuse", "50"});
    wait_for(port);
    const Ended ended = run({"run",
                             small_project(folder.path(), "router-dome").string(),
                             "--driver",
                             "stream",
                             "--port",
                             port,
                             "--record",
                             "t {X} {Y} {Z} {a} {s}",
                             "--answer",
                             "ok",
                             "--log",
                             (folder / "jobs").string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out + ended.err, HasSubstr("the machine answered 'error' to record 50"));
    table.send(SIGINT);
    EXPECT_THAT(table.end().out, HasSubstr("49 records executed, 0 invalid lines"));
}

std::vector<std::string>
send_words(const std::string& file, const std::string& port, const ScratchFolder& folder) {
    return {"send",
            file,
            "--driver",
            "records",
            "--machine",
            "forming-table",
            "--port",
            port,
            "--answer",
            "ok",
            "--log",
            (folder / "jobs").string()};
}

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream text(line);
    return {std::istream_iterator<std::string>(text), std::istream_iterator<std::string>()};
}

// The sign of the thesis in small: the table refuses a record, the job ends there and says how far it got,
// and goes on from the next line: no position is lost or gone to twice.
TEST(TableCommand, JobThatATableInterruptsIsResumedWithNothingLostOrDoubled) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    const auto file = folder / "sign.ngc";
    std::string text = "G21 G90\nG0 Z5\n";
    for (int n = 1; n <= 20; ++n) {
        text += "G1 X" + std::to_string(n) + " Y" + std::to_string(n % 2) + " F600\n";
    }
    write_content(file, text + "M2\n");
    const auto table = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--answer", "ok"});
        return std::make_unique<Emulator>(port, more, "table");
    };
    auto first = table({"--refuse", "12"});
    const Ended broken = run(send_words(file.string(), port, folder));
    EXPECT_EQ(broken.exit_code, 1);
    EXPECT_THAT(broken.out + broken.err, HasSubstr("the machine answered 'error' to record 12"));
    EXPECT_THAT(first->stop().out, HasSubstr("11 records executed, 0 invalid lines, at X 10.0000 Y 0.0000"));
    const Ended listed = run({"jobs", (folder / "jobs").string(), "--json"});
    EXPECT_THAT(listed.out, HasSubstr("\"next_line\": 13"));

    // What is printed is a whole command but for where the table stands, without which nothing is sent.
    const std::string told = run({"jobs", (folder / "jobs").string()}).out;
    const auto from = told.find("    millwright send ") + 15;
    auto words = words_of(told.substr(from, told.find('\n', from) - from));
    words.insert(words.end(), {"--log", (folder / "jobs").string()});
    auto second = table({});
    std::vector<std::string> nowhere = words;
    std::erase(nowhere, "--at");
    std::erase(nowhere, "X,Y,Z");
    EXPECT_THAT(run(nowhere).err, HasSubstr("give them with --at X,Y,Z"));
    std::ranges::replace(words, "X,Y,Z", "10,0,5");
    const Ended resumed = run(words);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    // Ten positions are left; the approach stands there already.
    EXPECT_THAT(second->stop().out, HasSubstr("10 records executed, 0 invalid lines, at X 20.0000 Y 0.0000"));
}

// A plot's program comes to its first cut in a few lines; a fault in that cut goes on from there.
TEST(TableCommand, AFaultInTheFirstStrokeIsResumedToo) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    write_content(folder / "square.plt", "IN;SP1;PU0,0;PD4000,0,4000,4000,0,4000,0,0;PU;");
    const std::string program = (folder / "square.ngc").string();
    const Ended made = run({"plot",
                            "toolpath",
                            (folder / "square.plt").string(),
                            "--spindle",
                            "0",
                            "--origin",
                            "10,10",
                            "--out",
                            program});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    Emulator first(port, {"--answer", "ok", "--refuse", "4"}, "table");
    const Ended broken = run(send_words(program, port, folder));
    EXPECT_EQ(broken.exit_code, 1);
    EXPECT_THAT(broken.out + broken.err, HasSubstr("the machine answered 'error' to record 4"));
    (void)first.stop();
    const std::string told = run({"jobs", (folder / "jobs").string()}).out;
    const auto found = told.find("    millwright send ");
    ASSERT_NE(found, std::string::npos) << told;
    const auto from = found + 15;
    auto words = words_of(told.substr(from, told.find('\n', from) - from));
    words.insert(words.end(), {"--log", (folder / "jobs").string()});
    std::ranges::replace(words, "X,Y,Z", "10,10,-1");
    Emulator second(port, {"--answer", "ok"}, "table");
    const Ended resumed = run(words);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    // Up, back down to where the first cut begins, its four sides, up.
    EXPECT_THAT(second.stop().out, HasSubstr("at X 10.0000 Y 10.0000"));
}

TEST(TableCommand, FilesLieWhereTheirOriginIs) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    Emulator table(port, {"--answer", "ok"}, "table");
    auto words = send_words("assets/samples/gcode/thesis-plate.ngc", port, folder);
    const Ended outside = run(words);
    EXPECT_EQ(outside.exit_code, 1);
    EXPECT_THAT(outside.err, HasSubstr("axis X would move to -7.000"));
    words.insert(words.end(), {"--origin", "10,20"});
    const Ended inside = run(words);
    EXPECT_EQ(inside.exit_code, 0) << inside.err;
    EXPECT_THAT(table.stop().out, HasSubstr("at X 75.6190 Y 70.0000"));
    const Ended grbl = run({"send",
                            "assets/samples/gcode/thesis-plate.ngc",
                            "--driver",
                            "grbl",
                            "--port",
                            port,
                            "--origin",
                            "10,20"});
    EXPECT_EQ(grbl.exit_code, 2);
    EXPECT_THAT(grbl.err, HasSubstr("use the work offsets of the controller"));
}

TEST(TableCommand, PointsWaitForTheirAnswers) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    std::string points;
    for (int n = 0; n < 36; ++n) {
        points += std::to_string(n * 10.0 / 35.0) + ",0.0,0.00\n";
    }
    write_content(folder / "line.txt", points);
    const std::vector<std::string> words{"plot",
                                         "play",
                                         (folder / "line.txt").string(),
                                         "--period",
                                         "0.04",
                                         "--port",
                                         port,
                                         "--record",
                                         "{X},{Y},{Z}",
                                         "--answer",
                                         "ok",
                                         "--patience",
                                         "1",
                                         "--log",
                                         (folder / "jobs").string(),
                                         "--json"};
    Emulator refuses(port, {"--record", "{X},{Y},{Z}", "--answer", "ok", "--refuse", "8"}, "table");
    const Ended refused = run(words);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.out, HasSubstr("\"points\": 7"));
    EXPECT_THAT(refused.err, HasSubstr("nothing was sent after point 8"));
    EXPECT_THAT(refuses.stop().out, HasSubstr("7 records executed, 0 invalid lines, at X 1.7143"));
    // Of all that there is a log, as of every job, and the command that plays it again.
    const std::string jobs = run({"jobs", (folder / "jobs").string()}).out;
    EXPECT_THAT(jobs, HasSubstr("fault after"));
    EXPECT_THAT(jobs, HasSubstr("the table sent 'error'"));
    EXPECT_THAT(jobs, HasSubstr("7 of 36 blocks were confirmed as executed"));
    EXPECT_THAT(jobs,
                HasSubstr("millwright plot play " + (folder / "line.txt").string() + " --port " + port));
    Emulator silent(port, {"--record", "{X},{Y},{Z}"}, "table");
    const Ended unheard = run(words);
    EXPECT_EQ(unheard.exit_code, 1);
    EXPECT_THAT(unheard.err, HasSubstr("the table did not answer point 1 within 1 s"));
    EXPECT_THAT(silent.stop().out, HasSubstr("1 record executed"));
}

TEST(TableCommand, PathFilesAreSentAndTheEnvelopeIsCheckedBefore) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    const std::string title =
        "# millwright path 1: absolute; x mm, y mm, z mm, speed mm/s (0: rapid), move, tool\n";
    write_content(folder / "good.path", title + "1,2,5,0,rapid,1\n1,2,-1,2,plunge,1\n480,2,-1,10,cut,1\n");
    write_content(folder / "far.path", title + "1,2,5,0,rapid,1\n480.5,2,5,0,rapid,1\n");
    Emulator table(port, {"--answer", "ok"}, "table");
    auto words = send_words((folder / "far.path").string(), port, folder);
    words.insert(words.begin() + 1, {"--at", "0,0,5"}); // before the file, which is no number
    const Ended far = run(words);
    EXPECT_EQ(far.exit_code, 1);
    EXPECT_THAT(far.err, HasSubstr("axis X would move to 480.500, outside 0.000 ... 480.000 mm"));
    const Ended good = run(send_words((folder / "good.path").string(), port, folder));
    EXPECT_EQ(good.exit_code, 0) << good.err;
    EXPECT_THAT(table.stop().out, HasSubstr("4 records executed, 0 invalid lines, at X 480.0000 Y 2.0000"));
}

// Of records that were sent just before Ctrl-C, some were missing in the count.
TEST(TableCommand, RecordsThatCameBeforeTheEndAreCounted) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    Emulator table(port, {}, "table");
    std::ofstream records(port, std::ios::binary);
    constexpr int count = 300;
    for (int n = 1; n <= count; ++n) {
        records << "t " << n << " 0 0 100 10\r\n";
    }
    records.flush();
    EXPECT_THAT(table.stop().out, HasSubstr("300 records executed, 0 invalid lines, at X 300.0000"));
}

TEST(TableCommand, PointsArePlayedOneAPeriodAndTheirJitterIsTold) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    std::string points;
    for (int n = 0; n < 36; ++n) {
        const std::string at = std::to_string(n * 10.0 / 35.0);
        points += at + "," + at + ",0.00\n";
    }
    write_content(folder / "diagonal.txt", points);
    Emulator table(port, {}, "table"); // neither is given a record: both mean the same
    const std::string log = (folder / "jobs").string();
    const Ended played = run({"plot",
                              "play",
                              (folder / "diagonal.txt").string(),
                              "--period",
                              "0.04",
                              "--port",
                              port,
                              "--log",
                              log,
                              "--json"});
    EXPECT_EQ(played.exit_code, 0) << played.err;
    EXPECT_THAT(played.out, HasSubstr("\"points\": 36"));
    EXPECT_THAT(played.out, HasSubstr("\"time_s\": 1.4"));
    EXPECT_THAT(played.out, HasSubstr("\"p99\""));
    EXPECT_THAT(table.stop().out, HasSubstr("36 records executed, 0 invalid lines, at X 10.0000 Y 10.0000"));

    EXPECT_THAT(played.err,
                HasSubstr("it is unknown whether the table accepts records as \"t {X} {Y} {Z} {a} {s}\""));

    Emulator other((folder / "other").string(), {"--record", "{X};{Y};{Z}"}, "table");
    const Ended unknown = run({"plot",
                               "play",
                               (folder / "diagonal.txt").string(),
                               "--period",
                               "0.04",
                               "--port",
                               (folder / "other").string(),
                               "--log",
                               log});
    EXPECT_EQ(unknown.exit_code, 0) << unknown.err;
    // There was no answer, so that nothing is known to be executed.
    const std::string sent = run({"jobs", log}).out;
    EXPECT_THAT(sent, HasSubstr("36 of 36 blocks were sent."));
    EXPECT_THAT(sent, testing::Not(HasSubstr("executed")));
    const std::string told = other.stop().out;
    EXPECT_THAT(told, HasSubstr("0 records executed, 36 invalid lines"));
    EXPECT_THAT(told, HasSubstr("this table expects records as \"{X};{Y};{Z}\""));

    const std::string diagonal = (folder / "diagonal.txt").string();
    EXPECT_EQ(run({"plot", "play", diagonal, "--period", "0.04", "--speed", "50", "--log", log}).exit_code,
              0);
    EXPECT_THAT(run({"jobs", log}).out, HasSubstr("36 of 36 blocks were confirmed as executed"));
    const Ended fast = run({"plot", "play", diagonal, "--period", "0.02"});
    EXPECT_EQ(fast.exit_code, 1);
    EXPECT_THAT(fast.err, HasSubstr("but its maximum is 10 mm/s"));
    write_content(folder / "bad.txt", "0,0,0\n1,nan,0\n");
    const Ended bad = run({"plot", "play", (folder / "bad.txt").string(), "--period", "1"});
    EXPECT_EQ(bad.exit_code, 1);
    EXPECT_THAT(bad.err, HasSubstr("bad.txt:2"));
}

// It began 5 mm above the plate, and the table, which stood on it, went 5 mm into it.
TEST(TableCommand, RelativePointsSayWhereTheTableHasToStand) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    write_content(folder / "down.csv", "0,0,5.00\n0,0,4.90\n");
    Emulator table(port, {"--relative", "--answer", "ok"}, "table");
    std::vector<std::string> words{"plot",
                                   "play",
                                   (folder / "down.csv").string(),
                                   "--period",
                                   "0.02",
                                   "--port",
                                   port,
                                   "--answer",
                                   "ok",
                                   "--log",
                                   (folder / "jobs").string()};
    EXPECT_THAT(run(words).err, Not(HasSubstr("the table must be")));
    words.emplace_back("--relative");
    EXPECT_THAT(run(words).err, HasSubstr("the table must be at X 0.000 Y 0.000 Z 5.000"));
}

TEST(TableCommand, AnAnswerThatComesTwiceEndsTheJobBeforeTheNextRecord) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    const std::string program = (folder / "way.ngc").string();
    std::string text = "G21 G90\nG0 X5 Y5\nG1 F600\n";
    for (int n = 1; n < 20; ++n) {
        text += "X" + std::to_string(5 + n) + "\n";
    }
    write_content(program, text + "M2\n");
    Emulator table(port, {"--answer", "ok", "--double", "4"}, "table");
    const Ended ended = run(send_words(program, port, folder));
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out + ended.err, HasSubstr("the machine sent 'ok' before record 5 was sent"));
    EXPECT_THAT(table.stop().out, HasSubstr("4 records executed"));
}

// Z is reported with the velocity that is too high for it, and which option lowers it.
TEST(TableCommand, PointsThatAreTooFastUpAndDownSayWhatToDo) {
    const ScratchFolder folder;
    write_content(folder / "fast.csv", "0,0,5.00\n0,0,4.50\n");
    const Ended ended = run({"plot", "play", (folder / "fast.csv").string(), "--period", "0.02"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("axis Z would move"));
    EXPECT_THAT(ended.err, HasSubstr("--plunge-velocity"));
    write_content(folder / "fast.csv", "0,0,5.00\n0.5,0,5.00\n");
    EXPECT_THAT(run({"plot", "play", (folder / "fast.csv").string(), "--period", "0.02"}).err,
                HasSubstr("--travel-velocity"));
}

TEST(TableCommand, EachBadLineOfAPointFileIsToldWithItsLine) {
    const ScratchFolder folder;
    const auto played = [&](const std::string& text) {
        write_content(folder / "points.csv", text);
        return run({"plot", "play", (folder / "points.csv").string(), "--period", "0.01"}).err;
    };
    EXPECT_THAT(played("0.00,0.00,0.00\n\n0.29,0.29,0.00\n"), HasSubstr("points.csv:3: axis X"));
    const std::string bad = played("0,0,0\n1;2\n\nnone\n");
    EXPECT_THAT(bad, HasSubstr("points.csv:2: '1;2' is not a point"));
    EXPECT_THAT(bad, HasSubstr("points.csv:4: 'none' is not a point"));
}

TEST(TableCommand, TheHelpSaysThatFaultsComeAfterBytes) {
    const Ended help = run({"emulate", "table", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    std::string words = help.out; // lines are broken anywhere
    words.erase(std::unique(words.begin(), words.end(), [](char a, char b) { return a <= ' ' && b <= ' '; }),
                words.end());
    std::ranges::replace(words, '\n', ' ');
    EXPECT_THAT(words, HasSubstr("alarm=N and estop=N counts bytes"));
}

TEST(TableCommand, WrongRecordsAreRefused) {
    const ScratchFolder folder;
    const Ended ended = run({"run",
                             small_project(folder.path(), "router-dome").string(),
                             "--driver",
                             "stream",
                             "--port",
                             "file:" + (folder / "out").string(),
                             "--record",
                             "t {X} {Q}"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("the record 't {X} {Q}': 'Q' does not exist"));
}

} // namespace
} // namespace millwright::test
