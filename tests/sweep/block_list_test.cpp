// Lists of blocks, compared with planes that contain the same points.
#include "overturn/sweep/block_list.hpp"

#include "overturn/mechanics/block.hpp"
#include "overturn/sweep/sweep_tile.hpp"
#include "support/random_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace overturn {
namespace {

const std::vector<Field> some_fields{Field::region,  Field::angle,  Field::margin,
                                     Field::impacts, Field::status, Field::peak};

/// Sizes of blocks that differ in slenderness and size [m], and their shares of r_max.
const std::vector<double> widths{0.4, 0.6, 1.0};
const std::vector<double> heights{2.0, 1.8, 5.0};
const std::vector<double> shares{0.8, 0.9, 1.0};

Columns columns_of_blocks()
{
    return {{"width", widths}, {"height", heights}, {"restitution_of_maximum", shares}};
}

Plane plane_of(const Columns& columns, const Scene& scene,
               const std::vector<std::int64_t>& motion = {})
{
    Plane plane;
    plane.list = std::make_shared<BlockList>(block_list(scene, columns, motion));
    plane.motions = std::int64_t(scene.records.size());
    return plane;
}

/// The plane of one block of the list, in the same quantities.
Plane plane_of_block(const Plane& list, std::size_t block)
{
    Plane plane = list;
    plane.list = nullptr;
    plane.slenderness = Axis(AxisList{std::atan(widths[block] / heights[block])});
    plane.restitution = Axis(AxisList{shares[block]});
    plane.restitution_of = RestitutionOf::maximum;
    plane.size = half_diagonal({widths[block] / 2, heights[block] / 2});
    if (plane.motions > 0) {
        plane.frequency = Axis(AxisList{*plane.size});
        plane.frequency_is = FrequencyQuantity::size;
    }
    return plane;
}

/// The values of a field at all points, in order.
std::vector<double> swept(const Scene& scene, const Plane& plane, std::size_t field)
{
    const Tiling tiling(shape_of(plane), {1});
    std::vector<double> all;
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        const TileFields fields =
            sweep_tile(scene, {}, plane, tiling[i], some_fields, widest_kernel());
        std::visit([&](const auto& values) { all.push_back(double(values[0])); },
                   fields.values[field]);
    }
    return all;
}

/// Expects equal bits; NaN equals NaN.
void expect_same(const std::vector<double>& one, const std::vector<double>& other)
{
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_TRUE(one[i] == other[i] || (std::isnan(one[i]) && std::isnan(other[i])))
            << i << ": " << one[i] << " and " << other[i];
    }
}

TEST(BlockList, HasTheValuesOfAPlanePerBlock)
{
    const Scene scene;
    Plane list = plane_of(columns_of_blocks(), scene);
    list.amplitude = Axis(AxisRange{0.2, 2.0, 7});
    list.amplitude_is = AmplitudeQuantity::pga;
    list.frequency = Axis(AxisRange{0.2, 1.5, 5});
    list.frequency_is = FrequencyQuantity::pulse_period;
    EXPECT_EQ(shape_of(list), (Shape{3, 7, 5}));
    EXPECT_EQ(Tiling(list).size(), 1);
    for (std::size_t f = 0; f < some_fields.size(); ++f) {
        std::vector<double> expected;
        for (std::size_t block = 0; block < 3; ++block) {
            const std::vector<double> part = swept(scene, plane_of_block(list, block), f);
            expected.insert(expected.end(), part.begin(), part.end());
        }
        expect_same(swept(scene, list, f), expected);
    }
}

Scene scene_of_two_records()
{
    std::mt19937_64 generator(7);
    Scene scene;
    for (int i = 0; i < 2; ++i) {
        std::vector<double> samples = random_samples(generator, 400);
        for (double& sample : samples) {
            sample *= 2;
        }
        scene.records.push_back(
            std::make_shared<Accelerogram>(samples, std::vector<double>(), i == 0 ? 0.01 : 0.02));
    }
    return scene;
}

TEST(BlockList, HasTheValuesOfAPlanePerBlockUnderEveryRecord)
{
    const Scene scene = scene_of_two_records();
    Plane list = plane_of(columns_of_blocks(), scene);
    list.amplitude = Axis(AxisRange{0.2, 2.0, 7});
    list.amplitude_is = AmplitudeQuantity::scale;
    EXPECT_EQ(shape_of(list), (Shape{2, 3, 7}));
    for (std::size_t f = 0; f < some_fields.size(); ++f) {
        std::vector<std::vector<double>> of_block;
        for (std::size_t block = 0; block < 3; ++block) {
            of_block.push_back(swept(scene, plane_of_block(list, block), f));
        }
        std::vector<double> expected;
        for (std::size_t motion = 0; motion < 2; ++motion) {
            for (std::size_t block = 0; block < 3; ++block) {
                const auto begin = of_block[block].begin() + std::ptrdiff_t(7 * motion);
                expected.insert(expected.end(), begin, begin + 7);
            }
        }
        expect_same(swept(scene, list, f), expected);
    }
}

TEST(BlockList, WithMotionsOfItsOwnHasOnePointPerBlock)
{
    const std::vector<double> pga{0.9, 0.5, 0.4};
    const std::vector<double> period{0.5, 0.8, 1.1};
    Columns columns = columns_of_blocks();
    columns["pga"] = pga;
    columns["pulse_period"] = period;
    const Scene scene;
    const Plane list = plane_of(columns, scene);
    EXPECT_EQ(shape_of(list), (Shape{3}));
    for (std::size_t f = 0; f < some_fields.size(); ++f) {
        std::vector<double> expected;
        for (std::size_t block = 0; block < 3; ++block) {
            Plane plane = plane_of_block(list, block);
            plane.amplitude = Axis(AxisList{pga[block]});
            plane.amplitude_is = AmplitudeQuantity::pga;
            plane.frequency = Axis(AxisList{period[block]});
            plane.frequency_is = FrequencyQuantity::pulse_period;
            expected.push_back(swept(scene, plane, f)[0]);
        }
        expect_same(swept(scene, list, f), expected);
    }
}

TEST(BlockList, WithRecordsOfItsOwnHasTheSameValuesInAnyTile)
{
    const Scene scene = scene_of_two_records();
    const std::vector<double> scale{0.8, 1.2, 1.7};
    const std::vector<std::int64_t> motion{1, 0, 1};
    Columns columns = columns_of_blocks();
    columns["scale"] = scale;
    const Plane list = plane_of(columns, scene, motion);
    EXPECT_EQ(shape_of(list), (Shape{3}));
    const TileFields whole =
        sweep_tile(scene, {}, list, Tiling(list)[0], some_fields, widest_kernel());
    for (std::size_t f = 0; f < some_fields.size(); ++f) {
        std::vector<double> expected;
        for (std::size_t block = 0; block < 3; ++block) {
            Plane plane = plane_of_block(list, block);
            plane.amplitude = Axis(AxisList{scale[block]});
            plane.amplitude_is = AmplitudeQuantity::scale;
            expected.push_back(swept(scene, plane, f)[std::size_t(motion[block])]);
        }
        expect_same(swept(scene, list, f), expected);
        const auto in_doubles = [](const auto& values) {
            return std::vector<double>(values.begin(), values.end());
        };
        expect_same(std::visit(in_doubles, whole.values[f]), expected);
    }
}

TEST(BlockList, DescribesABlockByItsHalvesOrItsSlendernessAndSize)
{
    const BlockList whole = block_list({}, columns_of_blocks());
    Columns halves{{"half_width", {0.2, 0.3, 0.5}},
                   {"half_height", {1.0, 0.9, 2.5}},
                   {"restitution", whole.restitution}};
    EXPECT_EQ(block_list({}, halves).slenderness, whole.slenderness);
    EXPECT_EQ(block_list({}, halves).frequency_parameter, whole.frequency_parameter);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < 3; ++i) {
        sizes.push_back(half_diagonal({widths[i] / 2, heights[i] / 2}));
    }
    Columns angles{
        {"slenderness", whole.slenderness}, {"size", sizes}, {"restitution_of_maximum", shares}};
    EXPECT_EQ(block_list({}, angles).frequency_parameter, whole.frequency_parameter);
    EXPECT_EQ(block_list({}, angles).restitution, whole.restitution);
    angles.erase("size");
    EXPECT_TRUE(block_list({}, angles).frequency_parameter.empty());
}

struct Refused {
    Columns columns; ///< in addition to those of blocks
    std::int64_t row;
    std::string column;
    std::string phrase;
};

TEST(BlockList, IsRefusedWithRowAndColumn)
{
    const std::vector<Refused> all{
        {{{"width", {0.4, -0.6, 1}}}, 1, "width", "-0.6 is outside (0, inf)"},
        {{{"width", {0.4, 0.6, std::nan("")}}}, 2, "width", "nan is outside (0, inf)"},
        {{{"half_width", {1, 1, 1}}}, -1, "half_width", "cannot be combined with width"},
        {{{"slenderness", {1, 1, 1}}}, -1, "slenderness", "cannot be combined with width"},
        {{{"size", {1, 1, 1}}}, -1, "size", "cannot be combined with width and height"},
        {{{"restitution", {1, 1, 1}}}, -1, "restitution_of_maximum", "combined with restitution"},
        {{{"restitution_of_maximum", {1, 1, 1.5}}}, 2, "restitution_of_maximum", "gives r = "},
        {{{"pga", {1, 1, 1}}}, -1, "pga", "Add the column pulse_period"},
        {{{"pulse_period", {1, 1, 1}}}, -1, "pulse_period", "Add the column pga"},
        {{{"pga", {1, -1, 1}}, {"frequency", {1, 1, 1}}}, 1, "pga", "outside [0, inf)"},
        {{{"pga", {1, 1, 1}}, {"amplitude", {1, 1, 1}}}, -1, "pga", "combined with amplitude"},
    };
    for (const Refused& refused : all) {
        Columns columns = columns_of_blocks();
        for (const auto& [name, values] : refused.columns) {
            columns[name] = values;
        }
        try {
            block_list({}, columns);
            ADD_FAILURE() << refused.phrase;
        } catch (const ListError& error) {
            EXPECT_EQ(error.row(), refused.row) << refused.phrase;
            EXPECT_EQ(error.column(), refused.column) << refused.phrase;
            EXPECT_NE(std::string(error.what()).find(refused.phrase), std::string::npos)
                << error.what();
        }
    }
}

TEST(BlockList, UnderSeveralRecordsNeedsTheRecordOfEveryScale)
{
    Columns columns = columns_of_blocks();
    columns["scale"] = {1, 1, 1};
    EXPECT_THROW(block_list(scene_of_two_records(), columns), ListError);
    EXPECT_NO_THROW(block_list(scene_of_two_records(), columns, {0, 1, 0}));
}

} // namespace
} // namespace overturn
