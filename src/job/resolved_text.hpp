// The canonical text of a job.
#pragma once

#include "overturn/job/job.hpp"

#include <string>

namespace overturn {

/// TOML that read_job reads back to an equal job: fixed order, every default spelled out.
std::string resolved_text(const Job& job);

} // namespace overturn
