#include "ui/render/input_state.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>

namespace millwright::render {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TypedEvent press(int key, int mods = 0) {
    return {.character = {}, .button = {}, .key = key, .scancode = 0, .action = GLFW_PRESS, .mods = mods};
}
TypedEvent release(int key) {
    return {.character = {}, .button = {}, .key = key, .scancode = 0, .action = GLFW_RELEASE, .mods = 0};
}
TypedEvent character(char c) {
    return {.character = static_cast<unsigned int>(c)};
}
bool up(int /*key*/) {
    return false;
}

TEST(Typing, IsNotHeldBackWhereNobodyTypesText) {
    Typing typing;
    const std::vector<TypedEvent> events{character('1'), press(GLFW_KEY_ENTER), character('2')};
    typing.add(events);
    EXPECT_EQ(typing.next(false, up), events);
    EXPECT_FALSE(typing.waits());
}

TEST(Typing, GivesEnterAFrameBehindTheCharactersBeforeIt) {
    Typing typing;
    typing.add({press(GLFW_KEY_5),
                character('5'),
                release(GLFW_KEY_5),
                press(GLFW_KEY_ENTER),
                release(GLFW_KEY_ENTER),
                press(GLFW_KEY_X),
                character('X')});
    EXPECT_THAT(typing.next(true, up), ElementsAre(press(GLFW_KEY_5), character('5'), release(GLFW_KEY_5)));
    EXPECT_TRUE(typing.waits());
    EXPECT_THAT(typing.next(true, up),
                ElementsAre(press(GLFW_KEY_ENTER), release(GLFW_KEY_ENTER), press(GLFW_KEY_X)));
    EXPECT_THAT(typing.next(true, up), ElementsAre(character('X')));
    EXPECT_FALSE(typing.waits());
}

/// A key is seen again only if a frame saw it up in between.
TEST(Typing, GivesAKeyASecondTimeWhenItWasSeenUp) {
    Typing typing;
    typing.add(
        {press(GLFW_KEY_ENTER), release(GLFW_KEY_ENTER), press(GLFW_KEY_ENTER), release(GLFW_KEY_ENTER)});
    EXPECT_THAT(typing.next(true, up), ElementsAre(press(GLFW_KEY_ENTER), release(GLFW_KEY_ENTER)));
    EXPECT_THAT(typing.next(true, [](int) { return true; }), IsEmpty());
    EXPECT_THAT(typing.next(true, up), ElementsAre(press(GLFW_KEY_ENTER), release(GLFW_KEY_ENTER)));
}

TEST(Typing, TellsWhatIsLetGoAtOnce) {
    Typing typing;
    typing.add({character('1'), press(GLFW_KEY_ENTER), character('2'), release(GLFW_KEY_EQUAL)});
    EXPECT_THAT(typing.next(true, up), ElementsAre(character('1'), release(GLFW_KEY_EQUAL)));
}

/// A click into the view takes the keyboard from a field; what was typed before it is not for the view.
TEST(Typing, AClickWaitsForWhatWasTypedBeforeIt) {
    Typing typing;
    const TypedEvent click{.character = {}, .button = 0};
    typing.add({character('1'), press(GLFW_KEY_ENTER), character('2'), click, character('3')});
    EXPECT_THAT(typing.next(true, up), ElementsAre(character('1')));
    EXPECT_TRUE(typing.waits_for_button(0));
    EXPECT_FALSE(typing.waits_for_button(1));
    EXPECT_THAT(typing.next(true, up), ElementsAre(press(GLFW_KEY_ENTER)));
    EXPECT_THAT(typing.next(true, up), ElementsAre(character('2')));
    EXPECT_TRUE(typing.waits_for_button(0));
    EXPECT_THAT(typing.next(true, up), ElementsAre(click));
    EXPECT_FALSE(typing.waits_for_button(0));
    EXPECT_THAT(typing.next(false, up), ElementsAre(character('3')));
}

TEST(Typing, KeepsCommandsAndCharactersApart) {
    Typing typing;
    typing.add({character('a'), press(GLFW_KEY_LEFT_CONTROL), press(GLFW_KEY_V, GLFW_MOD_CONTROL)});
    EXPECT_THAT(typing.next(true, up), ElementsAre(character('a'), press(GLFW_KEY_LEFT_CONTROL)));
    EXPECT_THAT(typing.next(true, up), ElementsAre(press(GLFW_KEY_V, GLFW_MOD_CONTROL)));
}

/// A text field as ImGui 1.86 has it: characters first, then keys, each once per frame.
struct Field {
    std::string text;
    std::set<int> down, seen;

    void frame(const std::vector<TypedEvent>& events) {
        std::set<int> quick = down;
        for (const TypedEvent& event : events) {
            if (event.character) {
                text += static_cast<char>(*event.character);
            } else if (event.action == GLFW_PRESS) {
                down.insert(event.key);
                quick.insert(event.key);
            } else {
                down.erase(event.key);
            }
        }
        for (const int key : quick) {
            if (!seen.contains(key)) {
                obey(key);
            }
        }
        seen = quick;
    }
    void obey(int key) {
        if (key == GLFW_KEY_ENTER) {
            text += '\n';
        } else if (key == GLFW_KEY_BACKSPACE && !text.empty()) {
            text.pop_back();
        }
    }
};

TEST(Typing, WritesWhatWasTypedHoweverManyEventsAFrameGets) {
    std::mt19937 random(20261123);
    for (int run = 0; run < 500; ++run) {
        std::vector<TypedEvent> events;
        std::string wanted;
        for (int n = 0; n < 60; ++n) {
            const int kind = static_cast<int>(random() % 5);
            const int key = kind == 0   ? GLFW_KEY_ENTER
                            : kind == 1 ? GLFW_KEY_BACKSPACE
                                        : GLFW_KEY_A + static_cast<int>(random() % 26);
            events.push_back(press(key));
            if (kind == 0) {
                wanted += '\n';
            } else if (kind == 1) {
                wanted = wanted.substr(0, wanted.empty() ? 0 : wanted.size() - 1);
            } else {
                wanted += static_cast<char>(key);
                events.push_back(character(static_cast<char>(key)));
            }
            events.push_back(release(key));
        }
        Typing typing;
        Field field;
        std::size_t told = 0;
        for (int frame = 0; frame < 1000 && (told < events.size() || typing.waits()); ++frame) {
            const std::size_t more = std::min(events.size() - told, random() % 20);
            typing.add({events.begin() + static_cast<std::ptrdiff_t>(told),
                        events.begin() + static_cast<std::ptrdiff_t>(told + more)});
            told += more;
            field.frame(typing.next(true, [&](int key) { return field.seen.contains(key); }));
        }
        EXPECT_EQ(field.text, wanted) << "run " << run;
    }
}

} // namespace
} // namespace millwright::render
