// The immediate-mode vocabulary in which all panels are written. Small fields, buttons and words are members
// of Ui (ui.h); larger pieces have a header of their own. No code outside this room and ui/render includes
// ImGui.
#pragma once

#include "ui/widgets/arithmetic.h"
#include "ui/widgets/canvas.h"
#include "ui/widgets/field_info.h"
#include "ui/widgets/fonts.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/legend.h"
#include "ui/widgets/listing.h"
#include "ui/widgets/matching.h"
#include "ui/widgets/menus.h"
#include "ui/widgets/notices.h"
#include "ui/widgets/permission.h"
#include "ui/widgets/places.h"
#include "ui/widgets/plot.h"
#include "ui/widgets/readout.h"
#include "ui/widgets/search.h"
#include "ui/widgets/splitter.h"
#include "ui/widgets/table.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/ticks.h"
#include "ui/widgets/timeline.h"
#include "ui/widgets/ui.h"
