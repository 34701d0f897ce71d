#include "coordinates.hpp"

#include "layout.hpp"

#include "overturn/problem/coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>

namespace overturn {

namespace {

/// 1 to count.
std::vector<double> numbers_to(std::int64_t count)
{
    std::vector<double> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 1.0);
    return numbers;
}

class CoordinateList {
public:
    explicit CoordinateList(const Job& job)
        : job_(job), problem_(job.problem),
          derived_(std::make_shared<Coordinates>(problem_.scene, problem_.grid)),
          strength_(problem_.product == Product::boundary
                        ? problem_.grid.dimension_of(Role::strength)
                        : std::nullopt)
    {}

    std::vector<Coordinate> all()
    {
        for (std::size_t i = 0; i < problem_.grid.dimensions.size(); ++i) {
            add_dimension(i);
        }
        for (const Column& column : problem_.grid.numbers) {
            add_given(column, {});
        }
        if (strength_) {
            const Column& column = problem_.grid.dimensions[*strength_].columns.front();
            const std::string name =
                layout::in_run_group(layout::scan_prefix + std::string(column.quantity->name));
            add({name,
                 {name},
                 {},
                 {},
                 fmt::format("values of {} computed first", column.quantity->name),
                 "1"},
                column.values.size(), [&column] { return column.values.values(); });
        }
        if (job_.blocks) {
            add_table(job_.blocks->table);
        }
        for (const std::string_view name : derived_coordinates) {
            add_derived(name);
        }
        if (problem_.scene.is_recorded()) {
            add_measures();
        }
        return std::move(all_);
    }

private:
    using Values = std::function<std::vector<double>()>;

    /// length: of its only dimension, if the shape is empty.
    void add(netcdf::Variable variable, std::int64_t length, Values values)
    {
        if (!variable.dimensions.empty() && variable.shape.empty()) {
            variable.shape = {hsize_t(length)};
        }
        all_.push_back({std::move(variable), std::move(values)});
    }

    void add_given(const Column& column, const std::vector<std::string>& dimensions)
    {
        const Quantity& quantity = *column.quantity;
        add({std::string(quantity.name),
             dimensions,
             {},
             {},
             std::string(quantity.long_name),
             std::string(quantity.units)},
            column.values.size(), [&column] { return column.values.values(); });
    }

    void add_dimension(std::size_t i)
    {
        const Dimension& dimension = problem_.grid.dimensions[i];
        if (i == strength_) {
            const std::string name(flip_dimension);
            const std::int64_t count = most_flips(problem_.scene);
            add({name, {name}, {}, {}, "number of the flip, counted from 0", "1"}, count, [count] {
                std::vector<double> numbers = numbers_to(count);
                std::ranges::for_each(numbers, [](double& number) { --number; });
                return numbers;
            });
        } else if (dimension.name == table_dimension) {
            add({dimension.name, {dimension.name}, {}, {}, "number of the block in the table", "1"},
                dimension.size(), [&dimension] { return numbers_to(dimension.size()); });
        } else {
            add_given(dimension.columns.front(), {dimension.name});
        }
    }

    void add_table(const Table& table)
    {
        for (const TableColumn& column : table.columns) {
            if (column.texts.empty()) {
                const Quantity* quantity = find_quantity(column.name);
                add({column.name,
                     {std::string(table_dimension)},
                     {},
                     {},
                     "column of the table",
                     quantity == nullptr ? "1" : std::string(quantity->units)},
                    table.rows(), [&column] { return column.numbers; });
            }
        }
    }

    bool has(std::string_view name) const
    {
        return std::ranges::any_of(
            all_, [&](const Coordinate& each) { return each.variable.name == name; });
    }

    /// A boundary has flips instead of strengths, and nothing that follows from these.
    void add_derived(std::string_view name)
    {
        if (problem_.grid.find(name) != nullptr || has(name) || !derived_->has(name)) {
            return;
        }
        const std::vector<std::size_t> along = derived_->dimensions_of(name);
        if (strength_ && std::ranges::count(along, *strength_) > 0) {
            return;
        }
        const Quantity& quantity = overturn::quantity(name);
        netcdf::Variable variable{
            std::string(name),          {}, {}, {}, std::string(quantity.long_name),
            std::string(quantity.units)};
        for (const std::size_t i : along) {
            variable.dimensions.push_back(problem_.grid.dimensions[i].name);
            variable.shape.push_back(hsize_t(problem_.grid.dimensions[i].size()));
        }
        add(std::move(variable), 0,
            [derived = derived_, name] { return derived->of(name).values; });
    }

    /// Along the motions of the grid, or of the table.
    void add_measures()
    {
        const auto count = std::int64_t(job_.motions.size());
        const bool is_single =
            problem_.grid.find("motion") != nullptr && !problem_.grid.dimension_of("motion");
        const std::vector<std::string> along =
            is_single ? std::vector<std::string>{} : std::vector<std::string>{"motion"};
        if (!has("motion")) {
            const Quantity& motion = quantity("motion");
            add({"motion", along, {}, {}, std::string(motion.long_name), "1"}, count,
                [count] { return numbers_to(count); });
        }
        const auto add_measure = [&](const char* name, const char* long_name, const char* units,
                                     double IntensityMeasures::*measure, const char* comment = "") {
            add({name, along, {}, {}, long_name, units, comment}, count,
                [this_job = &job_, measure] {
                    std::vector<double> values;
                    for (const Motion& motion : this_job->motions) {
                        values.push_back(motion.measures.*measure);
                    }
                    return values;
                });
        };
        add_measure("record_pga", "peak acceleration of the record, over g", "1",
                    &IntensityMeasures::pga);
        add_measure("pgv", "peak ground velocity of the record", "m s-1", &IntensityMeasures::pgv);
        add_measure("arias_intensity", "Arias intensity of the record", "m s-1",
                    &IntensityMeasures::arias_intensity);
        add_measure("significant_duration", "significant duration of the record", "s",
                    &IntensityMeasures::significant_duration,
                    "from 5 to 95 % of the Arias intensity");
    }

    const Job& job_;
    const Problem& problem_;
    std::shared_ptr<Coordinates> derived_;
    std::optional<std::size_t> strength_; ///< the dimension replaced by the flips of a boundary
    std::vector<Coordinate> all_;
};

} // namespace

std::vector<Coordinate> coordinates_of(const Job& job)
{
    return CoordinateList(job).all();
}

std::vector<TextCoordinate> text_coordinates_of(const Job& job)
{
    std::vector<TextCoordinate> all;
    if (!job.motions.empty()) {
        const bool is_single =
            job.problem.grid.find("motion") != nullptr && !job.problem.grid.dimension_of("motion");
        all.push_back(
            {"motion_name", is_single ? "" : "motion", {}, "file of the recorded ground motion"});
        for (const Motion& motion : job.motions) {
            all.back().values.push_back(motion.name);
        }
    }
    if (job.blocks) {
        for (const TableColumn& column : job.blocks->table.columns) {
            if (!column.texts.empty()) {
                all.push_back({column.name, std::string(table_dimension), column.texts,
                               "column of the table"});
            }
        }
    }
    return all;
}

} // namespace overturn
