// GTKWave's own readers on our wave files.
#include "core/cordic/assembler.h"
#include "core/cordic/vcd.h"
#include "tests/core/cordic/waves.h"
#include "tests/support/oracle.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace millwright {
namespace {

using namespace cordic;

/// An arc, as waves.
std::string waves_of_an_arc(const NumberFormat& format) {
    const Assembled made =
        assemble("mov X0, 1\nmov Vmax, 1\nmov Amax, 1\nmov Dz, 0.25\nmov N, 3\nG03\nmov P, 117\nMUSER\nhlt\n",
                 "arc.asm",
                 format);
    EXPECT_TRUE(made.errors.empty());
    Processor processor({.publishing = Publishing::bus}, made.image);
    VcdWriter writer(format, 8e6);
    while (processor.state().stop == Stop::none) {
        processor.clock();
        writer.add(processor.state());
    }
    return writer.take();
}

class GtkWave : public OracleTest {
protected:
    GtkWave() : OracleTest("vcd2fst", "gtkwave") {}
};

// GTKWave shows what it has converted to its own format, which is converted back here.
TEST_F(GtkWave, ReadsEverySignalAndEveryChange) {
    for (const NumberFormat& format : {binary32, binary64, fixed_format(8, 24), fixed_format(2, 6)}) {
        const ::millwright::test::ScratchFolder folder;
        const std::string ours = waves_of_an_arc(format);
        std::ofstream(folder.path() / "arc.vcd") << ours;
        const ProgramRun converted =
            run({(folder.path() / "arc.vcd").string(), (folder.path() / "arc.fst").string()});
        ASSERT_EQ(converted.exit_code, 0) << converted.output;
        const ProgramRun back = run_other("fst2vcd", {(folder.path() / "arc.fst").string()});
        ASSERT_EQ(back.exit_code, 0) << back.output;
        const ::millwright::test::Waves wanted = ::millwright::test::read_waves(ours);
        const ::millwright::test::Waves seen = ::millwright::test::read_waves(back.output);
        EXPECT_EQ(seen.bits, wanted.bits);
        EXPECT_EQ(seen.changes, wanted.changes) << to_text(format);
        EXPECT_EQ(seen.bits.at("page"), 8);
    }
}

} // namespace
} // namespace millwright
