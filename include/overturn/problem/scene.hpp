// The simulated scene: ground motion and theory of the block.
#pragma once

#include "overturn/mechanics/theory/theory.hpp"
#include "overturn/problem/motion.hpp"
#include "overturn/text/motion_words.hpp"
#include "overturn/text/names.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace overturn {

template <>
inline constexpr std::array<std::string_view, 2> names_of<Theory>{"nonlinear", "linear"};

struct Scene {
    Motion motion{};
    Theory theory = Theory::nonlinear;
    double gravity = 9.81; ///< g [m/s2]
    MotionOf motion_of = MotionOf::ground;

    const MotionTraits& motion_traits() const
    {
        return std::visit([](const auto& kind) -> const MotionTraits& { return kind.traits; },
                          motion);
    }

    /// The pulse that has a formula, or nullptr.
    const Pulse* pulse() const { return std::get_if<Pulse>(&motion); }

    /// The pulse, of any kind; nullopt under records.
    std::optional<NamedPulse> named_pulse() const
    {
        return std::visit([](const auto& kind) { return kind.named(); }, motion);
    }

    /// What is integrated as records: these, or the shape of a pulse that is given by a table;
    /// empty under other pulses.
    std::span<const Record> records() const
    {
        if (const auto* table = std::get_if<TabulatedPulse>(&motion)) {
            return {&table->shape, 1};
        }
        const auto* suite = std::get_if<Suite>(&motion);
        return suite == nullptr ? std::span<const Record>() : suite->records;
    }

    bool has_two_components() const
    {
        return !records().empty() && !records()[0]->second().empty();
    }

    bool is_under(Under under) const
    {
        return under == Under::any_motion || under == motion_traits().under ||
               (under == Under::two_components && has_two_components());
    }

    Integrator integrator(const Numerics& numerics) const
    {
        return std::visit([&](const auto& kind) { return kind.integrator(numerics); }, motion);
    }

    /// A text about the motion of the ground in the words for this motion, see motion_words.hpp.
    std::string worded(std::string_view about_the_ground) const
    {
        return overturn::worded(motion_of, about_the_ground);
    }

    /// The index into `records` of a value of the coordinate "motion", which counts from 1.
    static std::size_t record_index(double motion) { return std::size_t(motion) - 1; }
};

} // namespace overturn
