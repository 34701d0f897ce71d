#include "overturn/text/motion_words.hpp"

#include <boost/algorithm/string/replace.hpp>

namespace overturn {

namespace {

struct Words {
    std::string_view of_ground;
    std::string_view of_floor;
};

constexpr Words all_words[] = {{"ground", "floor"}, {"PGA", "PFA"}, {"PGV", "PFV"}};

} // namespace

std::string worded(MotionOf motion_of, std::string_view about_the_ground)
{
    std::string text(about_the_ground);
    if (motion_of == MotionOf::floor) {
        for (const auto& [of_ground, of_floor] : all_words) {
            boost::algorithm::replace_all(text, of_ground, of_floor);
        }
    }
    return text;
}

} // namespace overturn
