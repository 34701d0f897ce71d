// A build whose kernels this processor cannot run: src/sweep/kernel.cpp is compiled with none.
#include "commands/exit_code.hpp"
#include "commands/kernel_choice.hpp"

#include <gmock/gmock.h>

namespace overturn {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(AKernelThatWasNotCompiled, IsRefusedWithTheOptionThatCompilesIt)
{
    if (!processor_runs(Kernel::avx2)) {
        GTEST_SKIP() << "this processor runs no kernel, which is said first";
    }
    EXPECT_THAT(
        [] { kernel_called("avx2"); },
        ThrowsMessage<UsageError>("--kernel avx2: this build has no kernel avx2. Configure it "
                                  "with -DOVERTURN_KERNELS=all."));
}

TEST(ABuildWithoutAKernelForThisProcessor, NamesTheOptionThatCompilesOne)
{
    if (!processor_runs(Kernel::one_lane)) {
        GTEST_SKIP() << "no build has one";
    }
    EXPECT_THAT([] { kernel_called("auto"); },
                ThrowsMessage<ProcessorError>(HasSubstr("-DOVERTURN_KERNELS=all")));
}

} // namespace
} // namespace overturn
