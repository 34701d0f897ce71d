#include "audit_text.hpp"

#include "human_units.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>

namespace overturn {

std::string audit_text(const AuditCount& audit)
{
    if (audit.checked == 0) {
        return "no filled point was checked";
    }
    constexpr double risk = 0.05;
    // The upper bound of Clopper and Pearson.
    const double bound = boost::math::binomial_distribution<>::find_upper_bound_on_p(
        double(audit.checked), double(audit.wrong), risk);
    return fmt::format("{} filled {} checked, {} wrong: at most {:.2g} of the filled points were "
                       "wrong before repair (95 % confidence)",
                       audit.checked, noun_of(double(audit.checked), "points"), audit.wrong, bound);
}

} // namespace overturn
