// The messages of errors.
#pragma once

#include "overturn/text/error.hpp"

#include <gtest/gtest.h>

#include <string>

namespace overturn {

/// Returns the message of the Error of kind `output` thrown by the call; empty if none is thrown.
template <class Call>
std::string refusal(const Call& call)
{
    try {
        call();
        return {};
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), exit_code::output);
        return error.what();
    }
}

} // namespace overturn
