// Which objects of a list topple, and at which strengths.
#include "commands.hpp"
#include "report/assessment.hpp"
#include "report/print.hpp"
#include "report/progress.hpp"

#include "overturn/answers/job_lines.hpp"
#include "overturn/file/provenance.hpp"
#include "overturn/file/text_outputs.hpp"
#include "overturn/sweep/in_threads.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/quoting.hpp"

namespace overturn {

int assess(const AssessOptions& options)
{
    widest_kernel(); // throws if this processor supports none
    Job job = job_of(options);
    if (!options.json) {
        print_warnings(warnings_on(job));
    }
    if (!options.csv.empty()) {
        expect_place_for_answers(options.csv);
    }
    Assessment assessment = [&] {
        Progress progress("cases");
        return assessment_of(std::move(job), options, threads_of_processor(),
                             [&](std::size_t done, std::size_t all) {
                                 progress.update(std::int64_t(done), std::int64_t(all));
                             });
    }();
    assessment.widths = least_widths_of(assessment, threads_of_processor());
    if (!options.csv.empty()) {
        write_answers(options.csv, csv_of(assessment));
    }
    if (options.json) {
        fmt::print("{}", json_of(assessment, options, program_version()));
        return exit_code::complete;
    }
    print_assessment(assessment, options);
    if (!options.csv.empty()) {
        fmt::print("\n{}: written\n", printable(options.csv));
    }
    return exit_code::complete;
}

} // namespace overturn
