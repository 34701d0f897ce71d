#include "commands.hpp"
#include "prepare_output.hpp"
#include "report/print.hpp"

#include "overturn/answers/job_lines.hpp"
#include "overturn/file/history_and_accuracy_files.hpp"
#include "overturn/job/job.hpp"
#include "overturn/text/error.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace overturn {

namespace {

/// Time of one pass over the sample, the median of several passes [s]: that of the processor, which
/// other programs disturb least.
double seconds_of(const AccuracyStudy& study, const Numerics& numerics)
{
    std::vector<double> times;
    double all = 0;
    while (times.size() < 3 || (all < 0.2 && times.size() < 25)) {
        const std::clock_t start = std::clock();
        study.compute_regions(numerics);
        times.push_back(double(std::clock() - start) / CLOCKS_PER_SEC);
        all += times.back();
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

/// The time to compute a point in 50 digits [s].
double seconds_in_digits(const Job& job)
{
    std::int64_t samples = 0;
    for (const Record& record : job.problem.scene.records()) {
        samples = std::max(samples, record->samples());
    }
    return 0.02 + 2e-4 * double(samples);
}

/// may_slip: whether rows have the error of the slide.
void print_head(const AccuracySample& sample, bool may_slip)
{
    const std::string_view slide[] = {may_slip ? "     slide" : "", may_slip ? "      99 %" : ""};
    print_line(fmt::format("{} points, {} with a settled verdict, {} in 50 digits\n",
                           sample.grid.points(), sample.settled, sample.in_digits));
    print_line(fmt::format("{:<15} {:>9} {:>9} {:>7} {:>6}   {:^29}{}  {:>8} {:>6} {:>6} {:>9}", "",
                           "", "time per", "", "evalu-", "error of the margin", slide[0], "wrong",
                           "unde-", "error", "bound /"));
    print_line(
        fmt::format("{:<15} {:>9} {:>9} {:>7} {:>6}   {:>9} {:>9} {:>9}{}  {:>8} {:>6} {:>6} {:>9}",
                    "method", "tolerance", "point", "steps", "ations", "median", "99 %", "largest",
                    slide[1], "verdicts", "cided", "> bound", "error"));
}

void print_accuracy_row(const AccuracyRow& row, const AccuracySample& sample, bool may_slip)
{
    const std::string name =
        fmt::format("{}{}", name_of(row.numerics.method), row.numerics.resolve ? " resolved" : "");
    const double wrong =
        double(row.wrong_verdicts) / double(std::max<std::int64_t>(1, sample.settled));
    const auto share = [](double value) {
        return std::isnan(value) ? std::string("-") : fmt::format("{:.2g}", value);
    };
    print_line(
        fmt::format("{:<15} {:>9.0e} {:>6.3f} us {:>7.1f} {:>6.0f}   {:>9.1e} {:>9.1e} {:>9.1e}{}  "
                    "{:>8} {:>6} {:>6} {:>9}",
                    name, row.numerics.tolerance, 1e6 * row.seconds_per_point, row.steps,
                    row.evaluations, row.margin[0], row.margin[2], row.margin[4],
                    may_slip ? fmt::format(" {:>9.1e}", row.slide[2]) : "",
                    sample.settled == 0 ? "-" : share(wrong), row.undecided,
                    share(row.bound_exceeded), share(row.bound_over_error)));
}

} // namespace

int accuracy(const AccuracyOptions& options)
{
    const Kernel kernel = widest_kernel();
    const Job job = read_job(options.job.path, options.job.overrides);
    if (job.blocks) {
        throw Error(exit_code::usage,
                    "{} lists its blocks in {}, but accuracy is studied on a "
                    "plane. Give [plane] instead of [blocks].",
                    options.job.path, job.blocks->file);
    }
    const OutputLock output_lock(options.output);
    expect_study_output(options.output, FileKind::accuracy, output_lock);
    print_warnings(warnings_on(job));
    print_line(
        fmt::format("settling verdicts and computing about {} points in 50 digits: about {} s",
                    options.digits, std::ceil(seconds_in_digits(job) * double(options.digits))));
    const AccuracyStudy study(job.problem.scene, job.problem.grid, options.points, options.digits,
                              kernel);
    const bool may_slip = job.problem.grid.may_slip();
    print_head(study.sample(), may_slip);
    std::vector<AccuracyRow> rows;
    for (const Numerics& numerics : accuracy_ladder(job.problem.scene)) {
        rows.push_back(study.measure(numerics));
        rows.back().seconds_per_point =
            seconds_of(study, numerics) / double(study.sample().grid.points());
        print_accuracy_row(rows.back(), study.sample(), may_slip);
    }
    write_accuracy_file(options.output, job, study.sample(), rows);
    print_line(fmt::format("\n{0}: written; draw it with tools/plot_accuracy {0}", options.output));
    return exit_code::complete;
}

} // namespace overturn
