#include "overturn/answers/topple.hpp"

#include "motion_lines.hpp"

#include "overturn/answers/history.hpp"
#include "overturn/answers/ranges_text.hpp"
#include "overturn/problem/axis.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <numeric>

namespace overturn {

namespace {

/// The values of a varied quantity in its job, which show whether those between are allowed.
constexpr int values_in_job = 17;

/// The text of a job with a single point, or with values of a varied quantity. If the command line
/// gives no strength, its motion is 0.
std::string job_text(const ToppleRequest& request)
{
    const std::string record = request.record.empty() ? "" : quoted_utf8(request.record);
    std::string text = motion_lines(request, record);
    if (record.empty()) {
        text += fmt::format("pulse_period = {}\n", *request.period);
    }
    if (request.restitution) {
        text += fmt::format("restitution = {}\n", *request.restitution);
    } else if (request.velocity_restitution) {
        text += fmt::format("velocity_restitution = {}\n", *request.velocity_restitution);
    } else if (request.restitution_of_maximum ||
               !(request.vary && request.vary->quantity->role == Role::loss)) {
        text += fmt::format("restitution_of_maximum = {}\n",
                            request.restitution_of_maximum.value_or(1));
    }
    if (request.vary) {
        const auto& [quantity, first, last] = *request.vary;
        text += fmt::format("{} = {{ first = {}, last = {}, count = {} }}\n", quantity->name, first,
                            last, first < last ? values_in_job : 1);
    }
    if (request.direction) {
        text += fmt::format("direction = {}\n", *request.direction);
    }
    text += "[block]\n";
    for (const auto& [name, value] : request.block) {
        text += fmt::format("{} = {}\n", name, value);
    }
    return text;
}

/// What the parser of the command line does not check.
void expect_consistent(const ToppleRequest& request)
{
    const auto refuse_if = [](bool wrong, const std::string& message) {
        if (wrong) {
            throw Error(exit_code::usage, message);
        }
    };
    refuse_if(request.record.empty() && !request.period,
              "the ground motion is missing. Give --period with the period of a pulse [s], or "
              "--record with the file of a recorded motion.");
    expect_keys_of_scene(request.overrides);
    refuse_if(request.without_search && !request.has_strength(),
              "--no-search leaves the verdict at one acceleration. Give --pga or --scale.");
    refuse_if(request.with_history && !request.has_strength(),
              "--history is that of one acceleration. Give --pga or --scale.");
    if (request.vary) {
        const std::string name(request.vary->quantity->name);
        refuse_if(!request.has_strength(),
                  "--vary searches at one acceleration. Give --pga or --scale.");
        refuse_if(
            request.block.contains(name) || (name == "restitution" && request.restitution) ||
                (name == "velocity_restitution" && request.velocity_restitution) ||
                (name == "restitution_of_maximum" && request.restitution_of_maximum),
            fmt::format("--vary {0} cannot be combined with a value of {0}. Remove one.", name));
    }
}

Job job_of(const ToppleRequest& request, const std::vector<std::string>& axes = {})
{
    std::vector<std::string> overrides = request.overrides;
    overrides.insert(overrides.end(), axes.begin(), axes.end());
    return read_job_text(job_text(request), command_line, overrides);
}

/// A sentence on the values of the varied quantity that describe a block, if some do.
std::string possible_values(const ToppleRequest& request)
{
    const auto& [quantity, first, last] = *request.vary;
    const auto is_possible = [&](double value) {
        ToppleRequest at = request;
        at.vary->first = at.vary->last = value;
        try {
            job_of(at);
            return true;
        } catch (const Error&) {
            return false;
        }
    };
    const std::vector<double> values = Axis(AxisRange{first, last, values_in_job}).values();
    const auto begin = std::ranges::find_if(values, is_possible);
    if (begin == values.end()) {
        return "";
    }
    // The last possible value on the way from a possible to an impossible one.
    const auto end_between = [&](double possible, double impossible) {
        constexpr int halvings = 12;
        for (int i = 0; i < halvings; ++i) {
            const double middle = std::midpoint(possible, impossible);
            (is_possible(middle) ? possible : impossible) = middle;
        }
        return possible;
    };
    const auto end = std::find_if_not(begin, values.end(), is_possible);
    constexpr int decimals = 4;
    const double least =
        begin == values.begin() ? first : rounded_up(end_between(*begin, *(begin - 1)), decimals);
    const double largest =
        end == values.end() ? last : rounded_down(end_between(*(end - 1), *end), decimals);
    return fmt::format(" Possible are values from {} to {}.", least, largest);
}

} // namespace

std::vector<Job> jobs_of(const ToppleRequest& given, const std::vector<std::string>& axes)
{
    expect_consistent(given);
    ToppleRequest request = given;
    const auto job = [&] {
        try {
            return job_of(request, axes);
        } catch (const Error& error) {
            throw Error(error.code(),
                        error.what() + (request.vary ? possible_values(request) : ""));
        }
    };
    std::vector<Job> jobs{job()};
    if (const std::size_t motions = jobs.front().motions.size(); motions > 1) {
        throw Error(exit_code::usage,
                    "--record matches {} files, but topple answers for one motion. "
                    "Give one file; for a suite, use overturn assess with a table of one "
                    "object, or write a job for overturn run.",
                    motions);
    }
    const std::vector<double> directions = directions_of(jobs.front().problem);
    if (directions.size() > 1) {
        jobs.clear();
        for (const double direction : directions) {
            request.direction = direction;
            jobs.push_back(job());
        }
    }
    return jobs;
}

namespace {

void expect_motion(const Problem& problem)
{
    if (!(pga_of_unit(problem.scene, only_point_of(problem)) > 0)) {
        throw Error(
            exit_code::job,
            "the record has no motion in the direction of {} degrees: its components cancel. "
            "Choose another --direction.",
            directions_of(problem).front());
    }
}

} // namespace

std::vector<DirectedAnswer>
answers_for(std::vector<Job> jobs, const ToppleRequest& request, int threads,
            const std::function<void(std::size_t done, std::size_t all)>& progress)
{
    std::vector<DirectedAnswer> all;
    for (Job& job : jobs) { // histories, which may be refused, before what may take minutes
        expect_motion(job.problem);
        auto history =
            request.with_history ? std::optional(history_of_only_point(job)) : std::nullopt;
        all.push_back({std::move(job), std::move(history), {}});
    }
    std::size_t answered = 0;
    ToppleQuestion question{.has_strength = request.has_strength(),
                            .pga = request.pga,
                            .pga_max = request.pga_max,
                            .searches = !request.without_search,
                            .other_restitutions = request.other_restitutions,
                            .threads = threads};
    if (progress) {
        question.progress = [&](std::size_t done, std::size_t restitutions) {
            progress(answered * restitutions + done, all.size() * restitutions);
        };
    }
    for (DirectedAnswer& each : all) {
        each.answer = answer_of(each.job.problem, question);
        ++answered;
    }
    std::ranges::stable_sort(all, is_worse, &DirectedAnswer::answer);
    return all;
}

std::vector<std::string> verdict_sentences(const std::vector<DirectedAnswer>& all,
                                           const ToppleRequest& request)
{
    std::vector<std::string> sentences;
    for (const auto& [job, history, answer] : all) {
        std::string place;
        if (all.size() > 1) {
            place = fmt::format(" in direction {}", answer.direction);
            place += sentences.empty() ? fmt::format(", worse than {}", all.back().answer.direction)
                                       : "";
        }
        if (answer.verdict) {
            sentences.push_back(verdict_sentence(answer, request.scale, place));
        }
    }
    return sentences;
}

std::vector<DirectedRanges> ranges_for(const std::vector<Job>& jobs, const ToppleRequest& request)
{
    return mapped(jobs, [&](const Job& job) {
        expect_motion(job.problem);
        const auto& [quantity, first, last] = *request.vary;
        return DirectedRanges{job, directions_of(job.problem).front(),
                              ranges_along(job.problem, *quantity, first, last)};
    });
}

} // namespace overturn
