"""Spectra and histories of the jobs in jobs/, computed once per process, and properties of their
maps: connected parts, parts that touch, and the change of end states with restitution. Requires
OVERTURN (the binary) in the environment."""

import contextlib
import dataclasses
import functools
import os
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np
from scipy import ndimage

OVERTURN = os.environ["OVERTURN"]
JOBS = pathlib.Path(__file__).resolve().parents[2] / "jobs"
COUNT = 150  # points along an axis; the paper has 100
MOST = 0.5
PRACTICALLY_ALL = 0.99
VERY_FEW = 0.02
EVERY_NEIGHBOUR = np.ones((3, 3))
PATIENCE = 60  # [s] for one run of the program; the longest takes half a second

REGIONS = ("S", "S+", "S-", "U0+", "U0-", "U1+", "U1-", "F+", "F-")


@dataclasses.dataclass(frozen=True, eq=False)
class Spectrum:
    """Arrays over (amplitude, frequency), both axes broadcast to the same shape."""

    frequency: np.ndarray
    amplitude: np.ndarray
    region: np.ndarray
    angle: np.ndarray
    velocity: np.ndarray
    impacts: np.ndarray
    peak: np.ndarray
    slenderness: float
    restitution: float
    half_width: float
    half_height: float

    def of(self, *names):
        """Returns the points of these regions."""
        return np.isin(self.region, [REGIONS.index(name) for name in names])

    @property
    def safe(self):
        return self.of("S", "S+", "S-")

    @property
    def rocked(self):
        return self.peak > 0

    @property
    def landed(self):
        """Points that rocked and reached the free stage, shown by the paper in phase space."""
        return self.rocked & ~self.of("F+", "F-")

    @property
    def q0(self):
        """Eq. 12, over p^2."""
        potential = 4 * np.sin((self.slenderness - abs(self.angle)) / 2) ** 2
        return potential - self.velocity**2

    @property
    def q_max(self):
        """Eq. 16, over p^2."""
        return 4 * np.sin(self.slenderness / 2) ** 2

    @property
    def q_min(self):
        """Eq. 18, over p^2."""
        return self.q_max * (1 - 1 / self.restitution)

    def upwards(self, frequency):
        """Returns the sequence of regions with increasing amplitude."""
        column = self.region[:, abs(self.frequency[0] - frequency).argmin()]
        changes = np.flatnonzero(np.diff(column, prepend=-1))
        return [REGIONS[code] for code in column[changes]]

    def sample(self, mask, count):
        """Returns up to count points, evenly spaced in the mask, as (frequency, amplitude)."""
        rows, columns = np.nonzero(mask)
        picked = np.unique(np.linspace(0, len(rows) - 1, count).astype(int))
        return [(float(self.frequency[i, j]), float(self.amplitude[i, j]))
                for i, j in zip(rows[picked], columns[picked])]


@contextlib.contextmanager
def output_of(command, figure, *arguments):
    """Returns the open output file of a command."""
    with tempfile.TemporaryDirectory(prefix="overturn-test-") as folder:
        output = pathlib.Path(folder) / "output.h5"
        job = JOBS / f"figure_{figure}.toml"
        subprocess.run([OVERTURN, command, job, "-o", output, *arguments], check=True,
                       timeout=PATIENCE, capture_output=True)
        with h5py.File(output) as file:
            yield file


def overrides(settings):
    return [word for setting in settings for word in ("--set", setting)]


@functools.cache
def spectrum(figure, *settings):
    """Returns the spectrum of the job of a figure, with fewer points and overridden settings."""
    fields = ("region", "angle", "velocity", "impacts", "peak")
    listed = ", ".join(f'"{name}"' for name in fields)
    settings = (f"plane.frequency.count={COUNT}", f"plane.amplitude.count={COUNT}",
                f"output.fields=[{listed}]", *settings)
    with output_of("run", figure, *overrides(settings)) as file:
        data = {name: file[name][...] for name in fields}
        data["impacts"] = data["impacts"].astype(int)
        data["frequency"], data["amplitude"] = np.meshgrid(file["frequency"], file["amplitude"])
        return Spectrum(slenderness=file["slenderness"][...].item(),
                        restitution=file["restitution"][...].item(),
                        half_width=file["half_width"][...].item(),
                        half_height=file["half_height"][...].item(), **data)


@dataclasses.dataclass(frozen=True, eq=False)
class History:
    """One block over time [1/p]: samples, and events by kind and time."""

    time: np.ndarray
    angle: np.ndarray
    velocity: np.ndarray
    ground: np.ndarray
    events: list
    frequency: float
    slenderness: float
    end_of_pulse: float

    def times(self, kind):
        return [time for found, time in self.events if found == kind]

    @property
    def phase(self):
        """omega_p t of the samples, from the beginning of the pulse."""
        return self.frequency * self.time

    @property
    def phase_from_the_middle(self):
        """omega_p t of the samples, from the middle of the wavelet."""
        return self.frequency * (self.time - self.end_of_pulse / 2)


@functools.cache
def history(figure, frequency, amplitude, *settings, samples=2):
    at = f"frequency={frequency},amplitude={amplitude}"
    with output_of("history", figure, "--at", at, "--samples", str(samples),
                   *overrides(settings)) as file:
        meanings = file["events/kind"].attrs["flag_meanings"].decode().split()
        kinds = [meanings[code] for code in file["events/kind"][:]]
        return History(events=list(zip(kinds, file["events/time"][:])), frequency=frequency,
                       slenderness=file.attrs["slenderness"],
                       end_of_pulse=file.attrs["end_of_pulse"],
                       **{name: file[name][:] for name in ("time", "angle", "velocity", "ground")})


def parts(mask):
    """Returns the connected parts of a mask, including diagonals, largest first."""
    numbers, count = ndimage.label(mask, EVERY_NEIGHBOUR)
    return sorted((numbers == number for number in range(1, count + 1)), key=np.count_nonzero, reverse=True)


def largest_part(mask):
    return parts(mask)[0]


def touching(one, other):
    """Returns the number of points of one next to a point of the other, including diagonals."""
    return np.count_nonzero(one & ndimage.binary_dilation(other, EVERY_NEIGHBOUR))


def share(part, whole):
    """Returns the share of the points of whole that are also in part."""
    return np.count_nonzero(part & whole) / np.count_nonzero(whole)


def output(spectrum):
    """Returns the end state of the forced stage in phase space."""
    return np.stack([spectrum.angle, spectrum.velocity])


def moved(one, other):
    """Returns the change of the output with r; 0 unless both blocks reached the free stage."""
    distance = np.hypot(*(output(one) - output(other)))
    return np.where(one.landed & other.landed, distance, 0)
