// Whether a run goes on whose error is not known any more.
#pragma once

namespace overturn {

/// What becomes of a block once it is in doubt whether it struck, or how fast. If it will be
/// integrated again anyhow, thousands of bounces need not be followed for nothing.
enum class InDoubt { goes_on, ends };

} // namespace overturn
