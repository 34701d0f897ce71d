// A build without kernels for this processor: src/sweep/kernel.cpp is compiled with none.
#include "commands/kernel_choice.hpp"

#include "overturn/text/error.hpp"

#include <gmock/gmock.h>

namespace overturn {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(AKernelThatWasNotCompiled, IsRefusedAndTheBuildOptionIsNamed)
{
    if (!processor_runs(Kernel::avx2)) {
        GTEST_SKIP() << "this processor runs no kernel, which is reported first";
    }
    EXPECT_THAT([] { kernel_called("avx2"); },
                ThrowsMessage<Error>("--kernel avx2: this build has no kernel avx2. Configure it "
                                     "with -DOVERTURN_KERNELS=all."));
}

TEST(ABuildWithoutAKernelForThisProcessor, NamesTheBuildOption)
{
    if (!processor_runs(Kernel::one_lane)) {
        GTEST_SKIP() << "no build has a kernel for this processor";
    }
    EXPECT_THAT([] { kernel_called("auto"); },
                ThrowsMessage<Error>(HasSubstr("-DOVERTURN_KERNELS=all")));
}

} // namespace
} // namespace overturn
