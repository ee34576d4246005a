#include "core/base/error.h"
#include "ui/actions/action.h"
#include "ui/actions/shortcut.h"
#include "ui/actions/synonyms.h"

#include <gtest/gtest.h>

#include <set>

namespace millwright::actions {
namespace {

TEST(Catalogue, HasEveryIdAndEveryShortcutOnce) {
    const Catalogue catalogue;
    std::set<std::string_view> ids, shortcuts;
    for (const auto& action : catalogue.all()) {
        const ActionInfo& info = action->info();
        EXPECT_TRUE(ids.insert(info.id).second) << info.id;
        EXPECT_FALSE(info.title.empty()) << info.id;
        EXPECT_FALSE(info.tip.empty()) << info.id;
        if (!info.shortcut.empty()) {
            EXPECT_TRUE(shortcuts.insert(info.shortcut).second) << info.shortcut;
            EXPECT_NO_THROW((void)shortcut(info.shortcut));
        }
    }
}

TEST(Catalogue, FindsByIdOrSaysSo) {
    const Catalogue catalogue;
    EXPECT_EQ(catalogue.find("edit.undo").info().shortcut, "Ctrl+Z");
    EXPECT_EQ(catalogue.find_or_null("edit.und"), nullptr);
    EXPECT_THROW((void)catalogue.find("edit.und"), Defect);
}

TEST(Synonyms, AreOfActionsThatThereAre) {
    const Catalogue catalogue;
    std::set<std::string_view> seen;
    for (const std::string_view id : actions_with_synonyms()) {
        EXPECT_NE(catalogue.find_or_null(id), nullptr) << id;
        EXPECT_FALSE(synonyms_of(id).empty()) << id;
        EXPECT_TRUE(seen.insert(id).second) << id;
    }
    EXPECT_EQ(synonyms_of("no.action"), "");
}

} // namespace
} // namespace millwright::actions
