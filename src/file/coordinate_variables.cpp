#include "coordinate_variables.hpp"

#include "layout.hpp"

#include "overturn/mechanics/intensity_measures.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/text/mapped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <type_traits>
#include <utility>

namespace overturn {

namespace {

using netcdf::Dimensions;

/// The measures of a record as coordinates. If it has two horizontal components, they are those of
/// the motion in the direction of a point.
constexpr netcdf::MemberVariable<IntensityMeasures> measures[] = {
    {"record_pga", "peak acceleration of the record, over g", "1", &IntensityMeasures::pga},
    {"pgv", "peak ground velocity of the record", "m s-1", &IntensityMeasures::pgv},
    {"arias_intensity", "Arias intensity of the record", "m s-1",
     &IntensityMeasures::arias_intensity},
    {"significant_duration", "significant duration of the record", "s",
     &IntensityMeasures::significant_duration, "from 5 to 95 % of the Arias intensity"}};

constexpr char rotd50[] = "median of the directions 0, 1, ..., 179 degrees; not scaled";
constexpr char rotd100[] = "largest of the directions 0, 1, ..., 179 degrees; not scaled";

/// Those of two horizontal components.
constexpr netcdf::MemberVariable<RotatedMeasures> rotated[] = {
    {"pga_rotd50", "PGA of the record, RotD50, over g", "1", &RotatedMeasures::pga_rotd50, rotd50},
    {"pga_rotd100", "PGA of the record, RotD100, over g", "1", &RotatedMeasures::pga_rotd100,
     rotd100},
    {"pgv_rotd50", "PGV of the record, RotD50", "m s-1", &RotatedMeasures::pgv_rotd50, rotd50},
    {"pgv_rotd100", "PGV of the record, RotD100", "m s-1", &RotatedMeasures::pgv_rotd100, rotd100}};

/// The function that returns results of another one, which computes those of equal arguments once.
template <class Key, class Function>
auto remembered(const Function& compute)
{
    using Result = std::invoke_result_t<const Function&, const Key&>;
    return [compute, known = std::make_shared<std::map<Key, Result>>()](const Key& key) {
        const auto found = known->find(key);
        return (found != known->end() ? found : known->emplace(key, compute(key)).first)->second;
    };
}

class CoordinateList {
public:
    explicit CoordinateList(const Job& job)
        : job_(job), grid_(job.problem.grid), dimensions_(stored_dimensions(job.problem)),
          derived_(std::make_shared<Coordinates>(job.problem.scene, grid_))
    {}

    std::vector<CoordinateVariable> all()
    {
        for (std::size_t i = 0; i < dimensions_.size(); ++i) {
            add_dimension(i);
        }
        for (const Column& column : grid_.numbers) {
            add_column(column, {});
        }
        if (const Boundaries* boundaries = job_.problem.product.boundaries()) {
            add_scan(grid_.dimensions[boundaries->dimension(grid_)]);
        }
        if (job_.blocks) {
            add_table(job_.blocks->table);
        }
        for (const Quantity& quantity : all_quantities()) {
            add_derived(quantity);
        }
        if (!job_.motions.empty()) {
            add_motions();
        }
        std::stable_partition(all_.begin(), all_.end(), [](const CoordinateVariable& coordinate) {
            return std::holds_alternative<std::vector<double>>(coordinate.variable.values);
        });
        return std::move(all_);
    }

private:
    using Compute = std::function<netcdf::Values()>;

    void add(std::string_view name, const Dimensions& along, std::string_view long_name,
             std::string_view units, Compute values)
    {
        all_.push_back({{std::string(name),
                         along,
                         {},
                         job_.problem.scene.worded(long_name),
                         std::string(units)},
                        std::move(values)});
    }

    /// first, first + 1, ...
    void add_numbers(const StoredDimension& dimension, double first, std::string_view long_name)
    {
        add(dimension.name, {dimension}, long_name, "1", [count = dimension.size, first] {
            std::vector<double> numbers(static_cast<std::size_t>(count));
            std::iota(numbers.begin(), numbers.end(), first);
            return numbers;
        });
    }

    /// Filled up with NUL.
    void add_texts(const std::string& name, Dimensions along, std::vector<std::string> texts,
                   std::string_view long_name)
    {
        std::size_t longest = 1;
        for (const std::string& text : texts) {
            longest = std::max(longest, text.size());
        }
        along.push_back({name + "_length", std::int64_t(longest)});
        add(name, along, long_name, "", [longest, texts = std::move(texts)] {
            std::string letters;
            for (const std::string& text : texts) {
                letters += text + std::string(longest - text.size(), '\0');
            }
            return letters;
        });
        all_.back().variable.values = std::string();
    }

    bool is_known(std::string_view name) const
    {
        return std::ranges::any_of(
            all_, [&](const CoordinateVariable& each) { return each.variable.name == name; });
    }

    void add_column(const Column& column, const Dimensions& along)
    {
        add(column.quantity->name, along, column.quantity->long_name, column.quantity->units,
            [&column] { return column.values.values(); });
    }

    void add_dimension(std::size_t i)
    {
        const StoredDimension& dimension = dimensions_[i];
        if (dimension.name == flip_dimension) {
            add_numbers(dimension, 0, "number of the flip, counted from 0");
        } else if (dimension.name == table_dimension) {
            add_numbers(dimension, 1, "number of the block in the table");
        } else {
            add_column(grid_.dimensions[i].columns.front(), {dimension});
        }
    }

    void add_scan(const Dimension& scanned)
    {
        const Column& column = scanned.columns.front();
        const std::string name = layout::in_run_group("scan_" + scanned.name);
        add(name, {{name, scanned.size()}},
            fmt::format("values of {} computed first", scanned.name), column.quantity->units,
            [&column] { return column.values.values(); });
    }

    void add_table(const Table& table)
    {
        const Dimensions along{{std::string(table_dimension), table.rows()}};
        for (const TableColumn& column : table.columns) {
            if (column.texts.empty()) {
                const Quantity* quantity = find_quantity(column.name);
                add(column.name, along, "column of the table",
                    quantity == nullptr ? "1" : quantity->units,
                    [&column] { return column.numbers; });
            } else {
                add_texts(column.name, along, column.texts, "column of the table");
            }
        }
    }

    /// A boundary has flips instead of what is scanned, and nothing that follows from this.
    void add_derived(const Quantity& quantity)
    {
        const std::string_view name = quantity.name;
        if (!quantity.scope.is_stored || is_known(name) || grid_.find(name) != nullptr ||
            !derived_->has(name)) {
            return;
        }
        Dimensions along;
        for (const std::size_t i : derived_->dimensions_of(name)) {
            along.push_back(dimensions_[i]);
            if (along.back().name == flip_dimension) {
                return;
            }
        }
        add(name, along, quantity.long_name, quantity.units,
            [derived = derived_, name] { return derived->of(name).values; });
    }

    /// Names and measures along the dimension of the motion: `motion`, `block` if the table names
    /// the motion of each block, or none.
    void add_motions()
    {
        const std::optional<std::size_t> place = grid_.dimension_of("motion");
        const Dimensions along = place ? Dimensions{dimensions_[*place]} : Dimensions();
        const std::vector<const RecordedMotion*> motions =
            mapped(grid_.find("motion")->values.values(),
                   [&](double number) { return &job_.motions[Scene::record_index(number)]; });
        add_texts("motion_name", along, mapped(motions, [](auto* motion) { return motion->name; }),
                  "file of the recorded ground motion");
        if (job_.problem.scene.has_two_components()) {
            add_measures_of_two_components(along, motions);
        } else {
            for (const auto& measure : measures) {
                add(measure.name, along, measure.long_name, measure.units, [motions, &measure] {
                    return mapped(motions,
                                  [&](auto* each) { return each->measures.*measure.value; });
                });
                all_.back().variable.comment = measure.comment;
            }
        }
        const bool all_know_the_ground = std::ranges::all_of(
            motions, [](const RecordedMotion* motion) { return motion->ground_pga.has_value(); });
        if (job_.problem.scene.motion_of == MotionOf::floor && all_know_the_ground &&
            !is_known("ground_pga")) {
            add("ground_pga", along, "", "1", [motions] {
                return mapped(motions, [](auto* each) { return *each->ground_pga; });
            });
            all_.back().variable.long_name = "peak acceleration of the ground, over g";
            all_.back().variable.comment = fmt::format(
                "not scaled; of the motion that caused that of the floor{}",
                job_.problem.scene.has_two_components() ? "; of the first horizontal component"
                                                        : "");
        }
    }

    /// along: the dimension of the motion
    void add_measures_of_two_components(const Dimensions& along,
                                        const std::vector<const RecordedMotion*>& motions)
    {
        const double gravity = job_.problem.scene.gravity;
        const auto in_direction =
            remembered<std::pair<double, double>>([&job = job_, gravity](const auto& directed) {
                const auto& [number, direction] = directed;
                const Accelerogram& record = *job.motions[Scene::record_index(number)].record;
                return intensity_measures(record.in_direction(direction).horizontal(),
                                          record.time_step(), gravity);
            });
        const std::vector<std::size_t> places = derived_->dimensions_of("record_pga");
        const Dimensions directed = mapped(places, [&](std::size_t i) { return dimensions_[i]; });
        for (const auto& measure : measures) {
            add(measure.name, directed, measure.long_name, measure.units,
                [derived = derived_, places, in_direction, &measure] {
                    std::vector<double> values = derived->along(places, "motion");
                    const std::vector<double> directions = derived->along(places, "direction");
                    std::ranges::transform(
                        values, directions, values.begin(), [&](double number, double direction) {
                            return in_direction({number, direction}).*measure.value;
                        });
                    return values;
                });
            all_.back().variable.comment =
                fmt::format("{}{}in the direction of the point", measure.comment,
                            std::string_view(measure.comment).empty() ? "" : "; ");
        }
        const auto in_all_directions =
            remembered<const RecordedMotion*>([gravity](const RecordedMotion* motion) {
                return rotated_measures(*motion->record, gravity);
            });
        for (const auto& measure : rotated) {
            add(measure.name, along, measure.long_name, measure.units,
                [motions, in_all_directions, &measure] {
                    return mapped(motions, [&](auto* each) {
                        return in_all_directions(each).*measure.value;
                    });
                });
            all_.back().variable.comment = measure.comment;
        }
    }

    const Job& job_;
    const Grid& grid_;
    Dimensions dimensions_;
    std::shared_ptr<Coordinates> derived_;
    std::vector<CoordinateVariable> all_;
};

} // namespace

std::vector<CoordinateVariable> coordinate_variables_of(const Job& job)
{
    return CoordinateList(job).all();
}

} // namespace overturn
