// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Numbers, texts and tables between a script and its host. All of them may raise.

#include "flyball/runtime/board.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/parameters.h"

struct lua_State;

namespace flyball {

/// A number of the table at the top, or `otherwise`.
double number_field(lua_State* state, const char* name, double otherwise);

/// A text of the table at the top, which keeps it alive; empty when there is none.
const char* text_field(lua_State* state, const char* name);

void set_number(lua_State* state, const char* name, double value);

void push_knob(lua_State* state, const KnobSpec& spec, double value);

/// What is not known is left out.
void push_board(lua_State* state, const BoardModel& board);

void push_parameters(lua_State* state, const Parameters& given);

}  // namespace flyball
