#include "core/base/sentences.h"

#include <gtest/gtest.h>

namespace millwright {
namespace {

TEST(Sentences, AQuestionGetsNoFullStop) {
    EXPECT_EQ(as_sentence("the card forgot the position: was it reset?"),
              "The card forgot the position: was it reset?");
    EXPECT_EQ(as_sentence("motor 1 was killed"), "Motor 1 was killed.");
    EXPECT_EQ(as_sentence("It is on."), "It is on.");
    EXPECT_EQ(as_sentence(""), "");
}

TEST(Sentences, AnAddressKeepsItsLetters) {
    EXPECT_EQ(as_sentence("tcp:127.0.0.1:1025: nobody answers"), "tcp:127.0.0.1:1025: nobody answers.");
    EXPECT_EQ(capitalised("virtual machine"), "Virtual machine");
}

TEST(Sentences, StandBehindEachOther) {
    EXPECT_EQ(with_sentence("is the way free?", "Look at it."), "is the way free? Look at it.");
    EXPECT_EQ(with_sentence("it stands", "Look at it."), "it stands. Look at it.");
    EXPECT_EQ(with_sentence("", "Look at it."), "Look at it.");
    EXPECT_EQ(with_clause("is the way free?", "3 blocks are left"), "is the way free? 3 blocks are left");
    EXPECT_EQ(with_clause("it stands", "3 blocks are left"), "it stands; 3 blocks are left");
    EXPECT_EQ(with_clause("", "3 blocks are left"), "3 blocks are left");
}

} // namespace
} // namespace millwright
