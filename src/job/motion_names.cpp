#include "motion_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace overturn {

std::string label_of(const RecordFile& file, const RecordComponent& component)
{
    const auto count =
        std::count_if(file.components.begin(), file.components.end(),
                      [&](const RecordComponent& each) { return each.name == component.name; });
    return component.name.empty() || count > 1 || component.name.find('/') != std::string::npos
               ? fmt::format("{}", &component - file.components.data() + 1)
               : component.name;
}

void name_motions(std::vector<Motion>& motions, const std::vector<std::string>& labels)
{
    std::map<std::string, int> of_file, of_component;
    const auto with_component = [&](std::size_t i) { return motions[i].file + ":" + labels[i]; };
    for (std::size_t i = 0; i < motions.size(); ++i) {
        ++of_file[motions[i].file];
        ++of_component[with_component(i)];
    }
    for (std::size_t i = 0; i < motions.size(); ++i) {
        Motion& motion = motions[i];
        motion.name = of_file[motion.file] == 1 ? motion.file : with_component(i);
        if (of_file[motion.file] > 1 && of_component[motion.name] > 1) {
            motion.name += ":" + motion.vertical;
        }
    }
}

std::vector<std::int64_t> motions_named(const std::string& name, const std::vector<Motion>& motions)
{
    std::vector<std::int64_t> found;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const Motion& motion = motions[i];
        if (name == motion.name) {
            return {std::int64_t(i)};
        }
        const std::filesystem::path path(motion.file);
        const std::string suffix = motion.name.substr(motion.file.size());
        for (const std::string& file :
             {path.string(), path.filename().string(), path.stem().string()}) {
            if (name == file || name == file + suffix) {
                found.push_back(std::int64_t(i));
                break;
            }
        }
    }
    return found;
}

} // namespace overturn
