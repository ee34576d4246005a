// The G-code processor that computes with CORDIC (COordinate Rotation DIgital Computer): rotations from
// shifts and additions alone. This room is the arithmetic, the microprogrammed processor around it, its tools
// and its hardware description; it knows nothing of machines or of G-code text. Source: Amorn Chuaichu,
// "G-Code Processor Implementation Using CORDIC Algorithm", M.Eng. thesis, KMITL 2002; corrections and what
// we had to decide ourselves in docs/reference/cordic.md.
//
// Start at kernel.h (the iteration), number_format.h (what it computes with), interpolation.h (lines and
// arcs). Everything up to there is integer or IEEE 754 arithmetic without a mathematics library: the same
// bits on every machine, compiler and optimisation level. Angles rad, shifts as powers of two.
#pragma once

#include "core/cordic/interpolation.h"
#include "core/cordic/kernel.h"
#include "core/cordic/number_format.h"
#include "core/cordic/quadrant_fold.h"
#include "core/cordic/sequence.h"
