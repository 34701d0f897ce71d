// native_answers [FILE...] < QUESTIONS: reads the files, then a question of the page per line, and
// prints the answer, or {"refused": message, "code": code}, per line. An answer to topple with a
// strength has `numbers` too: for each direction the margin, the bound of its error, and by how
// much the peak differs at a hundred times the tolerance.
#include "web/files_in_memory.hpp"
#include "web/questions.hpp"

#include "overturn/answers/json.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/error.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace overturn {
namespace {

double peak_at(Problem problem, double tolerance)
{
    problem.numerics = {.method = Method::taylor, .tolerance = tolerance, .resolve = false};
    problem.fields = {Field::peak};
    const TileFields fields = compute_tile(problem, tiling_of(problem)[0], widest_kernel());
    return std::get<std::vector<double>>(fields.values[0]).front();
}

Json numbers_of(const std::string& question)
{
    Json numbers = Json::array();
    for (const Job& job : jobs_of(topple_request_of(question))) {
        const auto value = [&](Field field) {
            const double number = accurate_values(job.problem, field).front();
            return std::isinf(number) ? Json("infinite") : if_finite(number);
        };
        Json& of_direction = numbers.emplace_back();
        of_direction["direction"] = directions_of(job.problem).front();
        of_direction["margin"] = value(Field::margin);
        of_direction["error"] = value(Field::error);
        // Under a record, steps that end at samples are the same at both tolerances.
        Problem disturbed = job.problem;
        disturbed.scene.gravity *= 1 + 1e-13;
        const double peak = peak_at(job.problem, most_accurate.tolerance);
        const auto change_to = [&](double other) {
            return std::isfinite(peak) && std::isfinite(other) ? std::abs(peak - other) : HUGE_VAL;
        };
        of_direction["peak_change"] =
            if_finite(std::max(change_to(peak_at(job.problem, 100 * most_accurate.tolerance)),
                               change_to(peak_at(disturbed, most_accurate.tolerance))));
    }
    return numbers;
}

Json answer(const std::string& line)
{
    try {
        Json json = Json::parse(answer_to(line));
        const Json question = Json::parse(line);
        if (question["question"] == "topple" && json.contains("peak_of_alpha") &&
            !json["pga"].is_null()) {
            json["numbers"] = numbers_of(line);
        }
        return json;
    } catch (const Error& error) {
        return {{"refused", error.what()}, {"code", error.code()}};
    }
}

int run(const std::vector<std::string>& files)
{
    for (const std::string& file : files) {
        std::ifstream stream(file, std::ios::binary);
        add_file(std::filesystem::path(file).filename().string(),
                 {std::istreambuf_iterator<char>(stream), {}});
    }
    for (std::string line; std::getline(std::cin, line);) {
        std::cout << answer(line).dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
    }
    return 0;
}

} // namespace
} // namespace overturn

int main(int count, char** arguments)
{
    return overturn::run({arguments + 1, arguments + count});
}
