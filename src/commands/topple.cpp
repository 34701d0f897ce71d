// Whether one block topples under one motion, and at which peak accelerations, or at which values
// of another quantity.
#include "commands.hpp"
#include "prepare_output.hpp"
#include "report/print.hpp"
#include "report/progress.hpp"
#include "report/topple_answer.hpp"

#include "overturn/answers/job_lines.hpp"
#include "overturn/file/history_and_accuracy_files.hpp"
#include "overturn/sweep/in_threads.hpp"
#include "overturn/sweep/kernel.hpp"

namespace overturn {

int topple(const ToppleOptions& options)
{
    widest_kernel(); // throws if this processor supports none
    ToppleRequest request = options;
    request.with_history = !options.history.empty();
    std::vector<Job> jobs = jobs_of(request);
    const Job& job = jobs.front();
    if (!options.json) {
        print_warnings(warnings_on(job));
    }
    if (options.vary) {
        const std::vector<DirectedRanges> all = ranges_for(jobs, request);
        if (options.json) {
            fmt::print("{}", json_of(all, request));
        } else {
            print_varied(all, options);
        }
        return exit_code::complete;
    }
    std::optional<OutputLock> output_lock;
    if (!options.history.empty()) {
        output_lock.emplace(options.history);
        expect_study_output(options.history, FileKind::history, *output_lock);
    }
    const std::vector<DirectedAnswer> answers = [&] {
        Progress progress("restitutions");
        return answers_for(std::move(jobs), request, threads_of_processor(),
                           [&](std::size_t done, std::size_t all) {
                               progress.update(std::int64_t(done), std::int64_t(all));
                           });
    }();
    if (!options.history.empty()) {
        write_history_file(options.history, answers.front().job, *answers.front().history);
    }
    if (options.json) {
        fmt::print("{}", json_of(answers, request));
        return exit_code::complete;
    }
    print_answer(answers, options);
    if (!options.history.empty()) {
        fmt::print("\n{0}: written{1}; draw it with tools/plot_history {0} --units physical\n",
                   options.history,
                   answers.size() > 1 ? fmt::format(", the motion in direction {}",
                                                    answers.front().answer.direction)
                                      : "");
    }
    return exit_code::complete;
}

} // namespace overturn
