// Questions and answers in JSON, for a program that holds no files: the page in a browser.
#pragma once

#include "overturn/answers/topple.hpp"

#include <string>
#include <string_view>

namespace overturn {

/// The answer to a question: an object whose member `question` is one of
///   topple    the answer of `overturn topple --json`; the other members are the arguments of
///             overturn.topple() of the Python package
///   assess    that of `overturn assess --json`; the members are the arguments of
///   overturn.assess(),
///             with the text of a table as `table`
///   history   the motion of a block, with the members of topple and `samples`
///   spectrum  the verdicts at points of a plane, with the members of topple, `pga` as a list, and
///             `x`: {"quantity": "pulse_period", "values": [...]}
///   record    the components of a recorded motion
/// Lengths are in m, angles in rad, times in s, accelerations over g. Throws Error.
std::string answer_to(std::string_view question);

/// The block and the motion of a question topple. Throws Error.
ToppleRequest topple_request_of(std::string_view question);

} // namespace overturn
