// Typed tests over the methods: TYPED_TEST_SUITE(Suite, EveryMethod, MethodName).
#pragma once

#include "overturn/integrate/forced_stage.hpp"

#include <gtest/gtest.h>

#include <string>

namespace overturn {

using EveryMethod = testing::Types<RungeKutta, Taylor<14>, Taylor<20>>;

struct MethodName {
    template <class Method>
    static std::string GetName(int)
    {
        if constexpr (std::same_as<Method, RungeKutta>) {
            return "RungeKutta";
        } else {
            return std::same_as<Method, Taylor<14>> ? "Taylor14" : "Taylor20";
        }
    }
};

} // namespace overturn
