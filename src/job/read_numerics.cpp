#include "read_steps.hpp"

#include <algorithm>

namespace overturn {

Numerics read_numerics(const Entry& job, bool is_recorded)
{
    const Entry entry = table_of(job, "numerics");
    Numerics numerics;
    numerics.method =
        choice_of(entry, "method", method_names, is_recorded ? Method::taylor : numerics.method);
    if (is_recorded && numerics.method != Method::taylor) {
        refuse(*find(entry, "method"),
               " = \"{}\" is for pulses only. Under a record, use \"taylor\", the default.",
               name_of(numerics.method));
    }
    numerics.resolve = boolean_of(entry, "resolve", numerics.resolve);
    numerics.tolerance = quantity_of(
        entry, "tolerance", numerics.resolve ? tolerance_to_resolve_from : numerics.tolerance);
    numerics.fill = boolean_of(entry, "fill", numerics.fill);
    numerics.audit = quantity_of(entry, "audit", numerics.audit);
    if (const auto audit = find(entry, "audit"); audit && !numerics.fill) {
        refuse(*audit, " needs fill = true: without filling, every point is integrated.");
    }
    return numerics;
}

void expect_fillable(const Entry& entry, const Problem& problem)
{
    const std::string reason = problem.numerics.fill ? reason_not_to_fill(problem) : "";
    if (!reason.empty()) {
        refuse(*find(*find(entry, "numerics"), "fill"),
               " = true is not possible: {}. Remove it to integrate every point.", reason);
    }
}

void expect_known_errors(const Entry& job, const Problem& problem)
{
    const auto& [scene, grid, numerics, product, fields] = problem;
    const bool asked =
        numerics.resolve || std::find(fields.begin(), fields.end(), Field::error) != fields.end();
    if (asked && !knows_errors(numerics)) {
        refuse(*find(*find(job, "numerics"), "tolerance"),
               " = {} is too loose for {}: above {} the steps of \"rk45\" are too long for "
               "reliable error bounds. Lower it, or use method = \"taylor\".",
               numerics.tolerance, numerics.resolve ? "resolve" : "the field \"error\"",
               largest_rk45_tolerance_with_error);
    }
}

void expect_contact(const Entry& job, const Problem& problem)
{
    if (problem.scene.theory != Theory::linear) {
        return;
    }
    for (const Field field : {Field::friction, Field::normal}) {
        if (std::ranges::count(problem.fields, field) > 0) {
            refuse(
                *find(*find(job, "output"), "fields"),
                " contains \"{}\", but the linear theory has no forces of the contact. Remove it, "
                "or use theory = \"nonlinear\".",
                name_of(field));
        }
    }
}

} // namespace overturn
