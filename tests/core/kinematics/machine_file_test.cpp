#include "core/kinematics/machine_file.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <string>

namespace millwright::kinematics {
namespace {

namespace fs = std::filesystem;

/// What reading says of the shipped A-on-C table with `from` replaced by `to`.
std::string file_fault(const std::string& from, const std::string& to) {
    std::string text = read_file("assets/machines/ac-table.json");
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
    const fs::path file = fs::temp_directory_path() / ("machine_" + std::to_string(::getpid()) + ".json");
    write_file(file, text);
    std::string said;
    try {
        (void)read_machine(file);
    } catch (const Error& error) {
        said = error.what();
        EXPECT_EQ(error.diagnostic().place.file, file);
        EXPECT_GT(error.diagnostic().place.line, 0);
    }
    fs::remove(file);
    return said;
}

TEST(MachineFile, ReadsDegreesIntoRadians) {
    const MachineModel machine = read_machine("assets/machines/rotary-tilt-listing.json");
    const MachineAxis& B = machine.axis(machine.axis_index('B'));
    EXPECT_DOUBLE_EQ(B.zero_offset, -pi / 2.0);
    EXPECT_DOUBLE_EQ(B.max, from_degrees(200.0));
    EXPECT_EQ(machine.description().angle_formulas, AngleFormulas::rotary_tilt);
}

TEST(MachineFile, ReadsTheJerkWhereThereIsOne) {
    const MachineModel table = read_machine("assets/machines/ac-table.json");
    EXPECT_DOUBLE_EQ(table.axis(0).max_jerk, 50000.0);
    EXPECT_DOUBLE_EQ(table.axis(table.axis_index('A')).max_jerk, from_degrees(16000.0));
    const MachineModel router = read_machine("assets/machines/router-xyz.json");
    EXPECT_EQ(router.axis(0).max_jerk, std::numeric_limits<double>::infinity());
}

TEST(MachineFile, EveryShippedMachineReads) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator("assets/machines")) {
        if (entry.path().extension() == ".json") {
            EXPECT_NO_THROW((void)read_machine(entry.path())) << entry.path();
            ++count;
        }
    }
    EXPECT_GE(count, 4);
}

TEST(MachineFile, FaultsAreReportedWithLineAndField) {
    EXPECT_NE(file_fault("\"max_velocity\": 60", "\"max_velocity\": \"fast\"").find("table[0]/max_velocity"),
              std::string::npos);
    EXPECT_NE(file_fault("\"max_jerk\": 50000", "\"max_jerk\": 0").find("max_jerk"), std::string::npos);
    EXPECT_NE(file_fault("\"rotary\"", "\"round\"").find("'round' is neither"), std::string::npos);
    EXPECT_NE(file_fault("[-1, 0, 0]", "[0, 0, 0]").find("must not be zero"), std::string::npos);
    EXPECT_NE(file_fault("\"tool_tip\"", "\"tool_top\"").find("tool_top"), std::string::npos);
    EXPECT_NE(file_fault("millwright-machine", "something-else").find("not a machine file"),
              std::string::npos);
    EXPECT_NE(file_fault("\"version\": 1", "\"version\": 9").find("version"), std::string::npos);
    EXPECT_NE(file_fault("[-120, 120]", "[120, -120]").find("lower limit"), std::string::npos);
    EXPECT_NE(file_fault("\"axis\": \"C\"", "\"axis\": \"A\"").find("occurs twice"), std::string::npos);
    EXPECT_NE(file_fault("\"workpiece_offset\": [0, 0, 0]", "\"workpiece_offset\": [0, 0, 1e300]")
                  .find("workpiece_offset[2]"),
              std::string::npos);
}

TEST(MachineFile, AHeadThatSwingsSaysHowLongItsToolIs) {
    const auto model = read_machine("assets/machines/ca-head.json");
    EXPECT_TRUE(model.swings_tool());
    EXPECT_EQ(model.description().tool_length, 40.0);
    std::string text = read_file("assets/machines/ca-head.json");
    const std::string_view field = "    \"tool_length\": 40,\n";
    text.erase(text.find(field), field.size());
    const auto file =
        std::filesystem::temp_directory_path() / ("no_tool_length_" + std::to_string(::getpid()) + ".json");
    write_file(file, text);
    try {
        (void)read_machine(file);
        ADD_FAILURE() << "it was taken";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("tool_length"), std::string::npos) << error.what();
    }
    std::filesystem::remove(file);
}

TEST(MachineFile, AMissingFileIsNamed) {
    EXPECT_THROW((void)read_machine("assets/machines/none.json"), Error);
}

} // namespace
} // namespace millwright::kinematics
