// P5: what the program of Saengsasri, Nittayachin 1996 sends the card when it starts, in its order. The
// settings of the hand-shake among it (I3, I4, I6, I9) have tests of their own.
#include "tests/core/pmac/emulator/pmac_card.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::pmac {
namespace {

using test::PmacCard;
using testing::HasSubstr;

constexpr const char* up_to_reset = "WX:$786,$D,$43\nSAVE\n$$$";
constexpr const char* variables =
    "I8=0\nI5=0\nI100=1\nI200=1\nI300=1\nI400=1\nI180=1\nI280=1\nI380=1\nI480=1\nI169=20480\nI123=-32\nI130="
    "2000\n"
    "I111=0\nI280=1\nI380=1\nI100=1\nI900=1\nI120=2\nI121=1\nI190=1000\nQ &1\n"
    "#1->120X\n#2->222Y\n#3->150Z\n#4->150A\n#1HOMEZ #2HOMEZ #3HOMEZ #4HOMEZ\n"
    "M112->X:$C000,12\nM113->X:$C000,13\nM116->X:$C000,16\nM151->DP:$D201\nM152->DP:$D202\nM153->DP:$D203\n"
    "M154->Y:$D200,0\nM155->X:$D200,0";
constexpr const char* programs =
    "close\ndelete gather\ndelete trac\nopen prog 1\nclear\ninc\nta20\nts10\nlinear\nfrax(x,y,z,a)\nx10 y10 "
    "z10 a10 "
    "f0.5\nclose\nM113=0\nM151=0\nM152=0\nM153=0\nM154=1\nM155=1\n&1\nclose\ndelete gather\ndelete trac\n"
    "open plc 1\nclear\nif(m11=1)\ni130=10000\nelse\ni130=8000\nendif\nclose\nenable plc 1";

TEST(PmacStartUpP5, LeavesWhatTheThesisSays) {
    PmacCard pmac;
    EXPECT_EQ(pmac.send(up_to_reset), "");
    EXPECT_EQ(pmac.send(variables), "");
    EXPECT_EQ(pmac.send(programs), "");
    EXPECT_EQ(pmac.ask("#1->"), "120X");
    EXPECT_EQ(pmac.ask("#2->"), "222Y");
    EXPECT_EQ(pmac.ask("#3->"), "150Z");
    EXPECT_EQ(pmac.ask("#4->"), "150A");
    EXPECT_EQ(pmac.ask("I169"), "20480");
    EXPECT_EQ(pmac.ask("I123"), "-32");
    EXPECT_EQ(pmac.ask("I111"), "0");
    EXPECT_EQ(pmac.ask("I190"), "1000");
    EXPECT_EQ(pmac.ask("M151->"), "DP:$D201");
    EXPECT_EQ(pmac.ask("M154"), "1");
    EXPECT_EQ(pmac.ask("M155"), "1");
    EXPECT_THAT(pmac.ask("LIST PROG 1"), HasSubstr("X10Y10Z10A10"));
    EXPECT_THAT(pmac.ask("LIST PLC 1"), HasSubstr("I130=8000"));
    pmac.card.advance(0.1);
    EXPECT_EQ(pmac.ask("I130"), "2000"); // enabled, and not running while I5 is 0
    EXPECT_FALSE(pmac.card.moving());
    EXPECT_EQ(pmac.send("I5=2"), "");
    pmac.card.advance(0.1);
    EXPECT_EQ(pmac.ask("I130"), "8000");
    EXPECT_EQ(pmac.send("I8=2"), ""); // when the program ends
}

} // namespace
} // namespace millwright::pmac
