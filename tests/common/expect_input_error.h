// EXPECT_INPUT_ERROR(statement, "part of the message").
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

#define EXPECT_INPUT_ERROR(statement, part)                                             \
  try {                                                                                 \
    statement;                                                                          \
    ADD_FAILURE() << "no error; expected one with '" << (part) << "'";                  \
  } catch (const ::viewcell::InputError& error) {                                       \
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what(); \
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what(); \
  }
