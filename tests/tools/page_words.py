"""Expected readouts of the page of tools/paper/gallery, from a recomputed spectrum."""

import os
import subprocess

import h5py
from tool import TOOLS  # first: adds the package to the path
from overturn.regions import LEFT_STANDING, REGIONS

POINTS = 60
COARSER = [f"--set=plane.{axis}.count={POINTS}" for axis in ("frequency", "amplitude")]

COLOURS = {code: tuple(bytes.fromhex(colour[1:])) for code, (_, _, colour) in REGIONS.items()}


def written(value, digits):
    """Returns a number with this many significant digits, formatted as in JavaScript."""
    if value == 0:
        return f"{0:.{digits - 1}f}"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    if -7 < int(exponent) < digits:
        return f"{float(f'{mantissa}e{exponent}'):.{digits - 1 - int(exponent)}f}"
    return f"{mantissa}e{int(exponent):+d}"


class Spectrum:
    """A spectrum recomputed like that of the page."""

    def __init__(self, figure, folder):
        path = folder / f"{figure}.h5"
        job = TOOLS.parent / "jobs" / f"figure_{figure}.toml"
        subprocess.run([os.environ["OVERTURN"], "run", job, *COARSER, "-o", path], check=True,
                       capture_output=True, timeout=100)
        with h5py.File(path) as file:
            self.frequency, self.amplitude = file["frequency"][:], file["amplitude"][:]
            for field in ("region", "angle", "velocity", "margin"):
                setattr(self, field, file[field][0, 0])

    def one_of_each_region(self):
        """Yields a point from the middle of each region."""
        for code in REGIONS:
            places = [(row, column) for row in range(POINTS) for column in range(POINTS)
                      if self.region[row, column] == code]
            if places:
                yield places[len(places) // 2]

    def borders(self):
        """Returns points whose neighbour to the right or above is in another region."""
        return [(row, column) for row in range(POINTS - 1) for column in range(POINTS - 1)
                if self.region[row, column] != self.region[row + 1, column]
                or self.region[row, column] != self.region[row, column + 1]]

    def words(self, row, column):
        """Returns the complete readout of a point."""
        code = self.region[row, column]
        name, meaning, _ = REGIONS[code]
        angle, velocity, margin = (float(values[row, column]) for values in
                                   (self.angle, self.velocity, self.margin))
        end = f"θ = {written(angle, 3)} rad θ′ = {written(velocity, 3)} rad "
        if code > LEFT_STANDING:
            side = "" if angle > 0 else "−"
            end = (f"overturned during the pulse, passing θ = {side}π/2 with "
                   f"θ′ = {written(velocity, 3)} rad ")
        return (f"{name} {meaning} Ω = {written(self.frequency[column], 5)} "
                f"a = {written(self.amplitude[row], 5)} margin = {written(margin, 3)} "
                f"{end}").replace("-", "−")
