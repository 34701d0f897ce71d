#include "questions.hpp"

#include "files_in_memory.hpp"

#include "overturn/answers/assess.hpp"
#include "overturn/answers/history.hpp"
#include "overturn/answers/job_lines.hpp"
#include "overturn/answers/json.hpp"
#include "overturn/answers/topple.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/record/read_record.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace overturn {

namespace {

/// The members of a question. Each that is taken is known; others are refused.
class Members {
public:
    explicit Members(const Json& question) : question_(question) {}

    /// The member, or nullptr; null is the same as a member that is missing.
    const Json* find(const std::string& name)
    {
        known_.insert(name);
        const auto found = question_.find(name);
        return found == question_.end() || found->is_null() ? nullptr : &*found;
    }

    void take(const std::string& name, double& value)
    {
        if (const Json* const member = find(name)) {
            value = number(name, *member);
        }
    }
    void take(const std::string& name, std::optional<double>& value)
    {
        if (const Json* const member = find(name)) {
            value = number(name, *member);
        }
    }
    void take(const std::string& name, std::string& value)
    {
        if (const Json* const member = find(name)) {
            value = member->is_number_integer() ? member->dump() : text(name, *member);
        }
    }
    void take(const std::string& name, std::vector<double>& values)
    {
        if (const Json* const member = find(name)) {
            values = numbers(name, *member);
        }
    }
    void take(const std::string& name, std::vector<std::string>& values)
    {
        if (const Json* const member = find(name)) {
            values = mapped(listed(*member), [&](const Json& each) { return text(name, each); });
        }
    }
    void take(const std::string& name, bool& value)
    {
        if (const Json* const member = find(name)) {
            if (!member->is_boolean()) {
                refuse(name, *member, "true or false");
            }
            value = member->get<bool>();
        }
    }

    static double number(const std::string& name, const Json& member)
    {
        if (!member.is_number()) {
            refuse(name, member, "a number");
        }
        return member.get<double>();
    }
    static std::string text(const std::string& name, const Json& member)
    {
        if (!member.is_string()) {
            refuse(name, member, "a text");
        }
        return member.get<std::string>();
    }
    static std::vector<double> numbers(const std::string& name, const Json& member)
    {
        return mapped(listed(member), [&](const Json& each) { return number(name, each); });
    }

    void expect_all_known() const
    {
        for (const auto& [name, value] : question_.items()) {
            if (!known_.contains(name)) {
                throw Error(exit_code::usage, "{} is not a member of such a question.",
                            in_quotes(name));
            }
        }
    }

private:
    static std::vector<Json> listed(const Json& member)
    {
        return member.is_array() ? member.get<std::vector<Json>>() : std::vector{member};
    }

    [[noreturn]] static void refuse(const std::string& name, const Json& member, const char* wanted)
    {
        throw Error(exit_code::usage, "{} = {} is not {}.", name,
                    shortened(member.dump(-1, ' ', false, Json::error_handler_t::replace), 40),
                    wanted);
    }

    const Json& question_;
    std::set<std::string, std::less<>> known_{"question"};
};

Json parsed(std::string_view text)
{
    Json question = Json::parse(text, nullptr, false);
    if (!question.is_object()) {
        throw Error(exit_code::usage, "the question is not a JSON object.");
    }
    return question;
}

void expect_positive(const std::string& name, const std::optional<double>& value,
                     double largest = std::numeric_limits<double>::infinity())
{
    if (value && !(*value > 0 && *value <= largest)) {
        throw Error(exit_code::usage, "{} = {} is not allowed. Give a number above 0{}.", name,
                    *value, std::isinf(largest) ? "" : fmt::format(", at most {}", largest));
    }
}

/// The motion, without its peak acceleration.
void take_motion(Members& members, MotionRequest& request)
{
    members.take("pulse", request.pulse);
    members.take("component", request.component);
    members.take("scale", request.scale);
    members.take("pga_max", request.pga_max);
    if (const Json* const scene = members.find("scene"); scene != nullptr && scene->is_object()) {
        for (const auto& [key, value] : scene->items()) {
            request.overrides.push_back(fmt::format("scene.{}={}", key, value.dump()));
        }
    }
    expect_positive("scale", request.scale);
    expect_positive("pga_max", request.pga_max, largest_pga);
}

ToppleRequest topple_request(Members& members)
{
    ToppleRequest request;
    take_motion(members, request);
    members.take("record", request.record);
    members.take("period", request.period);
    members.take("direction", request.direction);
    members.take("restitution", request.restitution);
    members.take("velocity_restitution", request.velocity_restitution);
    members.take("restitution_of_maximum", request.restitution_of_maximum);
    expect_positive("period", request.period);
    for (const Quantity& each : all_quantities()) {
        if (each.role != Role::block) {
            continue;
        }
        std::optional<double> value;
        members.take(std::string(each.name), value);
        if (value && !each.allows(*value)) {
            throw Error(exit_code::usage, "{}{}", each.name, each.refusal_of(*value));
        }
        if (value) {
            request.block.emplace(each.name, *value);
        }
    }
    return request;
}

/// With the strength, and what is searched.
ToppleRequest whole_topple_request(Members& members)
{
    ToppleRequest request = topple_request(members);
    members.take("pga", request.pga);
    expect_positive("pga", request.pga, largest_pga);
    bool search = true;
    members.take("search", search);
    request.without_search = !search;
    members.take("other_restitutions", request.other_restitutions);
    if (const Json* const vary = members.find("vary")) {
        const bool is_range = vary->is_array() && vary->size() == 3;
        const Quantity* const varied =
            is_range ? find_quantity(Members::text("vary", (*vary)[0])) : nullptr;
        if (varied == nullptr) {
            throw Error(exit_code::usage, "vary is not the name of a quantity, its first and its "
                                          "last value.");
        }
        request.vary = {varied, Members::number("vary", (*vary)[1]),
                        Members::number("vary", (*vary)[2])};
    }
    members.expect_all_known();
    return request;
}

std::string topple_answer(Members& members)
{
    const ToppleRequest request = whole_topple_request(members);
    std::vector<Job> jobs = jobs_of(request);
    if (request.vary) {
        return json_of(ranges_for(jobs, request), request);
    }
    return json_of(answers_for(std::move(jobs), request, 1, nullptr), request);
}

std::string assess_answer(Members& members)
{
    AssessRequest request;
    request.objects = "objects";
    std::string table;
    take_motion(members, request);
    members.take("pga", request.pga);
    members.take("table", table);
    members.take("records", request.records);
    members.take("periods", request.periods);
    members.take("directions", request.directions);
    members.take("fine", request.fine);
    members.expect_all_known();
    expect_positive("pga", request.pga, largest_pga);
    for (const double period : request.periods) {
        expect_positive("periods", period);
    }
    add_file(request.objects, table);
    return json_of(assessment_of(job_of(request), request, 1, nullptr), request, OVERTURN_VERSION);
}

std::string history_answer(Members& members)
{
    ToppleRequest request = topple_request(members);
    members.take("pga", request.pga);
    expect_positive("pga", request.pga, largest_pga);
    request.without_search = true;
    double samples = 600;
    members.take("samples", samples);
    members.expect_all_known();
    const DirectedAnswer worst =
        std::move(answers_for(jobs_of(request), request, 1, nullptr).front());
    HistoryView view{.samples = int(std::clamp(samples, 2.0, 100'000.0))};
    const History history = history_of_only_point(worst.job, view);
    const double p = extent_of(worst.job, "frequency_parameter")->first;
    const auto seconds = [p](double time) { return if_finite(time / p); };
    Json answer;
    answer["direction"] = worst.answer.direction;
    answer["verdict"] = worst.answer.verdict ? Json(name_of(*worst.answer.verdict)) : Json();
    answer["end_of_motion"] = seconds(history.end_of_pulse);
    answer["time_of_fall"] = seconds(history.time_of_fall);
    answer["time_of_rest"] = seconds(history.time_of_rest);
    answer["is_curve_certain"] = history.is_curve_certain;
    answer["is_shortened"] = history.shortened;
    const Block<double> block = only_point_of(worst.job.problem).block;
    answer["slenderness_plus"] = block.slenderness;
    answer["slenderness_minus"] = block.turned().slenderness;
    const auto column = [&](double HistorySample::*member, double unit) {
        return mapped(history.samples, [&](const HistorySample& sample) {
            return if_finite(sample.*member * unit);
        });
    };
    answer["time"] = column(&HistorySample::time, 1 / p);
    answer["angle"] = column(&HistorySample::angle, 1);
    answer["slide"] = history.slips
                          ? Json(column(&HistorySample::slide, *size_of_only_block(worst.job)))
                          : Json();
    answer["ground"] = column(&HistorySample::ground, 1);
    return text_of(answer);
}

/// The letter of a point: not lifted and not sliding, safe, topples, or undecided.
char letter_of(Region region, bool is_certain, bool moves)
{
    return !is_certain || !is_decided(region) ? 'u' : is_unsafe(region) ? 't' : moves ? 's' : 'r';
}

/// The verdicts of the points of a job: one row per strength.
std::string letters_of(const Job& job, const std::string& x)
{
    const Problem& problem = job.problem;
    const Tile all{.number = 0,
                   .begin = Shape(problem.grid.dimensions.size()),
                   .count = stored_shape(problem)};
    const TileFields fields = compute_tile(problem, all, widest_kernel());
    const auto& regions = std::get<std::vector<std::uint8_t>>(fields.values[0]);
    const auto is_certain = [&](std::size_t point) {
        const auto value = [&](std::size_t field) {
            return std::get<std::vector<double>>(fields.values[field])[point];
        };
        return problem.numerics.resolve || value(2) < std::abs(value(1));
    };
    const std::vector<Point> points = Coordinates(problem.scene, problem.grid).points();
    const std::size_t of_pga = *problem.grid.dimension_of("pga");
    const std::size_t of_x = *problem.grid.dimension_of(x);
    const auto columns = std::size_t(all.count[of_x]);
    const auto rows = std::size_t(all.count[of_pga]);
    std::string letters(points.size(), 'u');
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool moves = std::abs(points[i].amplitude) * pga_of_unit(problem.scene, points[i]) >
                           moving_pga(problem.scene, points[i]);
        const std::size_t row = of_pga < of_x ? i / columns : i % rows;
        const std::size_t column = of_pga < of_x ? i % columns : i / rows;
        letters[row * columns + column] =
            letter_of(Region(regions[i]), !moves || is_certain(i), moves);
    }
    return letters;
}

std::string spectrum_answer(Members& members)
{
    ToppleRequest request = topple_request(members);
    std::vector<double> strengths;
    members.take("pga", strengths);
    const Json* const x = members.find("x");
    members.expect_all_known();
    if (strengths.empty() || x == nullptr || !x->is_object() || !x->contains("quantity") ||
        !x->contains("values")) {
        throw Error(exit_code::usage, "a spectrum needs pga, a list, and x with its quantity and "
                                      "values.");
    }
    const std::string name = Members::text("quantity", (*x)["quantity"]);
    const std::vector<double> values = Members::numbers("values", (*x)["values"]);
    request.pga = strengths.front();
    if (name == "pulse_period") {
        request.period = values.front();
    }
    const bool is_resolved = request.record.empty(); // more digits take up to a minute under one
    const std::vector<Job> jobs = jobs_of(
        request, {fmt::format("plane.pga.values=[{}]", fmt::join(strengths, ",")),
                  fmt::format("plane.{}.values=[{}]", name, fmt::join(values, ",")),
                  "numerics.method=\"taylor\"", fmt::format("numerics.resolve={}", is_resolved),
                  is_resolved ? "output.fields=[\"region\"]"
                              : "output.fields=[\"region\",\"margin\",\"error\"]"});
    // The worst verdict of all directions.
    constexpr std::string_view order = "rsut";
    std::string worst;
    for (const Job& job : jobs) {
        const std::string letters = letters_of(job, name);
        worst.resize(letters.size(), order.front());
        for (std::size_t i = 0; i < letters.size(); ++i) {
            worst[i] = order[std::max(order.find(worst[i]), order.find(letters[i]))];
        }
    }
    Json answer;
    answer["verdicts"] = worst;
    return text_of(answer);
}

std::string record_answer(Members& members)
{
    std::string name;
    RecordOptions options;
    members.take("record", name);
    members.expect_all_known();
    const RecordFile record = read_record(name, options);
    Json answer;
    answer["format"] = record.format;
    Json& components = answer["components"] = Json::array();
    for (const RecordComponent& component : record.components) {
        const std::vector<double> acceleration = over_gravity(component, Scene().gravity);
        Json& each = components.emplace_back();
        each["name"] = component.name;
        each["place"] = component.place;
        each["pga"] = std::abs(*std::ranges::max_element(
            acceleration, {}, [](double value) { return std::abs(value); }));
        each["samples"] = acceleration.size();
        each["time_step"] = component.time_step;
        each["duration"] = double(acceleration.size() - 1) * component.time_step;
        each["remarks"] = component.remarks;
    }
    return text_of(answer);
}

} // namespace

ToppleRequest topple_request_of(std::string_view question)
{
    const Json json = parsed(question);
    Members members(json);
    return whole_topple_request(members);
}

std::string answer_to(std::string_view text)
{
    const Json question = parsed(text);
    Members members(question);
    std::string kind;
    members.take("question", kind);
    const std::pair<std::string_view, std::string (*)(Members&)> kinds[] = {
        {"topple", topple_answer},
        {"assess", assess_answer},
        {"history", history_answer},
        {"spectrum", spectrum_answer},
        {"record", record_answer}};
    for (const auto& [name, answer] : kinds) {
        if (kind == name) {
            return answer(members);
        }
    }
    throw Error(exit_code::usage, "there is no question {}.", in_quotes(shortened(kind, 40)));
}

} // namespace overturn
