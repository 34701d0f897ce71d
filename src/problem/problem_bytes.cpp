#include "overturn/problem/problem_bytes.hpp"

#include <cstring>
#include <memory>
#include <type_traits>

namespace overturn {

namespace {

/// Appends values to bytes. transfer() below names the members of each type once, for Writer and
/// Reader.
class Writer {
public:
    template <class Value>
        requires std::is_trivially_copyable_v<Value>
    void operator()(Value& value)
    {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }

    std::string bytes;
};

class Reader {
public:
    explicit Reader(std::string_view bytes) : left_(bytes) {}

    template <class Value>
        requires std::is_trivially_copyable_v<Value>
    void operator()(Value& value)
    {
        std::memcpy(&value, left_.data(), sizeof value);
        left_.remove_prefix(sizeof value);
    }

private:
    std::string_view left_;
};

template <class Archive, class List, class Transfer>
void transfer_list(Archive& archive, List& list, const Transfer& transfer_element)
{
    std::size_t size = list.size();
    archive(size);
    list.resize(size);
    for (auto& element : list) {
        transfer_element(element);
    }
}

template <class Archive, class List>
void transfer_values(Archive& archive, List& list)
{
    transfer_list(archive, list, [&](auto& value) { archive(value); });
}

template <class Archive>
void transfer(Archive& archive, Axis& axis)
{
    auto definition = axis.definition();
    bool is_range = axis.is_range();
    archive(is_range);
    if (is_range) {
        AxisRange range = axis.is_range() ? std::get<AxisRange>(definition) : AxisRange();
        archive(range);
        axis = Axis(range);
    } else {
        AxisList list = axis.is_range() ? AxisList() : std::get<AxisList>(definition);
        transfer_values(archive, list);
        axis = Axis(std::move(list));
    }
}

template <class Archive>
void transfer(Archive& archive, Column& column)
{
    std::ptrdiff_t number = column.quantity - all_quantities().data();
    archive(number);
    column.quantity = all_quantities().data() + number;
    transfer(archive, column.values);
}

template <class Archive>
void transfer(Archive& archive, Grid& grid)
{
    const auto transfer_column = [&](Column& column) { transfer(archive, column); };
    transfer_list(archive, grid.numbers, transfer_column);
    transfer_list(archive, grid.dimensions, [&](Dimension& dimension) {
        transfer_values(archive, dimension.name);
        transfer_list(archive, dimension.columns, transfer_column);
    });
}

template <class Archive>
void transfer(Archive& archive, std::shared_ptr<const Accelerogram>& record)
{
    std::vector<double> horizontal = record ? record->horizontal() : std::vector<double>();
    std::vector<double> upwards = record ? record->upwards() : std::vector<double>();
    double time_step = record ? record->time_step() : 0;
    transfer_values(archive, horizontal);
    transfer_values(archive, upwards);
    archive(time_step);
    if (!record) {
        record = std::make_shared<const Accelerogram>(std::move(horizontal), std::move(upwards),
                                                      time_step);
    }
}

template <class Archive>
void transfer(Archive& archive, Problem& problem)
{
    Scene& scene = problem.scene;
    archive(scene.pulse);
    archive(scene.theory);
    archive(scene.shape);
    archive(scene.gravity);
    transfer_list(archive, scene.records, [&](auto& record) { transfer(archive, record); });
    transfer(archive, problem.grid);
    archive(problem.numerics);
    archive(problem.product);
    transfer_values(archive, problem.fields);
}

} // namespace

std::string bytes_of(const Problem& problem)
{
    Writer writer;
    Problem copy = problem;
    transfer(writer, copy);
    return std::move(writer.bytes);
}

Problem problem_of(std::string_view bytes)
{
    Reader reader(bytes);
    Problem problem;
    transfer(reader, problem);
    return problem;
}

} // namespace overturn
