"""The pictures of tools/plot_landing, and the labels that it shares with tools/plot_spectrum.

Requires OVERTURN (the binary) in the environment.
"""

import argparse
import unittest

import h5py
import numpy as np
import plot_spectrum_test  # adds the package to the path
from plot_spectrum_test import F_MINUS, NOT_COMPUTED, S, S_PLUS, U0_MINUS, Picture, add_field
from overturn.region_labels import Label, connected, off_the_edge, pieces, roomiest_cell
from overturn.spectrum_planes import Axis


class LandingPicture(Picture):
    TOOL = "plot_landing"

    def landing(self, codes, angle, velocity):
        """Writes a result file whose points have given end states."""
        self.spectrum(codes)
        with h5py.File(self.folder / "spectrum.h5", "a") as file:
            for name, values in (("angle", angle), ("velocity", velocity)):
                values = np.broadcast_to(np.float64(values), file["region"].shape)
                add_field(file, name, values, np.nan)

    def two_points(self, codes, angle, velocity):
        """Two points in a plane of overturned blocks; otherwise a label would cover their end
        states."""
        plane = np.full((40, 40), F_MINUS)
        ends = np.full((2, 40, 40), [[[np.pi / 2]], [[1.0]]])
        at = [20, 20], [10, 30]
        plane[at], ends[0][at], ends[1][at] = codes, angle, velocity
        self.landing(plane, *ends)
        return self.picture()


def of_colour(picture, colour):
    """Returns the pixels of a colour in phase space, which begins at a third of the width; colours
    are rounded to bytes."""
    there = picture[:, picture.shape[1] * 35 // 100:]
    return np.argwhere((np.abs(there - colour) <= 1).all(axis=2))


# Colours of columns 10 and 30 and of row 20, of 40: 10.5, 30.5 and 20.5 times 255 / 40.
LOW, HIGH, MEAN = (67, 0, 131), (194, 0, 131), (131, 0, 131)


class TestWhereTheyLand(LandingPicture):
    def test_each_point_has_the_colour_of_its_pulse(self):
        picture = self.two_points([U0_MINUS, S_PLUS], [-0.15, -0.05], [-0.02, 0.08])
        low, high = of_colour(picture, LOW), of_colour(picture, HIGH)
        self.assertTrue(len(low) and len(high))
        # Larger angles are to the right, larger velocities above; rows are counted downward.
        self.assertLess(low[:, 1].min(), high[:, 1].min())
        self.assertGreater(low[:, 0].max(), high[:, 0].max())

    def test_points_in_one_pixel_have_their_mean_colour(self):
        picture = self.two_points([S, S], [0.06, 0.06], [0.03, 0.03])
        self.assertEqual((len(of_colour(picture, LOW)), len(of_colour(picture, HIGH))), (0, 0))
        self.assertGreater(len(of_colour(picture, MEAN)), 0)

    def test_blocks_that_overturned_during_the_pulse_are_not_shown(self):
        for code in (F_MINUS, NOT_COMPUTED):
            picture = self.two_points([S, code], [0.06, -0.05], [0.03, 0.02])
            self.assertGreater(len(of_colour(picture, LOW)), 0)
            self.assertEqual(len(of_colour(picture, HIGH)), 0, code)

    def test_black_is_bottom_left_red_bottom_right_and_blue_top_left(self):
        self.landing(np.full((40, 40), S), 0.0, 0.0)
        picture = self.picture()
        plane = np.argwhere((picture[..., 1] == 0) & (picture.sum(axis=2) > 0))
        plane = plane[plane[:, 1] < picture.shape[1] * 0.34]
        (top, left), (bottom, right) = plane.min(axis=0) + 20, plane.max(axis=0) - 20
        # 20 pixels of about 700 away from the corners: 3 % of each colour.
        for place, colour in (((bottom, left), (0, 0, 0)), ((bottom, right), (255, 0, 0)),
                              ((top, left), (0, 0, 255)), ((top, right), (255, 0, 255))):
            np.testing.assert_allclose(picture[place], colour, atol=12)

    def test_a_million_points_make_a_small_file(self):
        generator = np.random.default_rng(1)
        self.landing(np.full((1000, 1000), S), generator.uniform(-0.2, 0.2, (1000, 1000)),
                     generator.uniform(-0.2, 0.2, (1000, 1000)))
        self.output_of("spectrum.h5", "-o", "picture.pdf")
        # As vector markers, 20 bytes each, they would take 20 MB.
        self.assertLess((self.folder / "picture.pdf").stat().st_size, 2_000_000)


class TestTheNames(LandingPicture):
    def test_each_region_is_named_in_the_plane_and_in_phase_space(self):
        codes = np.full((30, 30), S)
        codes[15:] = U0_MINUS
        self.landing(codes, np.where(codes == S, 0.05, -0.15), np.where(codes == S, 0.02, -0.05))
        words = self.words()
        self.assertEqual((words.count("S"), words.count("U0−")), (2, 2))

    def test_a_region_without_end_states_is_named_in_the_plane_only(self):
        codes = np.full((30, 30), S)
        codes[15:] = F_MINUS
        self.landing(codes, 0.05, 0.02)
        self.assertEqual(self.words().count("F−"), 1)

    def test_a_label_precedes_the_name(self):
        codes = np.full((30, 30), S)
        codes[15:] = U0_MINUS
        self.landing(codes, np.where(codes == S, 0.05, -0.15), np.where(codes == S, 0.02, -0.05))
        words = self.words("--label", "VI=U0-@3,28")
        self.assertEqual([word.split() for word in words if "U0−" in word], [["VI", "U0−"]] * 2)


class TestAComputedLanding(LandingPicture):
    def test_of_the_one_sine_pulse_is_plotted(self):
        self.overturn("run", "spectrum.h5", 'output.fields=["angle", "velocity", "region"]',
                      job=plot_spectrum_test.TestAComputedFile.JOB)
        words = self.words("--label", "IV=U1+@6,7")
        self.assertIn("IV  U1+", words)
        self.assertIn("Computed", words)


class TestALabel(unittest.TestCase):
    PLANE = np.array([[S, S, S_PLUS, S],
                      [S, S, S, S_PLUS],
                      [S_PLUS, S, S, S]])

    def test_belongs_to_the_nearest_piece_of_its_region(self):
        axis_of = {count: Axis(np.arange(1.0, count + 1)) for count in (3, 4)}
        for place, cells in (("1,2", [[2, 0]]), ("4,1", [[0, 2], [1, 3]])):  # diagonals connect
            piece = Label(f"x=S+@{place}").piece(self.PLANE, axis_of[4], axis_of[3])
            np.testing.assert_array_equal(np.argwhere(piece), cells)

    def test_of_an_absent_region_has_no_cells(self):
        axis = Axis(np.arange(1.0, 4))
        self.assertFalse(Label("x=F+@1,1").piece(self.PLANE[:, :3], axis, axis).any())

    def test_is_refused_without_a_region_or_a_point(self):
        for words in ("III", "III=S", "III=Q@1,2", "III=S@1", "III=S@here,there"):
            with self.assertRaises(argparse.ArgumentTypeError, msg=words):
                Label(words)

    def test_is_placed_where_its_piece_is_widest(self):
        mask = np.zeros((40, 60), bool)
        mask[20, 5:30] = True
        mask[14:27, 30:43] = True
        self.assertEqual(list(roomiest_cell(mask)), [20, 36])

    def test_is_placed_off_the_edge_if_its_piece_allows(self):
        mask = np.zeros((80, 80), bool)
        mask[:, :1] = True
        np.testing.assert_array_equal(off_the_edge(mask), mask)
        mask[:, :20] = True
        self.assertFalse(off_the_edge(mask)[:, 0].any())

    def test_pieces_below_the_least_size_are_omitted(self):
        mask = self.PLANE == S_PLUS
        self.assertEqual([np.count_nonzero(piece) for piece in pieces(mask, 2)], [2])
        self.assertEqual(np.count_nonzero(connected(mask, (2, 0))), 1)


class TestALandingRefused(LandingPicture):
    def test_without_the_velocity_names_the_missing_field(self):
        self.landing([[S]], 0.0, 0.0)
        self.change(lambda file: file.pop("velocity"))
        self.refuses(74, "no field velocity; add it to output.fields", "spectrum.h5")

    def test_of_a_damaged_file(self):
        self.landing([[S]], 0.0, 0.0)
        self.change(lambda file: file.pop("amplitude"))
        self.refuses(74, "is damaged", "spectrum.h5")

    def test_of_several_spectra_lists_the_choices(self):
        self.landing(np.zeros((1, 3, 2, 2)), 0.0, 0.0)
        self.refuses(2, "--restitution (0 to 2)", "spectrum.h5")
        self.assertEqual(self.output_of("spectrum.h5", "--restitution", "1"), "spectrum_landing.png\n")

    def test_of_an_invalid_label_shows_an_example(self):
        self.landing([[S]], 0.0, 0.0)
        self.refuses(2, "is not of the form III=S+@5,10", "spectrum.h5", "--label", "III")


if __name__ == "__main__":
    unittest.main()
