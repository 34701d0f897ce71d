#include "result_remarks.hpp"

#include "overturn/text/error.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/quoting.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ranges>

namespace overturn {

namespace {

bool is_boundary(const StoredResult& stored)
{
    return stored.origin().kind == FileKind::boundary;
}

/// scanned: the plural of what a line consists of.
std::string text_of(const BoundaryLines& lines, std::string_view scanned)
{
    std::vector<std::string> parts;
    const auto add = [&](std::int64_t count, const std::string& what) {
        if (count > 0) {
            parts.push_back(fmt::format("{}: {} of {} lines", what, count, lines.computed));
        }
    };
    add(lines.unsafe_at_first,
        fmt::format("overturning at the first {} of the job", noun_of(1, scanned)));
    add(lines.undecided, fmt::format("with undecided {} or more flips than are stored", scanned));
    if (lines.has_shares && lines.computed > 0) {
        parts.push_back(
            fmt::format("overturning in {:.3g} % of the scanned interval, undecided in {:.3g} %",
                        100 * lines.unsafe_share, 100 * lines.undecided_share));
        parts.emplace_back("strips narrower than the steps of the scan are missed");
    }
    return fmt::format("{}", fmt::join(parts, "; "));
}

std::string text_of(const AuditCount& audit)
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
                       audit.checked, noun_of(audit.checked, "points"), audit.wrong, bound);
}

} // namespace

std::vector<std::string> remarks_on(const StoredResult& stored)
{
    std::vector<std::string> remarks;
    if (is_boundary(stored)) {
        const bool is_strength = is_one_of(Field::flip_amplitude, stored.tiles().fields);
        remarks.push_back(text_of(stored.count_lines(), is_strength ? "amplitudes" : "values"));
    }
    if (stored.tiles().audit) {
        remarks.push_back(text_of(*stored.tiles().audit));
    }
    std::erase(remarks, "");
    return remarks;
}

std::string command_to_complete(const StoredResult& stored)
{
    const auto& part = stored.tiles().part;
    return fmt::format("overturn {} JOB.toml{} -o {}, with the job file and the --set arguments of "
                       "the first run",
                       is_boundary(stored) ? "boundary" : "run",
                       part ? fmt::format(" --part {}/{}", part->number, part->count) : "",
                       stored.path());
}

void expect_undamaged(const StoredResult& stored, const BetweenTiles& between_tiles)
{
    const std::string& path = stored.path();
    if (const auto damaged = stored.damaged_coordinates(); !damaged.empty()) {
        throw Error(exit_code::output,
                    "\"{}\" is damaged: the values of its coordinates have changed: {}. "
                    "Remove the file and recompute it.",
                    path, fmt::join(damaged, ", "));
    }
    if (const auto damaged = stored.damaged_tiles(between_tiles); !damaged.empty()) {
        constexpr std::ptrdiff_t most = 20; // so that the message stays short
        throw Error(exit_code::output,
                    "\"{}\" is damaged: the checksums of {} of {} finished tiles do not match "
                    "(tile numbers: {}{}). Recompute them with {}.",
                    path, damaged.size(), stored.tiles().tiles_done,
                    fmt::join(damaged | std::views::take(most), ", "),
                    std::ssize(damaged) > most ? ", ..." : "", command_to_complete(stored));
    }
}

} // namespace overturn
