// Replaces the header of Boost, which needs threads of the C++ library. There is one thread.
#pragma once

namespace boost::detail {

struct lightweight_mutex {
    struct scoped_lock {
        explicit scoped_lock(const lightweight_mutex& /*mutex*/) {}
    };
};

} // namespace boost::detail
