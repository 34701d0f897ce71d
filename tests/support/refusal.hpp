// The messages of errors.
#pragma once

#include "overturn/text/error.hpp"

#include <gtest/gtest.h>

#include <string>

namespace overturn {

/// Returns the message of the Error with this exit code that the call throws; empty if it throws
/// none.
template <class Call>
std::string refusal(int code, const Call& call)
{
    try {
        call();
        return {};
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code);
        return error.what();
    }
}

} // namespace overturn
