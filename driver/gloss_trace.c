// SPDX-License-Identifier: GPL-2.0-only
/* The one file that makes the tracepoints. */
#ifndef __CHECKER__
#define CREATE_TRACE_POINTS
#endif
#include "gloss_trace.h"
