#include "job_of_rank_0.hpp"

#include <memory>
#include <vector>

namespace overturn {

namespace {

/// The blocks of rank 0 on all ranks.
BlockList blocks_of_rank_0(const MpiSession& session, BlockList list)
{
    for (const auto values :
         {&BlockList::slenderness, &BlockList::restitution, &BlockList::frequency_parameter,
          &BlockList::amplitude, &BlockList::frequency}) {
        list.*values = session.from_rank_0(std::move(list.*values));
    }
    const std::vector<double> motion =
        session.from_rank_0(std::vector<double>(list.motion.begin(), list.motion.end()));
    list.motion.assign(motion.begin(), motion.end());
    return list;
}

} // namespace

Job job_of_rank_0(const MpiSession& session, std::optional<Job> read, bool is_boundary)
{
    const std::string resolved = session.from_rank_0(read ? read->resolved : "");
    if (session.rank() != 0) {
        read = read_resolved_job(resolved, "the job of rank 0");
        read = is_boundary ? boundary_of(*std::move(read)) : std::move(read);
    }
    for (std::size_t i = 0; i < read->motions.size(); ++i) {
        Motion& motion = read->motions[i];
        const auto values_of_rank_0 = [&](const std::vector<double>& (Accelerogram::*values)()
                                              const) {
            return session.from_rank_0(motion.record ? ((*motion.record).*values)()
                                                     : std::vector<double>());
        };
        auto horizontal = values_of_rank_0(&Accelerogram::horizontal);
        auto upwards = values_of_rank_0(&Accelerogram::upwards);
        if (!motion.record) {
            motion.record = std::make_shared<const Accelerogram>(
                std::move(horizontal), std::move(upwards), motion.time_step);
            read->scene.records[i] = motion.record;
        }
    }
    if (read->plane.list) {
        read->plane.list =
            std::make_shared<BlockList>(blocks_of_rank_0(session, *read->plane.list));
    }
    return *std::move(read);
}

} // namespace overturn
