"""Writes synthetic recorded motions: filtered noise with an envelope, optionally with a velocity pulse, as
AT2 files in g."""

import argparse
import math
import pathlib

import numpy as np

from overturn.output_file import OutputError, make_folder, write_text
from overturn.tool import parser_of

EXAMPLE = """\
example:
  tools/synthetic_record                         # writes synthetic.AT2: 20 s, peak 0.4 g
  tools/synthetic_record --seed 2 --pga 0.2 -o vertical.AT2
  tools/synthetic_record --suite 50 -o suite     # writes suite/01.AT2 to suite/50.AT2
  tools/synthetic_record --suite 24 --components 3 -o pairs
                                                 # writes pairs/01_H1.AT2, 01_H2.AT2, 01_V.AT2 to 24_V.AT2

White noise w(t) with the envelope e(t) excites the ground layer of Kanai and Tajimi, whose
acceleration excites the high-pass filter of Clough and Penzien:

  x'' + 2 z x' W + W^2 x = -e w            a = -(2 z x' W + W^2 x)     W = 15.7 rad/s, z = 0.6
  y'' + 2 z y' V + V^2 y = -a              record: y''                 V = W/10

The envelope has the form of Jennings, Housner and Tsai: it rises as t^2 in the first tenth of the
duration D, is 1 up to 0.4 D, and decays as exp(-10 (t - 0.4 D)/D). Velocity and displacement of the
record are y' and y, which decay after the shaking: no baseline correction is needed. The equations
are integrated with constant average acceleration (Newmark). The record is scaled to its peak.

A velocity pulse of period T is added to the noise, centred at 0.25 D (Mavroeidis and Papageorgiou,
gamma = 2). Its amplitude A is 1.5 times the PGV of the noise:

  v = A/2 (1 + cos(pi s/T)) sin(2 pi s/T),   s = t - 0.25 D,   |s| <= T

The records of a suite have the seeds S, S + 1 and so on: the suite of another seed has other records
only if they are farther apart than its length. The duration (10 to 30 s), PGA (median: --pga), ground
frequency (median: --ground-frequency) and, in 3 of 10, the period of a pulse (median 1.5 s) are random;
all but the duration are lognormal with a scatter of 0.4. The second line of a file is the command
that writes it alone.

With --components 2, each motion of a suite has a second horizontal component, with --components 3 a
vertical one too. Their noise is independent: along their principal axes, the components of ground
motion are uncorrelated (Penzien and Watabe). The correlation coefficient of two files differs from 0
by chance only, with a standard deviation of 0.1. Duration, envelope and ground frequency are those of
the first component. Both horizontal components have the same peak, the vertical one has half of it, as
a simple value: the ratios of recorded motions vary around it, and are larger near a fault. A pulse is
in H1 only, as one that is normal to the fault.

The file depends on the arguments only: noise is from NumPy's PCG64, values are rounded to 1e-7 g.

  K. Kanai, Bull. Earthq. Res. Inst. 35 (1957) 309-325;  H. Tajimi, Proc. 2nd WCEE (1960) 781-797
  P. Jennings, G. Housner, N. Tsai, Simulated earthquake motions, Caltech (1968)
  R. Clough, J. Penzien, Dynamics of structures (1975)
  J. Penzien, M. Watabe, Earthq. Eng. Struct. Dyn. 3 (1975) 365-373
  G. Mavroeidis, A. Papageorgiou, Bull. Seism. Soc. Am. 93 (2003) 1099-1131"""

TIME_STEP = 0.01  # [s]
GROUND_FREQUENCY = 2.5  # W/(2 pi) [Hz]: firm ground
HIGH_PASS = 0.1  # V/W [1]
DAMPING = 0.6  # z [1], of both filters
LEAST_SAMPLES, MOST_SAMPLES = 11, 1_000_000
LEAST_PGA, MOST_PGA = 0.001, 1000.0  # [g]: four digits or more, and columns that do not touch
PER_LINE = 5
PULSE_RATIO = 1.5  # PGV of the pulse over that of the noise [1]
PULSE_SHARE, PULSE_PERIOD = 0.3, 1.5  # of the records of a suite; median [s]
DURATIONS = 10.0, 30.0  # of the records of a suite [s]
SCATTER = 0.4  # of the quantities of a suite: standard deviation of their logarithms [1]
MOST_RECORDS = 9999
# Of the components of a motion, in their order: the ends of their names, and their peaks over that of the first one.
COMPONENTS = {"_H1": 1.0, "_H2": 1.0, "_V": 0.5}
SEEDS_OF_COMPONENT = MOST_RECORDS + 1  # from those of one component to those of the next
MARK = "SYNTHETIC RECORD, NO EARTHQUAKE"  # the beginning of a file


def envelope(t, duration):
    rise, plateau_end = 0.1 * duration, 0.4 * duration
    if t < rise:
        return (t / rise) ** 2
    return math.exp(-10 * max(0.0, t - plateau_end) / duration)


def respond(load, frequency, time_step):
    """Returns displacement, velocity and acceleration of x'' + 2 z W x' + W^2 x = load from rest, by
    Newmark's method with constant average acceleration."""
    stiffness, damping = frequency**2, 2 * DAMPING * frequency
    inertia = 1 + damping * time_step / 2 + stiffness * time_step**2 / 4
    x = v = 0.0
    a = load[0]
    states = [(x, v, a)]
    for p in load[1:]:
        half_velocity = v + a * time_step / 2
        ahead = x + v * time_step + a * time_step**2 / 4
        a = (p - damping * half_velocity - stiffness * ahead) / inertia
        x, v = ahead + a * time_step**2 / 4, half_velocity + a * time_step / 2
        states.append((x, v, a))
    return states


def pulse(period, time_step, count):
    """Returns the accelerations of a velocity pulse with a peak velocity near 1, centred at a quarter of the
    record."""
    t = (np.arange(count) - count / 4) * time_step
    slow, fast = math.pi * t / period, 2 * math.pi * t / period
    slope = math.pi / period * (2 * (1 + np.cos(slow)) * np.cos(fast) - np.sin(slow) * np.sin(fast)) / 2
    return np.where(abs(t) <= period, slope, 0)


def synthetic(seed, duration, time_step, pga, ground_frequency, pulse_period):
    """Returns the accelerations [g] at 0, time_step, ..., duration."""
    count = samples(duration, time_step)
    frequency = 2 * math.pi * ground_frequency
    noise = np.random.default_rng(seed).standard_normal(count).tolist()
    load = [-envelope(i * time_step, duration) * w for i, w in enumerate(noise)]
    ground = [-2 * DAMPING * frequency * v - frequency**2 * x
              for x, v, _ in respond(load, frequency, time_step)]
    _, velocity, record = zip(*respond([-a for a in ground], HIGH_PASS * frequency, time_step))
    if pulse_period:
        added = PULSE_RATIO * max(map(abs, velocity)) * pulse(pulse_period, time_step, count)
        record = (np.array(record) + added).tolist()
    peak = max(map(abs, record))
    return [round(a / peak * pga, 7) + 0.0 for a in record]


def of_suite(arguments, number):
    """Returns the arguments of a record of the suite. Its numbers are rounded, because they are printed."""
    seed = arguments.seed + number
    random = np.random.default_rng([seed, 1])  # independent of the noise
    def lognormal(median, least=0.0, most=math.inf):
        value = random.lognormal(math.log(median), SCATTER)
        return float(f"{min(max(value, least), most):.3g}")
    duration = round(random.uniform(*DURATIONS), 1)
    return argparse.Namespace(
        seed=seed, time_step=arguments.time_step, duration=duration,
        pga=lognormal(arguments.pga, LEAST_PGA, MOST_PGA),
        ground_frequency=lognormal(arguments.ground_frequency),
        pulse_period=lognormal(PULSE_PERIOD, most=duration / 4) if random.random() < PULSE_SHARE else None)


def of_component(first, place):
    """Returns the arguments of another component of a motion, of which the first one has these."""
    share = list(COMPONENTS.values())[place]
    return argparse.Namespace(**{**vars(first), "seed": first.seed + place * SEEDS_OF_COMPONENT,
                                 "pga": max(float(f"{share * first.pga:.3g}"), LEAST_PGA),
                                 "pulse_period": None if place else first.pulse_period})


def samples(duration, time_step):
    return round(min(duration / time_step, MOST_SAMPLES)) + 1


def at2(arguments):
    values = synthetic(**{name: getattr(arguments, name) for name in (
        "seed", "duration", "time_step", "pga", "ground_frequency", "pulse_period")})
    options = f"--seed {arguments.seed} --duration {arguments.duration:g} --pga {arguments.pga:g}"
    if arguments.time_step != TIME_STEP:
        options += f" --time-step {arguments.time_step:g}"
    if arguments.ground_frequency != GROUND_FREQUENCY:
        options += f" --ground-frequency {arguments.ground_frequency:g}"
    if arguments.pulse_period:
        options += f" --pulse-period {arguments.pulse_period:g}"
    lines = [f"{MARK}: Kanai-Tajimi and Clough-Penzien filters",
             f"tools/synthetic_record {options}",
             "ACCELERATION TIME SERIES IN UNITS OF G",
             f"NPTS= {len(values):6d}, DT= {arguments.time_step:g} SEC"]
    lines += ["".join(f"{value:15.7f}" for value in values[i:i + PER_LINE])
              for i in range(0, len(values), PER_LINE)]
    return "\n".join(lines) + "\n"


def positive(text):
    value = float(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} must be above 0 and finite")
    return value


def natural(text):
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"{text} must be 0 or above")
    return value


def read_arguments(argv):
    parser = parser_of("synthetic_record", __doc__, EXAMPLE)
    parser.add_argument("--seed", metavar="N", type=natural, default=1,
                        help="seed of the noise; each gives a different record (default: %(default)s)")
    parser.add_argument("--duration", metavar="SECONDS", type=positive, default=20.0,
                        help="from the first to the last sample (default: %(default)g); random in a suite")
    parser.add_argument("--time-step", metavar="SECONDS", type=positive, default=TIME_STEP,
                        help="between two samples (default: %(default)g)")
    parser.add_argument("--pga", metavar="G", type=positive, default=0.4,
                        help="peak of the acceleration (default: %(default)g)")
    parser.add_argument("--ground-frequency", metavar="HZ", type=positive, default=GROUND_FREQUENCY,
                        help="of the ground layer (default: %(default)g)")
    parser.add_argument("--pulse-period", metavar="SECONDS", type=positive,
                        help="add a velocity pulse of this period")
    parser.add_argument("--suite", metavar="N", type=natural, help="write this many different records")
    parser.add_argument("--components", metavar="N", type=int, choices=(1, 2, 3), default=1,
                        help="of each record of a suite: 2 horizontal ones, 3 with a vertical one (default: 1)")
    parser.add_argument("-o", "--output", metavar="OUT.AT2",
                        help="the record (default: synthetic.AT2 in the working directory); with --suite, the "
                             "folder of the records (default: suite)")
    arguments = parser.parse_args(argv)
    check(parser, arguments)
    return arguments


def check(parser, arguments):
    for duration in DURATIONS if arguments.suite else (arguments.duration,):
        if not LEAST_SAMPLES <= samples(duration, arguments.time_step) <= MOST_SAMPLES:
            parser.error(f"a duration of {duration:g} s with --time-step {arguments.time_step:g} must give "
                         f"{LEAST_SAMPLES} to {MOST_SAMPLES} samples")
    if not LEAST_PGA <= arguments.pga <= MOST_PGA:
        parser.error(f"--pga {arguments.pga:g} is outside {LEAST_PGA:g} to {MOST_PGA:g}")
    if arguments.pulse_period and 4 * arguments.pulse_period > arguments.duration:
        parser.error(f"--pulse-period {arguments.pulse_period:g} is above a quarter of the duration, "
                     f"{arguments.duration:g} s")
    if arguments.suite is not None and not 1 <= arguments.suite <= MOST_RECORDS:
        parser.error(f"--suite {arguments.suite} is outside 1 to {MOST_RECORDS}")
    if arguments.components > 1 and arguments.suite is None:
        parser.error(f"--components {arguments.components} needs --suite, such as --suite 1 for one motion")
    if arguments.suite and arguments.pulse_period:
        parser.error("--pulse-period cannot be combined with --suite, whose pulses are random")


def write(arguments, path):
    write_text(path, at2(arguments), "a synthetic record",
               lambda beginning: beginning.startswith(MARK.encode()))


def main(argv=None):
    arguments = read_arguments(argv)
    path = pathlib.Path(arguments.output or ("suite" if arguments.suite else "synthetic.AT2"))
    if arguments.suite:
        make_folder(path)
        digits = max(2, len(str(arguments.suite)))
        ends = list(COMPONENTS)[:arguments.components] if arguments.components > 1 else [""]
        firsts = {f"{number + 1:0{digits}d}": of_suite(arguments, number) for number in range(arguments.suite)}
        records = {f"{name}{end}.AT2": of_component(first, place)
                   for name, first in firsts.items() for place, end in enumerate(ends)}
        others = sorted({each.name for each in path.glob("*.AT2")} - {*records})
        if others:
            raise OutputError(path, f"it holds other records, such as {others[0]}, which the pattern *.AT2 would "
                                    "add to the suite. Remove them, or choose another folder")
        for name, record in records.items():
            write(record, path / name)
    else:
        write(arguments, path)
    print(path)
