// Jobs with records and tables for tests.
#pragma once

#include "job_file.hpp"

#include "support/scratch_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace overturn {

/// Names of motions, dimensions or files.
using Names = std::vector<std::string>;

/// Writes jobs, and the records and tables that they name, into a folder of its own.
class JobWithFiles : public testing::Test {
protected:
    void write(const std::string& name, const std::string& text) const
    {
        write_bytes(folder_ / name, text);
    }

    void write_record(const std::string& name, const std::string& samples) const
    {
        write(name, "PEER\nA, 1\nIN UNITS OF G\nNPTS= 3, DT= .1\n" + samples + "\n");
    }

    /// A V2A file with these components, of two samples each.
    void write_components(const std::string& name, const std::vector<std::string>& names) const
    {
        std::string text;
        for (std::size_t i = 0; i < names.size(); ++i) {
            for (int line = 1; line <= 26; ++line) {
                text +=
                    line == 1    ? "Corrected accelerogram"
                    : line == 10 ? "Number of points 2"
                    : line == 13 ? "Component " + names[i]
                    : line == 14 ? fmt::format("Acceleration: peak {} mm/s/s", i + 1)
                    : line == 20 ? fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}", 0, 0, 0, 2, 0, 0)
                    : line == 23 ? fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}", 0, 0, 0, 0, 0, 0.1)
                                 : "";
                text += '\n';
            }
            text += fmt::format("{:>8}{:>8}\n", 0, i + 1);
        }
        write(name, text);
    }

    Job job(const std::string& scene, const std::string& rest) const
    {
        return read_job_text("[scene]\n" + scene + "\n" + rest, folder_ / "job.toml");
    }

    Job plane(const std::string& scene, const std::string& strength = "scale = 1") const
    {
        return job(scene,
                   "[plane]\n" + strength + "\nsize = 1\nslenderness = 0.2\nrestitution = 0.9\n");
    }

    /// A job with a table and a plane.
    Job table(const std::string& text, const std::string& scene, const std::string& plane) const
    {
        write("t.csv", text);
        return job(scene, "[blocks]\ntable = \"t.csv\"\n[plane]\n" + plane);
    }

    /// A job with a table of one block; pulse: under this pulse, else records of the scene.
    Job table(const std::string& text, const std::string& scene = "pulse = \"one_sine\"") const
    {
        write("t.csv", text);
        return job(scene, scene.starts_with("pulse")
                              ? "[blocks]\ntable = \"t.csv\"\n[plane]\npga = 1\n"
                                "pulse_period = 1\n"
                              : "[blocks]\ntable = \"t.csv\"\n");
    }

    ScratchFolder folder_;
};

/// The names of the motions of a job.
inline Names names_of_motions(const Job& job)
{
    Names names;
    for (const RecordedMotion& motion : job.motions) {
        names.push_back(motion.name);
    }
    return names;
}

} // namespace overturn
