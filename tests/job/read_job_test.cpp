#include "overturn/job/job.hpp"

#include "job_file.hpp"
#include "overturn/job/schema.hpp"
#include "support/scratch_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace overturn {

namespace {

using testing::HasSubstr;

TEST(ReadingAJob, AcceptsANumberForAnAxisOfOneValue)
{
    const Job job = job_of(R"([scene]
pulse = "one_sine"
[plane]
frequency = 3
amplitude = 1.5
restitution = 0.9
slenderness = 0.2
)");
    EXPECT_EQ(job.problem.grid.points(), 1);
    EXPECT_EQ(axis(job, "frequency")[0], 3);
    EXPECT_EQ(axis(job, "amplitude")[0], 1.5);
    EXPECT_EQ(axis(job, "restitution")[0], 0.9);
    EXPECT_EQ(axis(job, "slenderness")[0], 0.2);
    EXPECT_EQ(dimensions_of(job), std::vector<std::string>{}) << "a number is no dimension";
    EXPECT_NE(job.resolved.find("frequency = 3.0\n"), std::string::npos);
}

TEST(ReadingAJob, ReturnsTheValuesOfTheFile)
{
    const Job job = job_of(R"(title = "Antisymmetric"
[scene]
pulse = "antisymmetric_ricker"
theory = "linear"
window = 1.5
[plane]
frequency = { first = 0.5, last = 8.0, count = 5, spacing = "log" }
amplitude = { first = 0, last = 16, count = 17 }
restitution_of_maximum = { values = [0.5, 1] }
slenderness = { values = [0.1, 0.2, 0.3] }
[numerics]
method = "rk45"
tolerance = 1e-6
[output]
fields = ["margin", "region"]
)");
    EXPECT_EQ(job.title, "Antisymmetric");
    EXPECT_EQ(job.problem.scene.pulse()->kind, PulseKind::antisymmetric_ricker);
    EXPECT_EQ(job.problem.scene.theory, Theory::linear);
    EXPECT_EQ(job.problem.scene.pulse()->shape.window, 1.5);
    const auto frequency = std::get<AxisRange>(axis(job, "frequency").definition());
    EXPECT_EQ(frequency.first, 0.5);
    EXPECT_EQ(frequency.last, 8);
    EXPECT_EQ(frequency.count, 5);
    EXPECT_EQ(frequency.spacing, Spacing::log);
    const auto amplitude = std::get<AxisRange>(axis(job, "amplitude").definition());
    EXPECT_EQ(amplitude.first, 0);
    EXPECT_EQ(amplitude.count, 17);
    EXPECT_EQ(amplitude.spacing, Spacing::linear);
    EXPECT_EQ(std::get<AxisList>(axis(job, "restitution_of_maximum").definition()),
              (AxisList{0.5, 1}));
    EXPECT_EQ(axis(job, "slenderness").values(), (AxisList{0.1, 0.2, 0.3}));
    EXPECT_EQ(job.problem.numerics.method, Method::rk45);
    EXPECT_EQ(job.problem.numerics.tolerance, 1e-6);
    EXPECT_EQ(job.problem.fields, (std::vector<Field>{Field::margin, Field::region}));
    EXPECT_EQ(job.problem.grid.points(), 5 * 17 * 2 * 3);
}

/// The names of the dimensions of a job with this text under its pulse.
std::vector<std::string> dimensions_with(const std::string& rest)
{
    return dimensions_of(job_of("scene.pulse = 'one_sine'\n" + rest));
}

using Dimensions = std::vector<std::string>;

TEST(ReadingAJob, AcceptsANumberOrAnAxisForEveryQuantity)
{
    const std::string many = " = { values = [0.5, 0.6] }\n";
    EXPECT_EQ(dimensions_with("[plane]\npulse_period" + many + "pga" + many +
                              "restitution_of_maximum" + many + "height" + many + "width" + many),
              (Dimensions{"width", "height", "restitution_of_maximum", "pga", "pulse_period"}));
    EXPECT_EQ(dimensions_with("[block]\nhalf_height" + many + "half_width = 0.2\n[plane]\n" +
                              "pulse_frequency" + many + "amplitude = 2\nrestitution = 0.9\n"),
              (Dimensions{"half_height", "pulse_frequency"}));
    EXPECT_EQ(dimensions_with("[block]\nslenderness = 0.2\n[plane]\nfrequency" + many +
                              "pga = 0.4\nrestitution" + many + "frequency_parameter" + many),
              (Dimensions{"frequency_parameter", "restitution", "frequency"}));
    EXPECT_EQ(dimensions_with("[plane]\npga = { values = [0.4] }\nslenderness = 0.2\nsize" + many +
                              "restitution = 1\npulse_period = 1\n"),
              (Dimensions{"size", "pga"}))
        << "a list of one value is a dimension";
}

TEST(ReadingAJob, AcceptsAPeakAccelerationWithoutASize)
{
    const Job job = job_of(sound_job_with(6, "pga = 0.4"));
    EXPECT_NEAR(coordinate(job, "amplitude"), 0.4 / std::tan(0.1745716), 1e-15);
}

TEST(ReadingAJob, AcceptsBothSpellingsOfAShareOfTheLargestRestitution)
{
    EXPECT_EQ(job_of(older_job()).resolved, job_of(sound_job).resolved);
}

TEST(TheKeysOfAJob, AreTheQuantitiesOfItsPoints)
{
    for (const Quantity& quantity : all_quantities()) {
        const auto count = [&](std::string_view table) {
            const std::vector<std::string_view> keys = keys_of(table);
            return std::count(keys.begin(), keys.end(), quantity.name);
        };
        const bool is_motion = quantity.role == Role::motion;
        EXPECT_EQ(count("plane"), quantity.is_coordinate() && !is_motion) << quantity.name;
        EXPECT_EQ(count("block"), quantity.role == Role::block) << quantity.name;
    }
    EXPECT_EQ(keys_of(""),
              (std::vector<std::string_view>{"title", "scene", "plane", "block", "blocks",
                                             "numerics", "output", "boundary"}));
    EXPECT_EQ(keys_of("no_table"), std::vector<std::string_view>{});
}

TEST(TheKeysOfAJob, CanBeOverridden)
{
    const std::vector<std::string> keys = override_keys();
    const auto has = [&](const std::string& key) {
        return std::find(keys.begin(), keys.end(), key) != keys.end();
    };
    const ScratchFolder folder;
    write_bytes(folder / "record.AT2", "PEER\nA, 1\nIN UNITS OF G\nNPTS= 3, DT= .1\n0 1 0\n");
    for (const std::string_view name : keys_of("plane")) {
        const std::string key = "plane." + std::string(name);
        EXPECT_TRUE(has(key)) << key;
        std::vector<std::string> settings; // what else this quantity needs
        if (name == "width" || name == "half_width") {
            settings = {"plane.height=3"};
        } else if (name == "height" || name == "half_height") {
            settings = {"plane.width=0.1"};
        } else if (name == "aspect_ratio") {
            settings = {"plane.restitution=1"}; // r_max is not defined for so stout a block
        } else if (name == "scale") {
            settings = {fmt::format("scene.record='{}'", folder / "record.AT2"), "plane.size=1"};
        } else if (quantity(name).role == Role::rate) {
            settings = {"plane.size=1"};
        } else if (name.ends_with("_plus") || name.ends_with("_minus")) {
            settings = {"plane.slenderness_plus=0.3", "plane.slenderness_minus=0.3",
                        "plane.size_plus=1",          "plane.size_minus=1",
                        "plane.radius_of_gyration=1", "plane.pga=1",
                        "plane.pulse_period=1"};
        } else if ((quantity(name).scope.shapes & shape::two_sides) != 0) {
            settings = {"plane.width=2", "plane.height=3", "plane.pga=1", "plane.pulse_period=1"};
        }
        const AxisList values = name == "direction" ? AxisList{0, 180} : AxisList{0.25, 0.5};
        settings.push_back(fmt::format("{}={}", key, values[1]));
        EXPECT_EQ(axis(job_of(sound_job, settings), name).values(), AxisList{values[1]}) << key;
        EXPECT_TRUE(has(key + ".values"));
        settings.back() = fmt::format("{}.values=[{}, {}]", key, values[0], values[1]);
        EXPECT_EQ(axis(job_of(sound_job, settings), name).values(), values) << key;
    }
    for (const std::string key : {"title", "scene.pulse", "block.half_height.count", "blocks.table",
                                  "plane.restitution.of", "output.fields"}) {
        EXPECT_TRUE(has(key)) << key;
    }
}

TEST(ReadingAJob, FillsInTheDefaults)
{
    const Job job = job_of(R"([scene]
pulse = "symmetric_ricker"
[plane]
frequency = { values = [1] }
amplitude = { values = [1] }
restitution = { values = [1] }
slenderness = { values = [0.2] }
)");
    EXPECT_EQ(job.title, "");
    EXPECT_EQ(job.problem.scene.theory, Theory::nonlinear);
    EXPECT_EQ(job.problem.scene.pulse()->shape.window, 1);
    EXPECT_FALSE(gives(job, "restitution_of_maximum"));
    EXPECT_EQ(job.problem.numerics.method, Method::rk45);
    EXPECT_EQ(job.problem.numerics.tolerance, 1e-9);
    EXPECT_EQ(job.problem.fields, std::vector<Field>{Field::region});
}

TEST(ReadingAJob, FillsInTheDefaultsOfEmptyTables)
{
    EXPECT_EQ(job_of(sound_job_with(10, "")).problem.numerics.tolerance, 1e-9);
    EXPECT_EQ(job_of(sound_job_with(12, "")).problem.fields, std::vector<Field>{Field::region});
}

TEST(ReadingAJob, DerivesTheSlendernessFromTheBlock)
{
    const Job job = job_of(sound_job_with(8, "[block]\nhalf_width = 1.0\nhalf_height = 5.67"));
    EXPECT_EQ(axis(job, "half_width")[0], 1);
    EXPECT_EQ(axis(job, "half_height")[0], 5.67);
    // The paper's block, to its seven known digits; degrees or h/b would be far off.
    EXPECT_NEAR(coordinate(job, "slenderness"), 0.1745716, 5e-8);
    EXPECT_NEAR(coordinate(job, "restitution"), 0.7 * 0.911547, 5e-7);
}

TEST(ReadingAJob, AcceptsTheEndsOfEveryInterval)
{
    const std::string text = R"([scene]
pulse = "symmetric_ricker"
window = 8
[plane]
frequency = { values = [5e-324, 1.7976931348623157e308] }
amplitude = { values = [0] }
restitution = { values = [1] }
slenderness = { values = [1.5707963267948963] }
[numerics]
tolerance = 1e-14
)";
    EXPECT_EQ(axis(job_of(text), "frequency").first(), 5e-324);
    EXPECT_EQ(job_of(text, {"numerics.tolerance=1e-2"}).problem.numerics.tolerance, 1e-2);
}

TEST(ReadingAJob, AcceptsTheFinestAscendingRanges)
{
    // 80 steps of one unit in the last place; one more value does not fit in between.
    const std::vector<std::string> fine{"plane.frequency.first=1.9999999999999822",
                                        "plane.frequency.last=2", "plane.frequency.count=81"};
    const Axis frequency = axis(job_of(sound_job, fine), "frequency");
    for (std::int64_t i = 1; i < frequency.size(); ++i) {
        EXPECT_LT(frequency[i - 1], frequency[i]);
    }
    const std::vector<std::string> finer{fine[0], fine[1], "plane.frequency.count=82"};
    EXPECT_NE(refusal_of(sound_job, finer), "");
}

TEST(ReadingAJob, ContainsNoNegativeZero)
{
    const Job job = job_of(sound_job_with(6, "amplitude = { values = [-0.0, 1] }"));
    EXPECT_FALSE(std::signbit(axis(job, "amplitude")[0]));
}

TEST(ReadingAJob, StoresTheFileByteForByte)
{
    const std::string text = std::string("# a comment\r\n") + sound_job + "\n\n# the end";
    const ScratchFolder folder;
    write_bytes(folder / "job.toml", text);
    EXPECT_EQ(read_job(folder / "job.toml").given, text);
}

TEST(ReadingAJob, RefusesAFileThatCannotBeRead)
{
    const ScratchFolder folder;
    const auto refusal_at = [](const std::string& path) {
        return refusal(exit_code::job, [&] { read_job(path); });
    };
    EXPECT_EQ(refusal_at(folder / "none.toml"),
              folder / "none.toml" +
                  ": cannot be read: No such file or directory. Give the path of a job file.");
    EXPECT_EQ(refusal_at(folder / ""),
              folder / "" + ": cannot be read: Is a directory. Give the path of a job file.");
    // A link to itself cannot be opened even by the superuser.
    std::filesystem::create_symlink(folder / "loop.toml", folder / "loop.toml");
    EXPECT_THAT(refusal_at(folder / "loop.toml"), HasSubstr("loop.toml: cannot be read: "));
    write_bytes(folder / "large.toml", sound_job);
    std::filesystem::resize_file(folder / "large.toml", (std::uintmax_t(64) << 20) + 1);
    EXPECT_THAT(refusal_at(folder / "large.toml"), HasSubstr("large.toml: is larger than 64 MiB"));
}

TEST(ReadingAJob, RefusesAnEmptyFile)
{
    EXPECT_EQ(refusal_of(""),
              "job.toml:1:1: scene is missing. Add [scene] with a pulse or a record.");
}

TEST(ReadingAJob, RefusesAJobWithoutAPlane)
{
    EXPECT_THAT(refusal_of("[scene]\npulse = 'one_sine'\n"), HasSubstr(":1:1: plane is missing."));
}

TEST(CutByWindow, IsTheValueOfThePulseAtTheEndsOfItsWindow)
{
    // x = pi: (1 - 2 pi^2) exp(-pi^2) = -9.7e-4; z = 2 pi / sqrt 3: 3.7e-2.
    EXPECT_NEAR(cut_by_window({PulseKind::symmetric_ricker}), 9.69e-4, 1e-6);
    EXPECT_NEAR(cut_by_window({PulseKind::antisymmetric_ricker}), 3.71e-2, 1e-4);
    EXPECT_LT(cut_by_window({PulseKind::antisymmetric_ricker, {.window = 2}}), 1e-8);
    EXPECT_EQ(cut_by_window({PulseKind::rectangular}), 0);
}

} // namespace

} // namespace overturn
