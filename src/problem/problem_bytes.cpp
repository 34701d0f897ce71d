#include "overturn/problem/problem_bytes.hpp"

#include <cstring>
#include <memory>
#include <type_traits>

namespace overturn {

namespace {

/// Appends values to bytes, or takes values from bytes; the members of each type are named once.
class Archive {
public:
    Archive() = default;
    explicit Archive(std::string_view bytes) : bytes_(bytes), is_input_(true) {}

    const std::string& bytes() const { return bytes_; }

    template <class Value>
        requires std::is_trivially_copyable_v<Value>
    void transfer(Value& value)
    {
        if (is_input_) {
            std::memcpy(&value, bytes_.data() + next_, sizeof value);
            next_ += sizeof value;
        } else {
            bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
    }

    template <class List>
        requires requires(List list) { list.resize(1); }
    void transfer(List& list)
    {
        std::size_t size = list.size();
        transfer(size);
        list.resize(size);
        for (auto& element : list) {
            transfer(element);
        }
    }

    void transfer(Axis& axis)
    {
        const auto* given_range = std::get_if<AxisRange>(&axis.definition());
        const auto* given_list = std::get_if<AxisList>(&axis.definition());
        bool is_range = given_range != nullptr;
        AxisRange range = is_range ? *given_range : AxisRange();
        AxisList list = is_range ? AxisList() : *given_list;
        transfer_all(is_range, range, list);
        axis = is_range ? Axis(range) : Axis(std::move(list));
    }

    void transfer(Column& column)
    {
        std::ptrdiff_t number = column.quantity - all_quantities().data();
        transfer_all(number, column.values);
        column.quantity = all_quantities().data() + number;
    }

    void transfer(Dimension& dimension) { transfer_all(dimension.name, dimension.columns); }

    void transfer(std::shared_ptr<const Accelerogram>& record)
    {
        std::vector<double> horizontal = record ? record->horizontal() : std::vector<double>();
        std::vector<double> upwards = record ? record->upwards() : std::vector<double>();
        std::vector<double> second = record ? record->second() : std::vector<double>();
        double time_step = record ? record->time_step() : 0;
        transfer_all(horizontal, upwards, second, time_step);
        if (is_input_) {
            record = std::make_shared<const Accelerogram>(std::move(horizontal), std::move(upwards),
                                                          time_step, std::move(second));
        }
    }

    void transfer(Problem& problem)
    {
        // With structured bindings, a new member that is not named here does not compile.
        auto& [scene, grid, numerics, product, fields] = problem;
        auto& [pulse, theory, shape, records, gravity] = scene;
        auto& [numbers, dimensions] = grid;
        transfer_all(pulse, theory, shape, records, gravity, numbers, dimensions, numerics, product,
                     fields);
    }

private:
    template <class... Values>
    void transfer_all(Values&... values)
    {
        (transfer(values), ...);
    }

    std::string bytes_;
    bool is_input_ = false;
    std::size_t next_ = 0; // of an input
};

} // namespace

std::string bytes_of(const Problem& problem)
{
    Archive archive;
    Problem copy = problem;
    archive.transfer(copy);
    return archive.bytes();
}

Problem problem_of(std::string_view bytes)
{
    Archive archive(bytes);
    Problem problem;
    archive.transfer(problem);
    return problem;
}

} // namespace overturn
