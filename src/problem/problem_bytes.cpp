#include "overturn/problem/problem_bytes.hpp"

#include <array>
#include <cstring>
#include <memory>
#include <type_traits>

namespace overturn {

namespace {

/// Appends values to bytes, or takes values from bytes; the members of each type are named once.
struct Archive {
    std::string bytes;
    bool is_input;
    std::size_t next = 0; ///< of an input

    template <class Value> // not a class, which may have padding
        requires std::is_arithmetic_v<Value> || std::is_enum_v<Value>
    void transfer(Value& value)
    {
        if (is_input) {
            std::memcpy(&value, bytes.data() + next, sizeof value);
            next += sizeof value;
        } else {
            bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
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

    void transfer(AxisRange& range)
    {
        auto& [first, last, count, spacing] = range;
        transfer_all(first, last, count, spacing);
    }

    void transfer(Axis& axis)
    {
        bool is_range = axis.is_range();
        AxisRange range = is_range ? std::get<AxisRange>(axis.definition()) : AxisRange();
        AxisList list = is_range ? AxisList() : std::get<AxisList>(axis.definition());
        transfer_all(is_range, range, list);
        axis = is_range ? Axis(range) : Axis(std::move(list));
    }

    void transfer(Column& column)
    {
        std::ptrdiff_t number = column.quantity - all_quantities().data();
        transfer_all(number, column.values);
        column.quantity = all_quantities().data() + number;
    }

    void transfer(Field& field)
    {
        std::ptrdiff_t number = is_input ? 0 : &traits_of(field) - all_fields().data();
        transfer_all(number, field.precision);
        field.name = all_fields()[std::size_t(number)].name;
    }

    void transfer(Dimension& dimension) { transfer_all(dimension.name, dimension.columns); }

    void transfer(Product& product)
    {
        std::size_t kind = product.index();
        double audit = product.audit().value_or(0);
        const Boundaries* boundaries = product.boundaries();
        const Quantity* along = boundaries != nullptr ? boundaries->along : nullptr;
        std::ptrdiff_t number = along != nullptr ? along - all_quantities().data() : -1;
        transfer_all(kind, audit, number);
        if (is_input) {
            along = number < 0 ? nullptr : all_quantities().data() + number;
            product = std::array<Product, 3>{Spectrum(), FilledSpectrum{{}, audit},
                                             Boundaries{along}}[kind];
        }
    }

    void transfer(std::shared_ptr<const Accelerogram>& record)
    {
        std::vector<double> horizontal, upwards, second;
        double time_step = 0;
        if (!is_input) {
            horizontal = record->horizontal();
            upwards = record->upwards();
            second = record->second();
            time_step = record->time_step();
        }
        transfer_all(horizontal, upwards, second, time_step);
        record = std::make_shared<const Accelerogram>(std::move(horizontal), std::move(upwards),
                                                      time_step, std::move(second));
    }

    void transfer(Pulse& pulse)
    {
        auto& [kind, shape] = pulse;
        auto& [window, cycles, gamma, nu] = shape;
        transfer_all(kind, window, cycles, gamma, nu);
    }
    void transfer(Suite& suite) { transfer(suite.records); }

    void transfer(TabulatedPulse& pulse)
    {
        std::vector<double> phases, shape;
        if (!is_input) {
            phases = pulse.shape->phases();
            shape = pulse.shape->horizontal();
        }
        transfer_all(phases, shape);
        pulse.shape = std::make_shared<const Accelerogram>(
            Accelerogram::of_pulse(std::move(phases), std::move(shape)));
    }

    void transfer(Motion& motion)
    {
        std::size_t kind = motion.index();
        transfer(kind);
        if (is_input) {
            motion = std::array<Motion, 3>{Pulse(), Suite(), TabulatedPulse()}[kind];
        }
        std::visit([&](auto& of_kind) { transfer(of_kind); }, motion);
    }

    void transfer(Numerics& numerics)
    {
        auto& [method, tolerance, resolve] = numerics;
        transfer_all(method, tolerance, resolve);
    }

    void transfer(Problem& problem)
    {
        // With structured bindings, a new member that is not named here does not compile.
        auto& [scene, grid, numerics, product, fields] = problem;
        auto& [motion, theory, gravity, motion_of] = scene;
        auto& [numbers, dimensions] = grid;
        transfer_all(motion, theory, gravity, motion_of, numbers, dimensions, numerics, product,
                     fields);
    }

    template <class... Values>
    void transfer_all(Values&... values)
    {
        (transfer(values), ...);
    }
};

} // namespace

std::string bytes_of(const Problem& problem)
{
    Archive archive{{}, false};
    Problem copy = problem;
    archive.transfer(copy);
    return archive.bytes;
}

Problem problem_of(std::string_view bytes)
{
    Archive archive{std::string(bytes), true};
    Problem problem;
    archive.transfer(problem);
    return problem;
}

} // namespace overturn
