#include "ui/widgets/typed_text.h"

#include "ui/widgets/internal/state.h"

namespace millwright::widgets {

std::optional<std::string> typed_text(Ui& ui, std::string_view id) {
    const Ui::State::Edit& edit = ui.state().edit;
    return edit.path == ui.path(id) && !edit.called ? std::optional(edit.text) : std::nullopt;
}

} // namespace millwright::widgets
