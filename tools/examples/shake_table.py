#!/usr/bin/env python3
"""Compares rocking blocks with shake-table tests of rocks: fits a symmetric block to each rock on one set of
tests, and predicts another set."""

import concurrent.futures
import json
import pathlib
import re
import sys
import typing
import warnings

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from overturn.installation import run_elsewhere

try:
    import h5py
    import numpy as np
    import overturn
    from overturn.output_file import new_file, write_picture, write_text
    from overturn.tool import parser_of
    from scipy.optimize import differential_evolution, minimize
    from scipy.special import expit, ndtr
except ImportError as error:
    run_elsewhere(error)

EPILOG = """\
The model: a rock topples with the probability that a symmetric block with lognormally distributed
slenderness overturns. Three numbers per rock are fitted by maximum likelihood: the median slenderness, its scatter, and
the restitution r. The frequency parameter p is fixed. Verdicts are computed on a grid of slendernesses and
restitutions; the probability is their weighted mean. A narrow range of r, fixed and not fitted, is included,
because single verdicts change with tiny changes of r.

The block does not slip. With --friction, further models of each rock are fitted, whose blocks slip with a coefficient
of friction; `fit` chooses it for each rock, among {friction}, as the largest that is as likely as any. At an impact
without slip r is at most r_max = (1 - 3/2 sin^2 slenderness)^2: larger r are replaced by it in these models. A
coefficient takes one to two minutes on two cores for 250 tests of 30 s.

The baseline is a logistic regression on ln PGA and ln(PGV/PGA). Cross-validation is by record.

The file (HDF5): `acceleration` with the attributes dt [s] and units (g), all tests in a row; in the group `tests`
`start` and `length` of each test [samples]; for scores `toppled_NAME` of each rock (1, 0, or another value if not
known); for the fit also `record`, the name of the record. Other datasets are not used."""

FREQUENCY_PARAMETER = 4.5  # p [1/s]
FIT = "fit"  # a coefficient of friction that is fitted, among these
FRICTION = (0.2, 0.3, 0.4, 0.6, 0.8)  # [1]
SLIPPED = 64  # flag of `status`
# [rad]; steps of 1.9 %: 32 or more between -3 and 3 times the smallest scatter.
SLENDERNESS = np.geomspace(0.03, 0.6, 161)
RESTITUTION = np.linspace(0.5, 0.98, 25)  # r [1]; above r_max of the wider blocks
warnings.filterwarnings("ignore", "r = .* is above r_max")
RESTITUTION_RANGE = 0.12  # r varies by less, with triangular weights [1]
BOUNDS = {"slenderness": (0.04, 0.5), "restitution": (0.5, 0.98), "scatter": (0.1, 0.6)}
WRONG_FLAGS = 0.01  # probability that a flag is wrong: bounds the likelihood of a single test [1]
CONVERGED = 1e-3  # difference of the mean log-likelihoods of two searches, or two equal models [1]
LEAST_WEIGHT = 1e-5  # of a slenderness in a prediction: beyond 4 scatters
GRAVITY = 9.81  # [m/s2]
COLOURS, MARKERS = ("#0b3c5d", "#c9741a", "#5e8c61", "#7d7d85"), "os^D"


class TestsError(Exception):
    """Tests that cannot be used, with a message for the user."""


class Tests:
    """The tests of a file: records [g] at equal steps [s], flags of each rock (1, 0, NaN: unknown)."""

    def __init__(self, path):
        try:
            with h5py.File(path) as file:
                self._read(file)
        except (OSError, KeyError, ValueError) as error:
            raise TestsError(f"cannot read \"{path}\": {error}") from error
        except TestsError as error:
            raise TestsError(f"\"{path}\": {error}") from None

    def _read(self, file):
        for name in ("acceleration", "tests/start", "tests/length"):
            if name not in file:
                raise TestsError(f"there is no dataset {name}. --help describes the layout.")
        acceleration, tests = file["acceleration"], file["tests"]
        units = acceleration.attrs.get("units", "g")
        if (units.decode() if isinstance(units, bytes) else units) != "g":
            raise TestsError(f"acceleration is in {units}. Convert it to g.")
        self.time_step = float(acceleration.attrs.get("dt", 0))
        if not 0 < self.time_step < np.inf:
            raise TestsError("acceleration needs the attribute dt, the time between two samples in seconds.")
        samples, start, length = acceleration[:].astype(float), tests["start"][:], tests["length"][:]
        if start.shape != length.shape or (length < 2).any() or (start < 0).any() or (
                start + length > len(samples)).any():
            raise TestsError("tests/start and tests/length do not lie within acceleration.")
        self.records = [samples[first:first + count] for first, count in zip(start, length)]
        for i, record in enumerate(self.records):
            if not np.isfinite(record).all() or not record.any():
                raise TestsError(f"the accelerations of test {i} are not finite, or all zero.")
        self.toppled = {name.removeprefix("toppled_"): flags_of(tests[name][:], name, len(start))
                        for name in sorted(tests) if name.startswith("toppled_")}
        self.record_names = [name.decode() if isinstance(name, bytes) else str(name)
                             for name in tests["record"]] if "record" in tests else None

    def measures(self):
        """Returns ln PGA and ln(PGV/PGA), PGV by the trapezoidal rule, of each test."""
        pga = np.array([abs(record).max() for record in self.records])
        pgv = np.array([abs(np.cumsum(record[1:] + record[:-1])).max() * self.time_step / 2 * GRAVITY
                        for record in self.records])
        return np.column_stack([np.log(pga), np.log(pgv / pga)])

    def verdicts(self, slenderness, restitution, friction):
        """Returns the verdict of each test for each slenderness and restitution, by coefficient of friction (None: no
        slip)."""
        least_first = sorted(friction, key=lambda each: each or 0)

        def verdicts_of(record):
            return verdicts_under(record, self.time_step, *np.broadcast_arrays(slenderness[:, None], restitution),
                                  least_first)
        verdicts = {each: [] for each in least_first}
        with concurrent.futures.ThreadPoolExecutor() as threads:
            for count, found in enumerate(threads.map(verdicts_of, self.records), 1):
                for each in least_first:
                    verdicts[each].append(found[each])
                if count % 25 == 0:
                    tell(f"verdicts of {count} of {len(self.records)} tests")
        return {each: Verdicts(*(table.astype(float) for table in (
            np.array(found) == overturn.Verdict.OVERTURNS, np.array(found) != overturn.Verdict.UNDECIDED)))
            for each, found in verdicts.items()}


def verdicts_under(record, time_step, slenderness, restitution, friction):
    """Returns the verdicts of blocks under a record by coefficient of friction, of which None is the first and others
    follow in ascending order. A block that does not slip with one of them has the same verdict with all that are
    larger."""
    verdicts, verdict, slips = {}, np.empty(slenderness.shape, np.uint8), np.ones(slenderness.shape, bool)
    for each in friction:
        r = restitution if each is None else np.minimum(restitution, (1 - 1.5 * np.sin(slenderness) ** 2) ** 2)
        found = overturn.evaluate(
            slenderness=slenderness[slips], restitution=r[slips], frequency_parameter=FREQUENCY_PARAMETER, friction=each,
            record=record, time_step=time_step, scale=1.0, fields=["status"])
        verdict[slips] = found["verdict"]
        verdicts[each] = verdict.copy()
        if each is not None:
            slips[slips] = found["status"] & SLIPPED != 0
    return verdicts


class Verdicts(typing.NamedTuple):
    """Whether points overturn and whether they are decided, 1 or 0: (tests, slendernesses, restitutions)."""

    overturns: np.ndarray
    decided: np.ndarray

    def of(self, tests):
        return Verdicts(self.overturns[tests], self.decided[tests])

    def probability(self, by_slenderness, by_restitution):
        """Returns the weighted share of the decided points that overturn; NaN if none is decided."""
        overturns, decided = (table @ by_restitution @ by_slenderness for table in self)
        return np.divide(overturns, decided, out=np.full(len(decided), np.nan), where=decided > 0)


def flags_of(values, name, count):
    if values.shape != (count,):
        raise TestsError(f"tests/{name} has the shape {values.shape}, not one flag for each of {count} tests.")
    return np.where(np.isin(values, (0, 1)), values, np.nan).astype(float)


def weights(rock):
    """Returns the weights of the nodes of the grid: lognormal in the slenderness, triangular in r."""
    nodes = np.log(SLENDERNESS / rock["slenderness"]) / rock["scatter"]
    edges = np.concatenate([[-np.inf], (nodes[1:] + nodes[:-1]) / 2, [np.inf]])
    by_restitution = np.clip(1 - abs(RESTITUTION - rock["restitution"]) / RESTITUTION_RANGE, 0, None)
    return np.diff(ndtr(edges)), by_restitution / by_restitution.sum()


def log_likelihood(probability, toppled):
    """Returns the mean logarithm of the probabilities of what happened [1]; flags may be wrong."""
    p = WRONG_FLAGS + (1 - 2 * WRONG_FLAGS) * probability
    return np.nanmean(np.log(np.where(toppled == 1, p, 1 - p)))


def fit_block(verdicts, toppled, seed):
    """Returns the block with the largest likelihood, and its likelihood. The two best of three global searches must
    agree."""
    def rock_of(x):
        return {"slenderness": float(np.exp(x[0])), "restitution": float(x[1]), "scatter": float(np.exp(x[2]))}

    def cost(x):
        return -log_likelihood(verdicts.probability(*weights(rock_of(x))), toppled)

    bounds = [np.log(BOUNDS["slenderness"]), BOUNDS["restitution"], np.log(BOUNDS["scatter"])]
    found = sorted((differential_evolution(cost, bounds, seed=np.random.default_rng([seed, search]), popsize=12,
                                           tol=1e-4, maxiter=300, polish=False) for search in range(3)),
                   key=lambda each: each.fun)
    if not found[0].success or found[1].fun - found[0].fun > CONVERGED:
        raise TestsError(f"the fit did not converge: searches found {[each.fun for each in found]}.")
    return rock_of(found[0].x), -found[0].fun


def fit_logistic(measures, toppled):
    """Returns intercept and coefficients of the logistic regression; a penalty of 1e-3 keeps them finite."""
    x = np.column_stack([np.ones(len(measures)), measures])

    def cost(b):
        z = x @ b
        return np.sum(np.logaddexp(0, z) - toppled * z) + 1e-3 * b @ b, x.T @ (expit(z) - toppled) + 2e-3 * b
    return minimize(cost, np.zeros(x.shape[1]), jac=True, method="L-BFGS-B").x.tolist()


def logistic(coefficients, measures):
    return expit(coefficients[0] + measures @ coefficients[1:])


def scores(probability, toppled, bins=5):
    """Returns accuracy, Brier score, logarithmic score, confusion table and reliability curve over tests with a known flag."""
    known = ~np.isnan(toppled) & ~np.isnan(probability)
    p, y = probability[known], toppled[known] == 1
    if not p.size:
        return {"accuracy": None, "brier": None, "log_score": None, "tests": 0, "left_out": len(known)}
    predicted, place = p > 0.5, np.minimum((p * bins).astype(int), bins - 1)
    filled = [k for k in range(bins) if (place == k).any()]
    return {"accuracy": float(np.mean(predicted == y)), "brier": float(np.mean((p - y) ** 2)),
            "log_score": float(log_likelihood(p, y)), "tests": int(p.size), "left_out": int((~known).sum()),
            "confusion": {name: int(both.sum()) for name, both in (
                ("toppled_and_predicted", y & predicted), ("toppled_not_predicted", y & ~predicted),
                ("predicted_not_toppled", ~y & predicted), ("neither", ~y & ~predicted))},
            "reliability": [{"predicted": float(p[place == k].mean()), "toppled": float(y[place == k].mean()),
                             "tests": int((place == k).sum())} for k in filled]}


def folds_of(record_names, count, seed):
    """Returns the fold of each test; tests of one record are in the same fold."""
    names, number = np.unique(record_names, return_inverse=True)
    if len(names) < count:
        raise TestsError(f"{len(names)} records cannot be divided into {count} folds.")
    return (np.random.default_rng(seed).permutation(len(names)) % count)[number]


def fitted(verdicts, measures, toppled, chosen, choices, seed):
    """Returns the models of a rock from the chosen tests, for each choice of coefficients of friction."""
    known = chosen & ~np.isnan(toppled)
    if len(set(toppled[known])) < 2:
        raise TestsError("some tests must topple a rock, and others must not, in each fold.")
    with concurrent.futures.ThreadPoolExecutor() as threads:
        blocks = dict(zip(verdicts, threads.map(lambda each: fit_block(each.of(known), toppled[known], seed),
                                                verdicts.values())))
    baseline, models = fit_logistic(measures[known], toppled[known]), {}
    for choice, coefficients in choices.items():
        best = max(blocks[each][1] for each in coefficients)
        friction = [each for each in coefficients if best - blocks[each][1] <= CONVERGED][-1]
        models[choice] = {**blocks[friction][0], "friction": friction, "logistic": baseline}
    return models


def fit(path, folds, seed, friction=()):
    """Returns the models of all rocks, with their scores in cross-validation, and the probabilities of these. Of each rock,
    the first does not slip; others have a coefficient of friction, one of FRICTION if it is "fit"."""
    tests = Tests(path)
    if tests.record_names is None or not tests.toppled:
        raise TestsError(f"\"{path}\": a fit needs tests/record and tests/toppled_NAME.")
    choices = {"": [None], **{f"_friction_{each}": FRICTION if each == FIT else [each] for each in friction}}
    fold, measures = folds_of(tests.record_names, folds, seed), tests.measures()
    verdicts = tests.verdicts(SLENDERNESS, RESTITUTION, {each for among in choices.values() for each in among})
    rocks, predictions = {}, {}
    for name, toppled in tests.toppled.items():
        block, baseline = {choice: np.empty(len(fold)) for choice in choices}, np.empty(len(fold))
        for k in range(folds):
            for choice, rock in fitted(verdicts, measures, toppled, fold != k, choices, seed).items():
                block[choice][fold == k] = verdicts[rock["friction"]].of(fold == k).probability(*weights(rock))
            baseline[fold == k] = logistic(rock["logistic"], measures[fold == k])
            tell(f"{name}: {k + 1} of {folds} folds")
        for choice, rock in fitted(verdicts, measures, toppled, fold >= 0, choices, seed).items():
            rocks[name + choice] = {"rock": name, **rock, **scores(block[choice], toppled),
                                    "logistic_regression": scores(baseline, toppled)}
            predictions[name + choice] = block[choice], toppled
    return {"frequency_parameter": FREQUENCY_PARAMETER, "restitution_range": RESTITUTION_RANGE,
            "scores": f"{folds}-fold cross-validation by record, seed {seed}", "rocks": rocks}, predictions


def predict(model, path):
    """Returns the scores of each model of a rock, null for a rock without flags, and the probabilities."""
    tests, result, predictions = Tests(path), {}, {}
    measures, unknown = tests.measures(), np.full(len(tests.records), np.nan)
    for name, rock in model["rocks"].items():
        by_slenderness, by_restitution = weights(rock)
        rows, columns = by_slenderness > LEAST_WEIGHT, by_restitution > 0
        friction = rock.get("friction")
        verdicts = tests.verdicts(SLENDERNESS[rows], RESTITUTION[columns], [friction])[friction]
        block = verdicts.probability(by_slenderness[rows], by_restitution[columns])
        toppled = tests.toppled.get(rock.get("rock", name), unknown)
        predictions[name] = block, toppled
        result[name] = {**scores(block, toppled),
                        "logistic_regression": scores(logistic(rock["logistic"], measures), toppled)}
    return result, predictions


def tell(progress):
    print(f"shake_table: {progress}", file=sys.stderr, flush=True)


def draw(predictions, path):
    """Draws the reliability curve of each rock: how often it toppled against the predicted probability."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, ax = pyplot.subplots(figsize=(5.5, 5.4 + 0.2 * len(predictions)), layout="constrained")
    ax.plot([0, 1], [0, 1], color="0.6", linewidth=1, label="perfect")
    for i, (name, (probability, toppled)) in enumerate(predictions.items()):
        score = scores(probability, toppled)
        if not score["tests"]:
            continue
        predicted, share, count = (np.array([each[key] for each in score["reliability"]])
                                   for key in ("predicted", "toppled", "tests"))
        error = np.sqrt(predicted * (1 - predicted) / count)
        ax.errorbar(predicted, share, error, color=COLOURS[i % 4], marker=MARKERS[(i + i // 4) % 4], markersize=7, capsize=3,
                    label=f"{name}: {score['accuracy']:.1%} correct, Brier score {score['brier']:.3f}")
    ax.set_xlabel("predicted probability of toppling (mean of a bin)")
    ax.set_ylabel("fraction of the tests that toppled the rock")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), fontsize=9)
    ax.grid(color="0.9")
    write_picture(figure, path, dpi=150)


def write_csv(predictions, path):
    """Writes the probability that each rock topples, one row per test in the order of the file."""
    columns = np.column_stack([probability for probability, _ in predictions.values()])
    with new_file(path, "a table of probabilities", is_table) as part:
        np.savetxt(part, columns, fmt="%.4f", delimiter=",", header=",".join(predictions), comments="")


def is_table(beginning):
    """Whether a file begins with a header and numbers of four decimals."""
    return re.match(rb"[^\n]*\n(\d\.\d{4}|nan)[,\n]", beginning) is not None


def read_model(path):
    try:
        model = json.loads(pathlib.Path(path).read_text())
    except (OSError, ValueError) as error:
        raise TestsError(f"cannot read \"{path}\": {error}") from error
    if not isinstance(model, dict) or "rocks" not in model or (model.get("frequency_parameter"), model.get(
            "restitution_range")) != (FREQUENCY_PARAMETER, RESTITUTION_RANGE):
        raise TestsError(f"\"{path}\" is not a model of this program. Write one with fit.")
    return model


def coefficient(word):
    """Returns a coefficient of friction, or "fit"."""
    if word == FIT or 0 < float(word) <= 10:
        return FIT if word == FIT else float(word)
    raise ValueError


def read_arguments():
    parser = parser_of("shake_table.py", __doc__, EPILOG.format(friction=", ".join(map(str, FRICTION))))
    commands = parser.add_subparsers(dest="command", required=True)
    fitting = commands.add_parser("fit", help="fit a block to each rock; print the scores in cross-validation")
    fitting.add_argument("file", metavar="TESTS.h5")
    fitting.add_argument("-o", "--output", metavar="MODEL.json", default="model.json",
                         help="the model (default: %(default)s)")
    fitting.add_argument("--folds", type=int, default=5, metavar="N", help="default: %(default)s")
    fitting.add_argument("--seed", type=int, default=1, metavar="N",
                         help="of the folds and the search (default: %(default)s)")
    predicting = commands.add_parser("predict", help="predict other tests; print the scores")
    predicting.add_argument("model", metavar="MODEL.json", help="written by fit")
    predicting.add_argument("file", metavar="TESTS.h5")
    fitting.add_argument("--friction", type=coefficient, nargs="+", default=[], metavar="MU",
                         help="also fit blocks that slip, with these coefficients of friction, or \"fit\"")
    for command in (fitting, predicting):
        command.add_argument("--plot", metavar="OUT.png", help="draw the reliability curve")
        command.add_argument("--csv", metavar="OUT.csv", help="write the probability of each test")
    return parser.parse_args()


def main():
    arguments = read_arguments()
    try:
        if arguments.command == "fit":
            model, predictions = fit(arguments.file, arguments.folds, arguments.seed, arguments.friction)
            write_text(arguments.output, json.dumps(model, indent=1) + "\n", "a model of this program",
                       lambda beginning: b'"frequency_parameter"' in beginning)
            result = model["rocks"]
        else:
            result, predictions = predict(read_model(arguments.model), arguments.file)
        if arguments.plot:
            draw(predictions, arguments.plot)
        if arguments.csv:
            write_csv(predictions, arguments.csv)
    except (TestsError, OSError) as error:
        sys.exit(f"shake_table: {error}")
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
