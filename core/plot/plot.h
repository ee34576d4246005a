// Plots: drawings as strokes of a pen, and what becomes of them at a machine that cuts. HPGL files are read
// into strokes (hpgl/); strokes are decoded at constant path velocity. Lengths mm, speeds mm/s, times s.
// Sources: KMITL master's thesis 2006, forming software for wood and plastic; KMITL thesis, HPGL decoder and
// constant-velocity control of an XYZ table, ch. 3. What is taken from each: docs/reference/plot.md.
#pragma once

#include "core/plot/hpgl/reader.h"
#include "core/plot/strokes.h"
