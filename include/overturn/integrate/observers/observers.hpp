// The observers of a run.
#pragma once

#include "overturn/integrate/observers/events.hpp"
#include "overturn/integrate/observers/extremes.hpp"
#include "overturn/integrate/observers/impact_count.hpp"
#include "overturn/integrate/observers/margin_error.hpp"

namespace overturn {

/// Those of the outputs; the others take no time and no space. The contact has an observer of its
/// own kind, which sees every trial of a step, see contact_observer.hpp.
template <Outputs outputs, Theory theory, Number T, bool is_recorded>
struct Observers {
    [[no_unique_address]] OnlyIf<outputs.impacts, ImpactCount<T>> impacts;
    [[no_unique_address]] OnlyIf<outputs.error, MarginError<theory, T>> error;
    [[no_unique_address]] OnlyIf<outputs.peak, Extremes<theory, T, !is_recorded>> extremes;
    [[no_unique_address]] OnlyIf<outputs.events, Events<T>> events;

    /// Calls visit(observer) for each of them.
    void each(const auto& visit) { visit_all(*this, visit); }
    void each(const auto& visit) const { visit_all(*this, visit); }

private:
    static void visit_all(auto& self, const auto& visit)
    {
        const auto visit_if = [&]<class Part>(Part& part) {
            if constexpr (std::is_base_of_v<Observer, Part>) {
                visit(part);
            }
        };
        // With structured bindings, a new member that is not named here does not compile.
        auto& [first, second, third, fourth] = self;
        visit_if(first);
        visit_if(second);
        visit_if(third);
        visit_if(fourth);
    }
};

} // namespace overturn
