#include "topple_answer.hpp"

#include "print.hpp"

#include "overturn/answers/job_lines.hpp"
#include "overturn/answers/ranges_text.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace overturn {

namespace {

/// Such as "0.46 at 0.9034 g, 0.65 at 2.1296 g".
std::string friction_to_topple_text(const ToppleAnswer& answer, int decimals)
{
    constexpr std::size_t most = 3;
    const auto toppling = answer.requested().ranges.with(Verdict::topples);
    std::vector<std::string> list;
    for (std::size_t i = 0; i < std::min(most, toppling.size()); ++i) {
        const double friction = answer.friction_to_topple[i];
        list.push_back(fmt::format("{} at {:.{}f} g",
                                   std::isnan(friction) ? "unknown"
                                   : std::isinf(friction)
                                       ? "infinite"
                                       : fmt::format("{:.2f}", rounded_up(friction, 2)),
                                   rounded_down(toppling[i].first, decimals), decimals));
    }
    return fmt::format("{}{}", fmt::join(list, ", "),
                       toppling.size() > most ? ", and so on (see --json)" : "");
}

std::string friction_text(double friction)
{
    return std::isnan(friction) ? "unknown"
           : std::isinf(friction)
               ? "the block would leave the ground, so that the verdict is doubtful"
               : fmt::format("the verdict holds if the coefficient is at least {:.2f}",
                             rounded_up(friction, 2));
}

/// What a block that may slip does, in words. size: R [m], if it is known.
std::string slip_text(const ToppleAnswer& answer, const std::optional<double>& size)
{
    const SlipAnswer& slip = *answer.slip;
    const std::string moves =
        std::isinf(slip.moving_pga) ? "does not move at any strength"
        : slip.moving_pga < answer.lifting_pga
            ? fmt::format("slides from {:.4f} g{}", rounded_down(slip.moving_pga, 4),
                          slip.stays_flat ? ", does not rock" : "")
            : "lifts before it slides";
    std::string text = fmt::format("coefficient {}: {}", slip.friction, moves);
    if (!answer.verdict) {
        return text;
    }
    text += "; " + slide_text(slip.slide, slip.slide_peak, size);
    if (slip.slide_peak != 0 && answer.verdict != Verdict::undecided) {
        text += slip.without == answer.verdict     ? "; the verdict without slip is the same"
                : slip.without == Verdict::topples ? "; sliding helps: without slip it topples"
                : slip.without == Verdict::safe ? "; sliding harms: without slip it does not topple"
                                                : "; the verdict without slip is undecided";
    }
    return text;
}

/// The motion, but for its direction.
std::string motion_text(const Job& job, const ToppleOptions& options)
{
    const auto pulse = job.problem.scene.named_pulse();
    if (!pulse) {
        return record_lines(job).front();
    }
    std::string text = fmt::format("{}, period {} s", pulse->name, *options.period);
    for (const auto& [name, value] : pulse->numbers) {
        text += fmt::format(", {} {}", name, value);
    }
    return text + (job.shape ? "; " + shape_line(*job.shape) : "");
}

/// Dimensions that the command line gives, such as "0.55 m x 2.1 m, height of the centre of mass 1
/// m, ".
std::string dimensions_text(std::map<std::string, double> given)
{
    std::string text;
    if (given.contains("width") && given.contains("height")) {
        text = fmt::format("{} m x {} m, ", given.at("width"), given.at("height"));
        given.erase("width");
        given.erase("height");
    }
    for (const char* name :
         {"width", "height", "center_height", "center_offset", "radius_of_gyration"}) {
        if (given.contains(name)) {
            text += fmt::format("{} {} m, ", quantity(name).long_name, given.at(name));
        }
    }
    return text;
}

/// directions: how many are computed.
void print_block_and_motion(const Job& job, const ToppleOptions& options, std::size_t directions)
{
    const Scene& scene = job.problem.scene;
    print_row("block", dimensions_text(options.block) + block_line(job));
    std::string direction;
    if (directions > 1) {
        direction = "; directions 0 and 180 degrees, its mirror image";
    } else if (options.direction) {
        direction = fmt::format("; direction {} degrees", *options.direction);
    }
    if (scene.has_two_components()) {
        direction += fmt::format(", {:.3g} g", pga_of_unit(scene, only_point_of(job.problem)));
    }
    print_row("motion", motion_text(job, options) + direction);
    print_motion_of("", scene.motion_of);
    if (scene.theory != Scene().theory) {
        print_row("theory", name_of(scene.theory));
    }
}

void print_question(const std::vector<DirectedAnswer>& all, const ToppleOptions& options)
{
    print_block_and_motion(all.front().job, options, all.size());
    const RestitutionAnswer& requested = all.front().answer.requested();
    print_row(
        "restitution",
        std::isnan(requested.share)
            ? fmt::format("r = {:.4g}; r_max is not defined for so wide a block", requested.ratio)
        : requested.share == 1
            ? fmt::format("r = r_max = {:.4g}", requested.ratio)
            : fmt::format("r = {:.4g} = {:.4g} r_max", requested.ratio, requested.share));
}

void print_ranges(const Scene& scene, const ToppleAnswer& answer)
{
    const VerdictRanges& requested = answer.requested().ranges;
    print_row("lifts from", std::isinf(answer.lifting_pga)
                                ? "no strength"
                                : fmt::format("{:.4f} g", rounded_down(answer.lifting_pga, 4)));
    if (!requested.are_searched()) {
        return;
    }
    const int decimals = decimals_of(requested, answer.pga);
    print_row("topples", text_of(requested, decimals) +
                             (requested.ends_in_free_fall
                                  ? fmt::format("; at {:.6g} g the vertical motion cancels gravity",
                                                requested.end_of_search())
                                  : ""));
    if (!answer.friction_to_topple.empty()) {
        print_row("",
                  "friction coefficient to topple: " + friction_to_topple_text(answer, decimals));
    }
    if (answer.by_restitution.size() > 1) {
        fmt::print("\n{:>8}{:>9}   {}\n", "r/r_max", "r",
                   scene.worded("topples at a peak ground acceleration of"));
    }
    for (std::size_t i = 1; i < answer.by_restitution.size(); ++i) {
        const RestitutionAnswer& other = answer.by_restitution[i];
        fmt::print("{:>8.2f}{:>9.4f}   {}\n", other.share, other.ratio,
                   text_of(other.ranges, decimals_of(other.ranges, answer.pga)));
    }
}

std::string steps_text(const Scene& scene, const VariedQuantity& vary)
{
    return fmt::format("searched in steps of {:.4g}{}{}; narrower ranges may be missed",
                       step_of_search(scene, vary), unit_of(*vary.quantity),
                       scene.motion_traits().is_sensitive
                           ? ""
                           : ", halved where the motion indicates more changes");
}

} // namespace

void print_answer(const std::vector<DirectedAnswer>& all, const ToppleOptions& options)
{
    print_question(all, options);
    std::string_view name = "verdict";
    for (const std::string& sentence : verdict_sentences(all, options)) {
        print_row(name, sentence);
        name = "";
    }
    for (const auto& [job, history, answer] : all) {
        if (all.size() > 1) {
            fmt::print("\n");
            print_row("direction", fmt::format("{} degrees", answer.direction));
        }
        if (answer.verdict) {
            print_row("peak tilt", peak_text(answer.peak, job.problem));
        }
        if (answer.slip) {
            print_row("friction", slip_text(answer, size_of_only_block(job)));
        } else if (answer.friction_demand) {
            print_row("friction", job.problem.scene.worded(friction_text(*answer.friction_demand)));
        }
        print_ranges(job.problem.scene, answer);
    }
    if (all.front().job.problem.scene.motion_traits().is_sensitive && !options.without_search) {
        double undecided = 0;
        for (const auto& [job, history, answer] : all) {
            undecided = std::max(undecided, undecided_share(answer));
        }
        fmt::print("\nUnder a record, ranges narrower than the steps of {:.1g} % may be missed. {} "
                   "of the searched accelerations {} undecided.\n",
                   100 * toppling_step,
                   undecided > 0 ? fmt::format("Up to {:.2g} %", 100 * undecided) : "None",
                   undecided > 0 ? "are" : "is");
    }
}

void print_varied(const std::vector<DirectedRanges>& all, const ToppleOptions& options)
{
    const Problem& problem = all.front().job.problem;
    const VariedQuantity& vary = *options.vary;
    const auto text = [&](const VerdictRanges& ranges) {
        return text_of(ranges, decimals_of(ranges, vary.first), most_intervals,
                       unit_of(*vary.quantity));
    };
    print_block_and_motion(all.front().job, options, all.size());
    if (vary.quantity->role != Role::loss) {
        const double share = options.restitution_of_maximum.value_or(1);
        print_row("restitution",
                  options.restitution || options.velocity_restitution
                      ? fmt::format("r = {:.4g}", extent_of(all.front().job, "restitution")->first)
                  : share == 1 ? "r = r_max"
                               : fmt::format("r = {:.4g} r_max", share));
    }
    const VerdictRanges worst = worst_of(all);
    print_row("verdict", sentence_of(worst, options));
    print_row("topples", text(worst));
    for (const DirectedRanges& each : all.size() > 1 ? all : std::vector<DirectedRanges>()) {
        print_row("", fmt::format("in direction {}: {}", each.direction, text(each.ranges)));
    }
    print_row("", steps_text(problem.scene, vary));
}

} // namespace overturn
