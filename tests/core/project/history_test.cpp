#include "core/project/history.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

namespace millwright::project {
namespace {

Project named(std::string name) {
    Project project = project_from_preset("dome");
    project.name = std::move(name);
    return project;
}

TEST(History, UndoAndRedoWalkThroughTheStepsByTitle) {
    History history(named("a"));
    history.commit(named("b"), "Rename to b");
    history.commit(named("c"), "Rename to c");
    EXPECT_EQ(history.undo_title(), "Rename to c");
    history.undo();
    EXPECT_EQ(history.current().name, "b");
    EXPECT_EQ(history.undo_title(), "Rename to b");
    EXPECT_EQ(history.redo_title(), "Rename to c");
    history.redo();
    EXPECT_EQ(history.current().name, "c");
    EXPECT_EQ(history.redo_title(), "");
}

TEST(History, ACommitDropsWhatWasUndone) {
    History history(named("a"));
    history.commit(named("b"), "b");
    history.undo();
    history.commit(named("c"), "c");
    EXPECT_EQ(history.redo_title(), "");
    history.undo();
    EXPECT_EQ(history.current().name, "a");
}

TEST(History, AStepThatChangesNothingIsNone) {
    History history(named("a"));
    history.commit(named("a"), "nothing");
    EXPECT_EQ(history.undo_title(), "");
}

TEST(History, AnotherProjectIsAStepWithANumberOfItsOwn) {
    History history(named("a"));
    history.commit(named("b"), "Rename");
    history.begin(named("b"), "Open"); // equal, and yet another
    history.commit(named("c"), "Rename");
    EXPECT_EQ(history.project_number(), 1);
    history.undo();
    EXPECT_EQ(history.undo_title(), "Open");
    history.undo();
    EXPECT_EQ(history.project_number(), 0);
    EXPECT_EQ(history.current().name, "b");
    history.begin(named("d"), "Open");
    EXPECT_EQ(history.project_number(), 2);
    EXPECT_EQ(history.redo_title(), "");
}

TEST(History, ADragIsOneStep) {
    History history(named("a"));
    history.commit(named("b"), "Drag", "point 3");
    history.commit(named("c"), "Drag", "point 3");
    history.commit(named("d"), "Drag", "point 4");
    history.undo();
    EXPECT_EQ(history.current().name, "c");
    history.undo();
    EXPECT_EQ(history.current().name, "a");
}

TEST(History, AClosedStepTakesNoMore) {
    History history(named("a"));
    history.commit(named("b"), "Drag", "point 3");
    history.close_step();
    history.commit(named("c"), "Drag", "point 3");
    history.undo();
    EXPECT_EQ(history.current().name, "b");
}

TEST(History, AnUndoneDragDoesNotTakeTheNextOne) {
    History history(named("a"));
    history.commit(named("b"), "Drag", "point 3");
    history.commit(named("c"), "Other");
    history.undo();
    history.commit(named("d"), "Drag", "point 3");
    history.undo();
    EXPECT_EQ(history.current().name, "b");
}

TEST(History, ADragBackToItsBeginningLeavesNoStep) {
    History history(named("a"));
    history.commit(named("b"), "Drag", "point 3");
    history.commit(named("a"), "Drag", "point 3");
    EXPECT_EQ(history.undo_title(), "");
    EXPECT_EQ(history.current().name, "a");
}

TEST(History, ADragThatIsTakenBackLeavesNoStepAndWhatCouldBeRedone) {
    History history(named("a"));
    history.commit(named("b"), "Other");
    history.undo();
    history.commit(named("c"), "Drag", "point 3");
    history.commit(named("d"), "Drag", "point 3");
    EXPECT_EQ(history.redo_title(), "");
    history.revert_step("point 3");
    EXPECT_EQ(history.current().name, "a");
    EXPECT_EQ(history.undo_title(), "");
    ASSERT_EQ(history.redo_title(), "Other");
    history.redo();
    EXPECT_EQ(history.current().name, "b");
}

TEST(History, TakesNothingBackButAStepThatGoesOn) {
    History history(named("a"));
    history.commit(named("b"), "Drag", "point 3");
    history.revert_step("point 4");
    EXPECT_EQ(history.current().name, "b");
    history.close_step();
    history.revert_step("point 3");
    history.revert_step("");
    EXPECT_EQ(history.current().name, "b");
    EXPECT_EQ(history.undo_title(), "Drag");
}

TEST(History, ForgetsTheOldestStepsFirst) {
    History history(named("start"));
    for (int n = 0; n < 600; ++n) {
        history.commit(named(std::to_string(n)), "step");
    }
    int undone = 0;
    while (!history.undo_title().empty()) {
        history.undo();
        ++undone;
    }
    EXPECT_EQ(undone, 500);
    EXPECT_EQ(history.current().name, "99");
}

TEST(History, RefusesToUndoOrRedoNothing) {
    History history(named("a"));
    EXPECT_THROW(history.undo(), Defect);
    EXPECT_THROW(history.redo(), Defect);
}

} // namespace
} // namespace millwright::project
