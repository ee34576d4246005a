// Everything below the 3D layers: OpenGL contexts (a window, or no display at all), GL objects, camera and
// picking, meshes, lines, points, colours, pictures, and Dear ImGui on top of a context. It knows nothing of
// machining.
#pragma once

#include "ui/render/bounds.h"
#include "ui/render/camera.h"
#include "ui/render/color_map.h"
#include "ui/render/coloring.h"
#include "ui/render/context.h"
#include "ui/render/convert.h"
#include "ui/render/framebuffer.h"
#include "ui/render/imgui_session.h"
#include "ui/render/ink.h"
#include "ui/render/offscreen_context.h"
#include "ui/render/painter.h"
#include "ui/render/picture.h"
#include "ui/render/view.h"
#include "ui/render/view_colors.h"
#include "ui/render/view_target.h"
#include "ui/render/window_context.h"
