// What the fuzz programs start from is whole: a seed that is refused at its first line leads nowhere.
#include "core/base/files.h"
#include "core/cordic/assembler.h"
#include "core/cordic/microprogram.h"
#include "core/cordic_control/plc.h"
#include "core/cordic_control/plc_assembler.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::cordic {
namespace {

std::vector<std::filesystem::path> seeds_of(std::string_view program) {
    std::vector<std::filesystem::path> files;
    for (const auto& file :
         std::filesystem::directory_iterator(std::filesystem::path("tests/fuzz/seeds") / program)) {
        files.push_back(file.path());
    }
    EXPECT_GE(files.size(), 2U) << program;
    return files;
}

TEST(FuzzSeeds, Assemble) {
    for (const auto& file : seeds_of("cordic_assembler")) {
        const Assembled program = assemble(read_file(file), file);
        EXPECT_TRUE(program.errors.empty()) << file << program.errors.front().message;
    }
}

TEST(FuzzSeeds, AreImages) {
    for (const auto& file : seeds_of("cordic_image")) {
        const std::string text = read_file(file);
        const std::vector<std::uint8_t> bytes(text.begin(), text.end());
        EXPECT_FALSE(parse_image(bytes, file).code.empty()) << file;
    }
}

TEST(FuzzSeeds, AreMicroprograms) {
    const auto constants = microprogram_constants(thesis_sequence(), fixed_format(4, 12));
    for (const auto& file : seeds_of("cordic_microcode")) {
        const auto [program, errors] = assemble_microprogram(read_file(file), file, constants);
        EXPECT_TRUE(errors.empty()) << file << errors.front().message;
        EXPECT_GT(program.count, 0) << file;
    }
}

TEST(FuzzSeeds, AreLogicWithChangesOfInputs) {
    for (const auto& file : seeds_of("cordic_plc")) {
        const std::string text = read_file(file);
        const auto sign = text.find('#');
        ASSERT_NE(sign, std::string::npos) << file;
        const PlcProgram logic = assemble_plc(text.substr(0, sign), file);
        EXPECT_TRUE(logic.errors.empty()) << file << logic.errors.front().message;
        const ReadInputs inputs = read_inputs(text.substr(sign + 1), file);
        EXPECT_FALSE(inputs.changes.empty()) << file;
        EXPECT_TRUE(inputs.errors.empty()) << file << inputs.errors.front().message;
    }
}

} // namespace
} // namespace millwright::cordic
