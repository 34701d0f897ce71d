// The result of the audit of a filled spectrum, in words.
#pragma once

#include "overturn/sweep/fill.hpp"

#include <string>

namespace overturn {

/// How many filled points were checked and wrong, with an upper bound of the share of wrong points.
std::string audit_text(const AuditCount& audit);

} // namespace overturn
